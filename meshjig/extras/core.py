"""The core: a body inside the pieces, on which the puzzle is built up."""

from __future__ import annotations

from itertools import product
from typing import Any

import numpy as np

from meshjig.errors import SolidError
from meshjig.extras.cap_openings import closed_over
from meshjig.extras.carve_clearance import carved
from meshjig.extras.depth import Depth
from meshjig.extras.enforce_clearance import cleared
from meshjig.extras.hollow import hollowed
from meshjig.extras.inset import inset_surface
from meshjig.mesh.booleans import Body, arrays, body, largest, sound
from meshjig.mesh.components import components
from meshjig.mesh.halfedges import compact
from meshjig.mesh.measure import face_areas
from meshjig.mesh.types import Floats, Ints, Mesh

__all__ = ["make_core"]

_CELLS = 125  # along the largest extent
_AIM = 1.1  # of the clearance: the gap is known in many places, not in all
_MOST_CUTS = 12  # along an axis


def make_core(
    outer: Mesh,
    D: Floats,
    clearance: float,
    *,
    wall: float,
    min_wall: float,
    up: Floats,
    plate: tuple[float, float, float] | None = None,
) -> tuple[list[tuple[Floats, Ints]], dict[str, Any]]:
    """Make the body that fills a puzzle, but for a gap.

    Limbs too thin for a core have none. It is hollow, with a drain below each hollow, and cut into blocks
    where it is too large for the plate. The largest part alone is kept of what is not connected.

    Parameters
    ----------
    outer : Mesh, the outer sheet of the pieces; its openings are closed by lids
    D : (n, 3) float64, mm, from its vertices to the inner sheet
    clearance : float, mm, between the inner sheet and the core, at least
    wall : float, mm; 0 for a solid core
    min_wall : float, mm; the core has no thinner parts, roughly
    up : (3,) float64, unit, the way the core stands when it is emptied
    plate : (3,) float, mm, width, depth and height of what a printer can make, optional

    Returns
    -------
    parts : list of (V, F), closed and oriented outward
    facts : dict
        "parts": int; "volume_mm3": float; "drains": int; "dropped": int, loose parts that were left out;
        "closed_mm2": area of the model's openings.

    Raises
    ------
    SolidError
        The model has no room for a core.

    Notes
    -----
    About 3 s for 100,000 faces.
    """
    V, F, closed = closed_over(outer.V + D, outer.F)
    cell = float(np.ptp(V, axis=0).max()) / _CELLS
    aim = _AIM * clearance
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
    made, near = cleared(made, G, around, aim)
    whole = body(made, G)
    if len(near):
        whole = largest(carved(whole, V, F[near], aim))[0]
    if not sound(whole):
        raise SolidError(
            "the core can't be made, since the inner side of this model crosses itself", hint="leave it out"
        )
    drains = 0
    if wall > 0:
        whole, drains = hollowed(whole, around, aim, wall, cell, up)
    blocks = _blocks(whole, plate) if plate is not None else [whole]
    parts = [part for block in blocks for part in block.decompose()]
    large = [part for part in parts if part.volume() > max(min_wall, cell) ** 3]
    facts = {
        "parts": len(large),
        "volume_mm3": float(sum(part.volume() for part in large)),
        "drains": drains,
        "dropped": n - 1 + len(parts) - len(large),
        "closed_mm2": closed,
    }
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
