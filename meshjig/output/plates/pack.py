"""Which piece goes where on which plate: by rectangles, fast and always the same."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np

from meshjig.errors import OutputError
from meshjig.mesh.arrays import Floats, Ints
from meshjig.output.plates.printers import Plate

__all__ = ["Placements", "convex_ring", "fits", "footprint", "least_rectangle", "pack", "size_at"]


_MANY = 600  # outlines; more are packed by one rule only, since time grows with their square
_STEP = 1e-3  # mm; the packer counts whole steps, so that nothing is lost to rounding
_TURNS = np.radians(np.arange(180.0))  # tried where the least rectangle does not fit, but a diagonal might

_SMOOTH = 0.05  # mm; outlines are drawn and packed no finer
_SPECK = 0.01  # mm2; smaller holes are left out


class Placements(NamedTuple):
    """Where pieces go: a point p of piece i to R(turn[i]) p + shift[i] on plate[i]."""

    plate: Ints  # (n,), counted from 0
    turn: Floats  # (n,), radians, counterclockwise
    shift: Floats  # (n, 2), mm

    @property
    def n_plates(self) -> int:
        """Count the plates."""
        return int(self.plate.max(initial=-1)) + 1


def pack(outlines: Sequence[Floats], plate: Plate, gap: float) -> Placements:
    """Pack outlines onto as few plates as a handful of greedy rules find.

    Parameters
    ----------
    outlines : sequence of (k, 2) float64, mm
        Only their convex hulls count.
    plate : Plate
    gap : float, mm
        Between any two outlines, and from an outline to the border of the plate.

    Returns
    -------
    Placements
        An outline is turned to the least rectangle around it, or to a diagonal where only that fits. Of
        the packings with the fewest plates, the one with the fewest pieces on its last.

    Raises
    ------
    OutputError
        An outline fits no plate; ``ids`` names it.
    """
    rings = [convex_ring(points) for points in outlines]
    turn = _fitting_turns(rings, plate, gap)
    size = np.stack([size_at(ring, np.array([a]))[0] for ring, a in zip(rings, turn, strict=True)])
    steps = np.ceil((size + gap) / _STEP).astype(np.int64)
    bed = np.floor((np.array(plate[:2]) - gap) / _STEP).astype(np.int64)
    number, place, quarter = min(_packings(steps, bed), key=_rank)
    turn = turn + np.where(quarter, np.pi / 2, 0.0)
    lowest = np.stack([_lowest(points, a) for points, a in zip(rings, turn, strict=True)])
    return Placements(number, turn, place * _STEP + gap - lowest)


def fits(points: Floats, plate: Plate, gap: float) -> bool:
    """Tell whether an outline, (k, 2), mm, fits a plate by itself."""
    try:
        _fitting_turns([convex_ring(points)], plate, gap)
    except OutputError:
        return False
    return True


def _fitting_turns(rings: Sequence[Floats], plate: Plate, gap: float) -> Floats:
    """Turn each convex ring to its least rectangle, or else so that it fits the plate; (n,), radians."""
    room = np.sort(np.array(plate[:2]) - 2 * gap)
    turns = np.array([least_rectangle(ring) for ring in rings])
    for i, ring in enumerate(rings):
        choices = np.concatenate([turns[i : i + 1], _TURNS])
        size = size_at(ring, choices)
        fits = np.sort(size, axis=1)[:, 0] <= room[0]
        fits &= size.max(axis=1) <= room[1]
        if not fits.any():
            raise OutputError(f"outline {i + 1} fits no plate of {plate}", ids=[i])
        if not fits[0]:
            turns[i] = choices[np.where(fits, size.prod(axis=1), np.inf).argmin()]
    return turns


def _packings(steps: Ints, bed: Ints) -> Iterator[tuple[Ints, Ints, Ints]]:
    """Pack by several rules; each gives the plate (n,), the place (n, 2) and whether turned (n,)."""
    import rectpack
    from rectpack import guillotine, maxrects, packer

    rules = (maxrects.MaxRectsBaf, maxrects.MaxRectsBssf, guillotine.GuillotineBafMinas)
    orders = (packer.SORT_SSIDE, packer.SORT_LSIDE, packer.SORT_AREA)
    presses = [rectpack.PackerBFF(pack_algo=rule, sort_algo=order) for rule in rules for order in orders]
    presses += [rectpack.PackerGlobal(pack_algo=rule) for rule in rules]
    for press in presses if len(steps) <= _MANY else presses[-4:-3]:
        for i, (width, depth) in enumerate(steps.tolist()):
            press.add_rect(width, depth, rid=i)
        press.add_bin(*bed.tolist(), count=float("inf"))
        press.pack()
        rows = np.array(press.rect_list(), np.int64).reshape(-1, 6)  # plate, x, y, width, depth, id
        rows = rows[np.argsort(rows[:, 5])]
        yield rows[:, 0], rows[:, 1:3], rows[:, 3] != steps[:, 0]


def _rank(packing: tuple[Ints, Ints, Ints]) -> tuple[int, int]:
    """The last plate's number and how many lie on it; less is better."""
    number = packing[0]
    last = int(number.max())
    return last, int((number == last).sum())


