"""Check that copies of outlines neither overlap nor leave holes."""

from itertools import product
from typing import Any

import numpy as np

from meshjig.errors import OptionError
from meshjig.mesh.types import Floats
from meshjig.tiling.svg.read_outlines import Outline, place

__all__ = ["check_covering", "copies_around"]


def check_covering(outlines: list[Outline], translations: Floats, tolerance: float, path: object) -> None:
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


def copies_around(tiles: list[Any], translations: Floats, tolerance: float) -> list[Floats]:
    """List the translations, (2,) each and zero first, whose copies may touch what the tiles reach over.

    Parameters
    ----------
    tiles : list of shapely.Polygon
    translations : (2, 2) float64
    tolerance : float
    """
    import shapely

    low_x, low_y, high_x, high_y = shapely.total_bounds(tiles)
    extent = np.array([high_x - low_x, high_y - low_y]) + tolerance
    reach = np.abs(translations).sum(0) + extent  # as far as the parallelogram that is looked at for holes
    n, m = np.ceil(np.linalg.norm(reach) * np.linalg.norm(np.linalg.inv(translations), axis=0)).astype(int)
    moves = np.array(list(product(range(-n, n + 1), range(-m, m + 1)))) @ translations
    moves = moves[(np.abs(moves) <= reach).all(1)]
    return list(moves[np.argsort(np.linalg.norm(moves, axis=1), kind="stable")])


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
    """Give a point in the largest part of a shape that is thicker than the tolerance."""
    import shapely

    parts = shapely.get_parts(shape.buffer(-tolerance / 2))
    parts = parts[shapely.area(parts) > 0]
    if len(parts) == 0:
        return None
    largest = parts[np.argmax(shapely.area(parts))]
    return np.array(largest.representative_point().coords[0])
