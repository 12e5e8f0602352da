"""Check that a unit is a tiling, and tell which of its tiles hold on to each other in the plane."""

from typing import Any

import numpy as np

from meshjig.errors import OptionError
from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.tiling.unit import Unit, edge_curves, edge_ends, knob_sides, tile_outlines

__all__ = ["check_unit", "locked_edges"]

_CLOSE = 1e-6  # of a tile
_SLACK = 0.01  # radians that a border must curl back by


def check_unit(unit: Unit) -> None:
    """Check that copies of a unit's tiles by its translations cover the plane once.

    Every tile's edges are one closed loop with the tile on their left, the tiles' areas add up to that
    of the translations' parallelogram, mean 1, and no two edges meet but at their ends, on whichever
    side their knobs stand.

    Parameters
    ----------
    unit : Unit

    Raises
    ------
    OptionError
        The sentence names the first fault.
    """
    area = float(np.linalg.det(unit.translations))
    if not area > 0:
        raise OptionError("the second translation does not lie on the left of the first")
    if abs(area / unit.n_tiles - 1) > _CLOSE:
        raise OptionError(f"the mean area of a tile is {area / unit.n_tiles:.6g}, not 1")
    _check_arrays(unit)
    curves = edge_curves(unit)
    try:
        outlines = tile_outlines(unit, curves)
    except ValueError as error:
        raise OptionError(str(error)) from None
    _check_tiles(outlines, area)
    _check_crossings(unit)


def locked_edges(unit: Unit) -> Bools:
    """Tell which edges lie between two tiles that can't be pulled apart in any one direction.

    A tile can be pulled off its neighbour if all their border's normals point to one side; so the border,
    all edges between the two, locks when its directions leave no half turn free.

    Parameters
    ----------
    unit : Unit

    Returns
    -------
    (e,) bool
    """
    borders: dict[tuple[int, ...], list[tuple[int, Floats]]] = {}
    for edge, curve in enumerate(edge_curves(unit)):
        (left, i, j), (right, k, m) = unit.sides[edge].tolist()
        forth, back = (left, right, k - i, m - j), (right, left, i - k, j - m)
        along = np.diff(curve if forth <= back else curve[::-1], axis=0)
        borders.setdefault(min(forth, back), []).append((edge, along))
    locked = np.zeros(len(unit.sides), bool)
    for border in borders.values():
        locked[[edge for edge, _ in border]] = _curls_back(np.vstack([along for _, along in border]))
    return locked


def _check_arrays(unit: Unit) -> None:
    n = len(unit.ends)
    if unit.ends.shape != (n, 2, 3) or unit.sides.shape != (n, 2, 3):
        raise OptionError("ends and sides must both have the shape (e, 2, 3)")
    for numbers, count, what in (
        (unit.ends, len(unit.corners), "corner"),
        (unit.sides, unit.n_tiles, "tile"),
    ):
        if not np.array_equal(np.unique(numbers[..., 0]), np.arange(count)):
            raise OptionError(f"edges must name each of the {count} {what}s and no other {what}")
    if (unit.curves is None) == (unit.template is None):
        raise OptionError("a unit has either curves or a template for its knobs")
    if unit.knob_side is not None and unit.knob_side.shape != (n,):
        raise OptionError("knob_side must have one entry an edge")
    if unit.curves is not None:
        if len(unit.curves) != n:
            raise OptionError("there must be one curve an edge")
        for edge, (curve, ends) in enumerate(zip(unit.curves, edge_ends(unit), strict=True)):
            if np.abs(curve[[0, -1]] - ends).max() > _CLOSE:
                raise OptionError(f"the curve of edge {edge} does not run from its one corner to the other")


def _check_tiles(outlines: list[Floats], area: float) -> None:
    import shapely

    areas = []
    for tile, outline in enumerate(outlines):
        ring = shapely.LinearRing(outline)
        if not ring.is_simple:
            raise OptionError(f"the outline of tile {tile} crosses itself")
        if not ring.is_ccw:
            raise OptionError(f"tile {tile} does not lie on the left of its edges")
        areas.append(shapely.Polygon(ring).area)
    if abs(sum(areas) - area) > _CLOSE * area:
        raise OptionError(f"the tiles' areas add up to {sum(areas):.6g}, that of the unit is {area:.6g}")


def _check_crossings(unit: Unit) -> None:
    """Lay the edges, on either side where both will do, over those of the copies around."""
    import shapely

    edge, side = _sided_edges(unit)
    lines = np.empty(len(edge), object)
    for one in (1, -1):
        drawn = edge_curves(unit, np.full(len(unit.ends), one))
        for k in np.flatnonzero(side == one):
            lines[k] = shapely.LineString(drawn[edge[k]])
    moved = [
        (shapely.transform(lines, lambda points, by=by @ unit.translations: points + by), by)
        for by in _shifts_in_reach(unit, lines)
    ]
    every = np.concatenate([copies for copies, _ in moved])
    which = np.tile(np.arange(len(lines)), len(moved))
    at_home = np.repeat([not by.any() for _, by in moved], len(lines))
    a, b = shapely.STRtree(every).query(lines, predicate="intersects")
    other = ~(at_home[b] & (edge[a] == edge[which[b]]))
    for i, j in zip(a[other], b[other], strict=True):
        if not _meet_at_ends(lines[i], every[j]):
            raise OptionError(f"edges {edge[i]} and {edge[which[j]]} cross")


def _sided_edges(unit: Unit) -> tuple[Ints, Ints]:
    edges = np.arange(len(unit.ends))
    if unit.template is None:
        return edges, np.ones(len(edges), np.int64)
    either = edges if unit.knob_side is None else np.flatnonzero(unit.knob_side == 0)
    sides = knob_sides(unit)
    return np.concatenate([edges, either]), np.concatenate([sides, -sides[either]])


def _shifts_in_reach(unit: Unit, lines: Any) -> list[Ints]:
    """List the translations by which a copy of the edges may touch them, as (2,) int64."""
    import shapely

    low_x, low_y, high_x, high_y = shapely.total_bounds(lines)
    reach = np.hypot(high_x - low_x, high_y - low_y)
    inverse = np.linalg.inv(unit.translations)
    n, m = np.ceil(reach * np.linalg.norm(inverse, axis=0)).astype(int)
    grid = np.stack(np.meshgrid(np.arange(-n, n + 1), np.arange(-m, m + 1), indexing="ij"), -1).reshape(-1, 2)
    by = np.abs(grid @ unit.translations)
    return list(grid[(by[:, 0] <= high_x - low_x) & (by[:, 1] <= high_y - low_y)])


def _meet_at_ends(a: Any, b: Any) -> bool:
    import shapely

    met = shapely.get_coordinates(a.intersection(b))
    ends = [np.asarray(line.coords)[[0, -1]] for line in (a, b)]
    return all((np.linalg.norm(met[:, None] - end, axis=2).min(1) < _CLOSE).all() for end in ends)


def _curls_back(along: Floats) -> bool:
    angles = np.sort(np.arctan2(along[:, 1], along[:, 0]))
    widest = np.diff(np.r_[angles, angles[0] + 2 * np.pi]).max()
    return bool(widest < np.pi - _SLACK)
