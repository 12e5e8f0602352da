"""The core: a body inside the pieces, hollow, on which the puzzle is built up."""

from __future__ import annotations

from collections.abc import Iterator
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
from meshjig.mesh.halfedges import border_halfedges, compact, next_halfedge
from meshjig.mesh.measure import face_areas, unit, vertex_normals
from meshjig.mesh.mesh import concatenate
from meshjig.mesh.types import Mesh

__all__ = ["CoreFacts", "CoreShape", "make_core"]

_CELLS = 125  # along the largest extent
_FRINGE = 2.0  # cells; what is thinner comes out ragged
_AIM = 1.1  # of the clearance: the gap is known in many places, not in all
_MOST_CUTS = 12  # along an axis
_COARSE = 2.0  # cells of the outer side; nobody sees the inner one
_SMALLEST = 10.0  # cubes of the wall: a hollow that is not worth its drain
_DRAIN = 1.0  # walls, radius of a drain
_LONGEST = 4.0  # walls, length of a drain
_THROUGH = 4.0  # walls, length of a drain that goes straight through one
_LOW = 0.3  # of a hollow's points, the lowest of them, where a drain may be
_PLACES = 8  # tried there
_SIDES = 24
_NEAR = 2.0  # cells beyond the gap; pieces as near as that lie on the core
_BEARS = 1 / 3  # of the area, that does at least


@dataclass(frozen=True)
class CoreFacts:
    """What the report says of how the core was made."""

    parts: int
    volume_mm3: float
    drains: int
    dropped: int  # loose parts that were left out
    closed_mm2: float  # area of the model's openings
    filled_mm3: float  # of hollows that stay filled, since no drain reaches them


@dataclass(frozen=True)
class CoreShape:
    """What a core is to be like."""

    clearance: float  # mm, between the inner sheet and the core, at least
    wall: float  # mm; 0 for a solid core
    min_wall: float  # mm; the core has no thinner parts, roughly
    up: Floats  # (3,), unit, the way the core stands when it is emptied
    plate: tuple[float, float, float] | None = None  # mm, width, depth and height that a printer can make


