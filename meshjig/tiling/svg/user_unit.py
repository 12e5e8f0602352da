"""A user's own outlines, from an SVG file, as a tiling."""

import logging
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from meshjig.errors import OptionError
from meshjig.mesh.arrays import Floats
from meshjig.mesh.measure import signed_area
from meshjig.tiling.assemble_unit import NoOtherSide, assemble
from meshjig.tiling.check_unit import check_unit, locked_edges
from meshjig.tiling.svg.corners import copies_around, split_at_corners
from meshjig.tiling.svg.read_paths import bounded, place
from meshjig.tiling.svg.tile_paths import SNAP, Outline, read_outlines
from meshjig.tiling.svg.translations import Border, find_translations
from meshjig.tiling.unit import Unit

__all__ = ["user_unit"]

_NODES = 1200  # nodes of all outlines that are tried to lie on each other
_LONGEST = 0.04  # of a tile's edge, segments of the edges' curves

_log = logging.getLogger(__name__)


def user_unit(path: str | Path) -> Unit:
    """Make a tiling of the closed paths in an SVG file.

    Each path is a tile, and all of them together are repeated. The two translations are found from the
    borders themselves. Gaps and overlaps narrower than 0.5 % of a tile's size are snapped shut.

    Parameters
    ----------
    path : str or Path

    Returns
    -------
    Unit

    Raises
    ------
    OptionError
        The file can't be read, a path is open or crosses itself, copies overlap or leave a hole; the
        sentence says where, in the drawing's own coordinates.

    Notes
    -----
    When no two tiles hold on to each other, that is said in a warning.
    """
    outlines = bounded(read_outlines, path)
    rings = [outline.points for outline in outlines]
    area = sum(signed_area(ring) for ring in rings)
    tolerance = SNAP * float(np.sqrt(area / len(rings)))
    nodes = np.vstack([outline.sharpest(_NODES // len(outlines)) for outline in outlines])
    translations = find_translations(Border(rings, tolerance), nodes, area)
    if translations is None:
        raise OptionError(
            f"{path}: no two stretches of its border fit each other, such as at {place(rings[0][0])}",
            hint="draw opposite sides as copies of each other",
        )
    _check_covering(outlines, translations, tolerance, path)
    edges = split_at_corners(outlines, translations, tolerance, path)
    try:
        unit = assemble(edges, translations, 4 * SNAP)
    except NoOtherSide as error:
        raise OptionError(f"{path}: the tiles on both sides of {place(error.at)} don't fit") from None
    unit = _densified(unit)
    try:
        check_unit(unit)
    except OptionError as error:
        raise OptionError(f"{path}: {error}") from None
    if not locked_edges(unit).any():
        _log.warning("%s: the tiles don't interlock: no two of them hold on to each other", path)
    return unit


def _check_covering(outlines: list[Outline], translations: Floats, tolerance: float, path: object) -> None:
    """Lay copies of the outlines around them and look for overlaps, then for holes.

    Parameters
    ----------
    outlines : list of Outline
    translations : (2, 2) float64
    tolerance : float, width up to which overlaps and holes are left to be snapped shut
    path : the file, for the message

    Raises
    ------
    OptionError
        The sentence says where, and how much.
    """
    import shapely

    tiles = [shapely.Polygon(outline.points) for outline in outlines]
    copies = [
        (k, by, shapely.transform(tiles[k], lambda points, by=by: points + by))
        for by in copies_around(tiles, translations, tolerance)
        for k in range(len(tiles))
    ]
    tile_area = sum(tile.area for tile in tiles) / len(tiles)
    _check_overlaps(outlines, tiles, copies, tolerance, tile_area, path)
    parts = shapely.union_all([copy for *_, copy in copies])
    middle = np.mean([np.array(tile.centroid.coords[0]) for tile in tiles], axis=0)
    spanned = shapely.Polygon(middle + np.array([(0, 0), (1, 0), (1, 1), (0, 1)]) @ translations)
    holes = spanned.difference(parts)
    at = _thickest(holes, tolerance)
    if at is not None:
        raise OptionError(
            f"{path}: its copies leave a hole at {place(at)}, {holes.area / tile_area:.1%} of a tile",
            hint="a bump on one side needs a hollow of the same shape on the other",
        )


def _check_overlaps(
    outlines: list[Outline],
    tiles: list[Any],
    copies: list[Any],
    tolerance: float,
    tile_area: float,
    path: object,
) -> None:
    import shapely

    tree = shapely.STRtree([copy for *_, copy in copies])
    worst: tuple[float, str] | None = None
    for i, j in zip(*tree.query(tiles, predicate="intersects"), strict=True):
        k, by, copy = copies[j]
        if k == i and not by.any():
            continue
        shared = tiles[i].intersection(copy)
        at = _thickest(shared, tolerance)
        if at is not None and (worst is None or shared.area > worst[0]):
            who = f"copies of {outlines[i].name}" if k == i else f"{outlines[i].name} and {outlines[k].name}"
            worst = shared.area, f"{who} overlap at {place(at)}, by {shared.area / tile_area:.1%} of a tile"
    if worst is not None:
        raise OptionError(f"{path}: {worst[1]}", hint="a bump on one side needs a hollow on the other")


def _thickest(shape: Any, tolerance: float) -> Floats | None:
    """A point in the largest part of a shape that is thicker than the tolerance."""
    import shapely

    parts = shapely.get_parts(shape.buffer(-tolerance / 2))
    parts = parts[shapely.area(parts) > 0]
    if len(parts) == 0:
        return None
    largest = parts[np.argmax(shapely.area(parts))]
    return np.array(largest.representative_point().coords[0])


def _densified(unit: Unit) -> Unit:
    """Divide long segments of a unit's curves, so that they bend where the plane is bent."""
    curves = []
    for curve in unit.curves or ():
        parts = np.ceil(np.linalg.norm(np.diff(curve, axis=0), axis=1) / _LONGEST).astype(int)
        at = np.concatenate([k + np.arange(n) / n for k, n in enumerate(parts)] + [[len(parts)]])
        curves.append(np.stack([np.interp(at, np.arange(len(curve)), curve[:, axis]) for axis in (0, 1)], 1))
    return replace(unit, curves=tuple(curves))
