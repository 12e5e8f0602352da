"""The core: a body inside the pieces, hollow, on which the puzzle is built up."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

import numpy as np

from meshjig.errors import SolidError
from meshjig.extras.cap_openings import cap_openings
from meshjig.extras.carve_clearance import carve_clearance
from meshjig.extras.depth import Depth
from meshjig.extras.enforce_clearance import enforce_clearance
from meshjig.extras.inset import inset_surface
from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.booleans import Body, arrays, body, largest, sound
from meshjig.mesh.components import components
from meshjig.mesh.halfedges import compact
from meshjig.mesh.measure import face_areas, unit
from meshjig.mesh.types import Mesh

__all__ = ["CoreFacts", "CoreShape", "make_core"]

_CELLS = 125  # along the largest extent
_AIM = 1.1  # of the clearance: the gap is known in many places, not in all
_MOST_CUTS = 12  # along an axis
_COARSE = 2.0  # cells of the outer side; nobody sees the inner one
_SMALLEST = 10.0  # cubes of the wall: a hollow that is not worth its drain
_DRAIN = 1.0  # walls, radius of a drain
_LONGEST = 4.0  # walls, length of a drain
_SIDES = 24


@dataclass(frozen=True)
class CoreFacts:
    """What the report says of how the core was made."""

    parts: int
    volume_mm3: float
    drains: int
    dropped: int  # loose parts that were left out
    closed_mm2: float  # area of the model's openings


@dataclass(frozen=True)
class CoreShape:
    """What a core is to be like."""

    clearance: float  # mm, between the inner sheet and the core, at least
    wall: float  # mm; 0 for a solid core
    min_wall: float  # mm; the core has no thinner parts, roughly
    up: Floats  # (3,), unit, the way the core stands when it is emptied
    plate: tuple[float, float, float] | None = None  # mm, width, depth and height that a printer can make


def make_core(outer: Mesh, D: Floats, shape: CoreShape) -> tuple[list[tuple[Floats, Ints]], CoreFacts]:
    """Make the body that fills a puzzle, but for a gap.

    Limbs too thin for a core have none. It is hollow, with a drain below each hollow, and cut into blocks
    where it is too large for the plate. The largest part alone is kept of what is not connected.

    Parameters
    ----------
    outer : Mesh, the outer sheet of the pieces; its openings are closed by lids
    D : (n, 3) float64, mm, from its vertices to the inner sheet
    shape : CoreShape

    Returns
    -------
    parts : list of (V, F), closed and oriented outward
    facts : CoreFacts

    Raises
    ------
    SolidError
        The model has no room for a core.

    Notes
    -----
    About 3 s for 100,000 faces.
    """
    V, F, closed = cap_openings(outer.V + D, outer.F)
    cell = float(np.ptp(V, axis=0).max()) / _CELLS
    aim, wall, min_wall = _AIM * shape.clearance, shape.wall, shape.min_wall
    for crossed in (False, True):
        around = Depth(V, F, crossed=crossed)
        made, G = inset_surface(around, aim, cell, min_wall)
        if not len(G):
            raise _no_room()
        n, label = components(G)
        G, kept = compact(G[label == np.bincount(label, face_areas(made, G)).argmax()])
        made = made[kept]
        if sound(body(made, G)):
            break
    made, near = enforce_clearance(made, G, around, aim)
    whole = body(made, G)
    if len(near):
        whole = largest(carve_clearance(whole, V, F[near], aim))[0]
    if not sound(whole):
        raise SolidError(
            "the core can't be made, since the inner side of this model crosses itself", hint="leave it out"
        )
    drains = 0
    if wall > 0:
        whole, drains = hollowed(whole, around, aim, wall, cell, shape.up)
    blocks = _blocks(whole, shape.plate) if shape.plate is not None else [whole]
    parts = [part for block in blocks for part in block.decompose()]
    large = [part for part in parts if part.volume() > max(min_wall, cell) ** 3]
    volume = float(sum(part.volume() for part in large))
    facts = CoreFacts(len(large), volume, drains, n - 1 + len(parts) - len(large), closed)
    return [arrays(part) for part in large], facts


def _no_room() -> SolidError:
    return SolidError(
        "there is no room for a core inside this model", hint="make it larger, or its walls thinner"
    )


def _blocks(whole: Body, plate: tuple[float, float, float]) -> list[Body]:
    """Cut a body into the fewest equal blocks that fit, each turned as need be."""
    low, high = np.array(whole.bounding_box()).reshape(2, 3)
    extent, most = high - low, np.sort(plate)
    counts = sorted(product(range(1, _MOST_CUTS + 1), repeat=3), key=lambda n: (np.prod(n), n))
    fitting = (n for n in counts if (np.sort(extent / n) <= most).all())
    blocks = [whole]
    for axis, n in enumerate(next(fitting, counts[-1])):
        normal = np.eye(3)[axis].tolist()
        for k in range(1, n):
            height = float(low[axis] + extent[axis] * k / n)
            blocks = [part for block in blocks for part in block.split_by_plane(normal, height)]
    return [block for block in blocks if not block.is_empty()]


def hollowed(
    core: Body, around: Depth, depth: float, wall: float, cell: float, up: Floats
) -> tuple[Body, int]:
    """Leave a wall of a body, and open each hollow at its lowest point.

    Parameters
    ----------
    core : Body
    around : Depth, of the surface around it
    depth : float, mm, of the body's own surface
    wall : float, mm
    cell : float, mm, edge of a cube of the grid
    up : (3,) float64, unit

    Returns
    -------
    Body
        In one part. What is too small, or has no way out through the wall below it, stays filled.
    drains : int
    """
    V, F = inset_surface(around, depth + wall, _COARSE * cell, wall)
    drains = 0
    for hollow in body(V, F).decompose() if len(F) else []:
        if hollow.volume() < _SMALLEST * wall**3:
            continue
        points = arrays(hollow)[0]
        lowest = points[(points @ up).argmin()]
        opened = core - hollow - _drain(lowest + _DRAIN * wall * up, up, (_LONGEST + _DRAIN) * wall, wall)
        if sound(opened) and len(opened.decompose()) == 1:
            core, drains = opened, drains + 1
    return core, drains


def _drain(top: Floats, up: Floats, length: float, wall: float) -> Body:
    """Give a cylinder that goes down from a point."""
    import manifold3d

    side = unit(np.cross(up, np.eye(3)[np.abs(up).argmin()]))
    axes = np.stack([side, np.cross(up, side), up])
    rod = manifold3d.Manifold.cylinder(length, _DRAIN * wall, circular_segments=_SIDES)
    return rod.warp_batch(lambda p: (p - [0.0, 0.0, length]) @ axes + top)