def _lowest(points: Floats, turn: float) -> Floats:
    cos, sin = np.cos(turn), np.sin(turn)
    return (points @ np.array([[cos, sin], [-sin, cos]])).min(axis=0)


def footprint(V: Floats, F: Ints) -> Any:
    """The shadow of a piece on the xy plane.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, closed and oriented outward

    Returns
    -------
    shapely.Polygon, mm
        Within 0.05 mm of the shadow; the shadow of the convex hull where the piece is no proper solid.
    """
    import manifold3d
    import shapely

    mesh = manifold3d.Mesh64(np.ascontiguousarray(V), F.astype(np.uint64))
    loops = manifold3d.Manifold(mesh).project().to_polygons()
    outlines = [shapely.Polygon(loop) for loop in loops if len(loop) > 2]
    if not outlines:
        return shapely.MultiPoint(V[:, :2]).convex_hull
    largest = max(outlines, key=lambda outline: outline.area)
    holes = [hole.exterior for hole in outlines if not hole.exterior.is_ccw and hole.area > _SPECK]
    return shapely.Polygon(largest.exterior, holes).simplify(_SMOOTH)


def convex_ring(points: Floats) -> Floats:
    """Give the corners of the convex hull of points (n, 2), counterclockwise; (k, 2)."""
    from scipy.spatial import ConvexHull

    return points[ConvexHull(points).vertices]


def least_rectangle(ring: Floats) -> float:
    """Find the turn at which a convex ring needs the least rectangle along the axes.

    Parameters
    ----------
    ring : (k, 2) float64, convex, counterclockwise

    Returns
    -------
    float
        Radians, counterclockwise, in [0, pi); the rectangle is no deeper than wide.

    References
    ----------
    Freeman and Shapira, "Determining the minimum-area encasing rectangle for an arbitrary closed curve",
    1975: one side of it lies along a side of the ring.
    """
    side = np.roll(ring, -1, axis=0) - ring
    turns = -np.arctan2(side[:, 1], side[:, 0])
    sizes = size_at(ring, turns)
    best = int(sizes.prod(axis=1).argmin())
    turn = turns[best] + (np.pi / 2 if sizes[best, 1] > sizes[best, 0] else 0.0)
    return float(turn % np.pi)


def size_at(points: Floats, turns: Floats) -> Floats:
    """Give the width and depth of points (n, 2) at turns (k,), radians; (k, 2)."""
    cos, sin = np.cos(turns), np.sin(turns)
    x = points @ np.stack([cos, -sin])
    y = points @ np.stack([sin, cos])
    return np.stack([np.ptp(x, axis=0), np.ptp(y, axis=0)], 1)