def make_core(
    outer: Mesh, D: Floats, shape: CoreShape, taken: Mesh | None = None
) -> tuple[list[tuple[Floats, Ints]], CoreFacts]:
    """Make the body that fills a puzzle, but for a gap.

    Limbs too thin for a core have none, and it ends where parts begin that pieces fill from side to side. It
    is hollow, with a drain below each hollow, and cut into blocks where it is too large for the plate. The
    largest part alone is kept of what is not connected.

    Parameters
    ----------
    outer : Mesh, the outer sheet of the pieces; its openings are closed by lids
    D : (n, 3) float64, mm, from its vertices to the inner sheet
    shape : CoreShape
    taken : Mesh, optional
        Closed: what belongs to pieces beside the wall. The core keeps its gap to it as well.

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
    if taken is not None:  # turned about, so that nothing inside it is wound around
        V, F = concatenate([Mesh(V, F), Mesh(taken.V, taken.F[:, ::-1])])[:2]
    walls = _walls_beside(outer, D) if closed else None  # a lid may lead through them
    cell = float(np.ptp(V, axis=0).max()) / _CELLS
    aim, wall, min_wall = _AIM * shape.clearance, shape.wall, shape.min_wall
    for crossed in (False, True) if taken is None else (True,):
        around = Depth(V, F, crossed=crossed, beside=walls)
        made, G = inset_surface(around, aim, cell, max(min_wall, _FRINGE * cell))
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
        whole = largest(carve_clearance(whole, around.V, around.F[near], aim))[0]
    if not sound(whole):
        raise SolidError(
            "the core can't be made, since the inner side of this model crosses itself", hint="leave it out"
        )
    _refuse_what_bears_little(whole, outer.V + D, outer.F, aim + _NEAR * cell)
    drains, filled = 0, 0.0
    if wall > 0:
        whole, drains, filled = hollowed(whole, around, aim, wall, cell, shape.up)
    blocks = _blocks(whole, shape.plate) if shape.plate is not None else [whole]
    parts = [part for block in blocks for part in block.decompose()]
    large = [part for part in parts if part.volume() > max(min_wall, cell) ** 3 and _is_thick(part, min_wall)]
    volume = float(sum(part.volume() for part in large))
    facts = CoreFacts(len(large), volume, drains, n - 1 + len(parts) - len(large), closed, filled)
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


def _walls_beside(outer: Mesh, D: Floats) -> Mesh:
    """Give what an open wall has besides its inner sheet: the outer one, and the rims between the two."""
    h = border_halfedges(outer.F)
    a, b, n = outer.F.ravel()[h], outer.F.ravel()[next_halfedge(h)], len(outer.V)
    rims = np.concatenate([np.stack([b, a, a + n], 1), np.stack([b, a + n, b + n], 1)])
    return Mesh(np.concatenate([outer.V, outer.V + D]), np.concatenate([outer.F, rims]))


def _refuse_what_bears_little(core: Body, V: Floats, F: Ints, near: float) -> None:
    """Refuse a core that is near to too little of the inner sheet to build anything up on it."""
    import igl

    area = face_areas(V, F)
    squared = igl.point_mesh_squared_distance(V[F].mean(axis=1), *arrays(core))[0]
    bears = float(area[squared < near**2].sum() / area.sum())
    if bears < _BEARS:
        raise SolidError(
            f"a core would bear only {100 * bears:.0f} % of this model, since the rest has no room for one",
            hint="leave --core out, or make the model larger",
        )


def _is_thick(part: Body, least: float) -> bool:
    """Tell whether a part is thicker than some mm on the whole, as a plate of its volume and surface."""
    return bool(2 * part.volume() > least * part.surface_area())


def hollowed(
    core: Body, around: Depth, depth: float, wall: float, cell: float, up: Floats
) -> tuple[Body, int, float]:
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
        In one part. What is too small, or has no way out through the wall anywhere low, stays filled.
    drains : int
    filled : float, mm3, of hollows without a way out, or of all where none could be made
    """
    V, F = inset_surface(around, depth + wall, _COARSE * cell, wall)
    drains, filled = 0, 0.0
    inside = body(V, F) if len(F) else None
    if inside is not None and not sound(inside):  # where a lid crosses the sheet, signs of faces contradict
        inside = body(*inset_surface(around.by_winding(), depth + wall, _COARSE * cell, wall))
        if not sound(inside):
            return core, 0, core.volume()
    for hollow in inside.decompose() if inside is not None else []:
        if hollow.volume() < _SMALLEST * wall**3:
            continue
        empty = core - hollow
        for drain in _drains(hollow, wall, up):
            opened = empty - drain
            if sound(opened) and len(opened.decompose()) == 1:
                core, drains = opened, drains + 1
                break
        else:
            filled += hollow.volume()
    return core, drains, filled


def _drains(hollow: Body, wall: float, up: Floats) -> Iterator[Body]:
    """Give cylinders through the wall around a hollow: straight down first, then wherever it is near."""
    V, F = arrays(hollow)
    height, N = V @ up, vertex_normals(V, F)
    order = np.argsort(height, kind="stable")
    low = order[: max(int(_LOW * len(order)), 1)]
    first = V[order[0]]
    yield _cylinder(first + _DRAIN * wall * up, -up, (_LONGEST + _DRAIN) * wall, _DRAIN * wall)
    yield _cylinder(first - _DRAIN * wall * N[order[0]], N[order[0]], _THROUGH * wall, _DRAIN * wall)
    for k in low[:: max(len(low) // _PLACES, 1)].tolist():
        yield _cylinder(V[k] - _DRAIN * wall * N[k], N[k], _THROUGH * wall, _DRAIN * wall)


def _cylinder(start: Floats, along: Floats, length: float, radius: float) -> Body:
    """Give a cylinder that begins at a point and goes along a unit vector."""
    import manifold3d

    side = unit(np.cross(along, np.eye(3)[np.abs(along).argmin()]))
    axes = np.stack([side, np.cross(along, side), along])
    rod = manifold3d.Manifold.cylinder(length, radius, circular_segments=_SIDES)
    return rod.warp_batch(lambda p: p @ axes + start)
