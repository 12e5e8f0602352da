"""A unit's tiles without their knobs: what sizes and places are tried with."""

from typing import Any, NamedTuple

import numpy as np

from meshjig.mesh.arrays import Floats, Ints
from meshjig.tiling.net import Placing, copies_over, distinct, lay_net, row_keys, unwrapped
from meshjig.tiling.unit import Unit, edge_ends, tile_outlines

__all__ = ["Laid", "TileShapes"]

COARSE = 0.03  # of a tile, that the curve of an edge may be off
SAMPLES = 24  # along the edge of a square as large as the mean tile


class Laid(NamedTuple):
    """Tiles over a box, numbered; those that are copies a period away have one number."""

    tiles: Any  # (t,) array of shapely.Polygon, mm
    of_tile: Ints  # (t,), the number of each
    lines: Any  # (e,) array of shapely.LineString, the edges
    of_side: Ints  # (e, 2), the tiles on their left and right
    of_point: Ints  # (k,), the tile at each of the points asked for


class TileShapes:
    """The tiles of a unit with plain edges.

    Parameters
    ----------
    unit : Unit
    """

    def __init__(self, unit: Unit) -> None:
        self.unit = unit
        self._edges = _plain_edges(unit)
        self._outlines = tile_outlines(unit, self._edges)
        self._drawn = np.concatenate(self._outlines)
        self._lookup = self._sampled()

    def lay(self, placing: Placing, bounds: Floats, points: Floats) -> Laid:
        """Lay tiles over a box, and tell in which of them points (k, 2), mm, lie."""
        import shapely

        unit = self.unit
        net = lay_net(unit, placing, bounds, 0.0)
        at = net.copy @ unit.translations
        by_kind = np.argsort(net.kind, kind="stable")
        lines = [
            shapely.linestrings(placing(curve + at[net.kind == kind][:, None]))
            for kind, curve in enumerate(self._edges)
        ]
        copies = copies_over(unit, self._drawn, placing, bounds)
        at = copies @ unit.translations
        tiles = [shapely.polygons(placing(outline + at[:, None])) for outline in self._outlines]
        number = np.repeat(np.arange(unit.n_tiles), len(copies))
        rows = [
            np.column_stack([number, np.tile(copies, (unit.n_tiles, 1))]),
            (unit.sides[net.kind] + np.column_stack([0 * net.kind, net.copy])[:, None])[by_kind].reshape(
                -1, 3
            ),
            self._tile_at(placing, points[None]),
        ]
        label = distinct(unwrapped(np.concatenate(rows), placing.wrap)[0])[1]
        of_tile, of_side, of_point = np.split(label, np.cumsum([len(part) for part in rows])[:2])
        return Laid(np.concatenate(tiles), of_tile, np.concatenate(lines), of_side.reshape(-1, 2), of_point)

    def counts(self, placing: Placing, points: Floats, shifts: Floats) -> Ints:
        """Count the points in every tile, for several places of the tiling.

        Parameters
        ----------
        placing : Placing
        points : (n, 2) float64, mm
        shifts : (s, 2) float64, how far the tiling is moved back, in translations

        Returns
        -------
        (s, t) int64, tiles numbered afresh for every shift; 0 where one holds no point
        """
        moved = points + (shifts @ self.unit.translations @ placing.matrix)[:, None]
        rows = unwrapped(self._tile_at(placing, moved), placing.wrap)[0]
        key, most = row_keys(rows)
        key += np.repeat(np.arange(len(shifts)), len(points)) * most
        return np.bincount(key, minlength=len(shifts) * most).reshape(len(shifts), most)

    def _tile_at(self, placing: Placing, points: Floats) -> Ints:
        """The tile (number, i, j) at points (s, n, 2), row after row; near an edge, maybe the next."""
        at = placing.back(points.reshape(-1, 2)) @ np.linalg.inv(self.unit.translations)
        whole = np.floor(at).astype(np.int64)
        n = len(self._lookup)
        where = np.minimum(((at - whole) * n).astype(np.int64), n - 1)
        rows = self._lookup[where[:, 0], where[:, 1]]
        rows[:, 1:] += whole
        return rows

    def _sampled(self) -> Ints:
        """The tile (number, i, j) at every sample of the translations' parallelogram, (n, n, 3)."""
        import shapely

        unit = self.unit
        n = int(np.clip(np.ceil(SAMPLES * np.sqrt(unit.n_tiles)), SAMPLES, 400))
        place = (np.stack(np.meshgrid(np.arange(n), np.arange(n), indexing="ij"), -1) + 0.5) / n
        points = place.reshape(-1, 2) @ unit.translations
        box = np.concatenate([points.min(0), points.max(0)])
        copies = copies_over(unit, self._drawn, Placing(1.0), box)
        rows = np.column_stack(
            [np.repeat(np.arange(unit.n_tiles), len(copies)), *np.tile(copies.T, unit.n_tiles)]
        )
        at = copies @ unit.translations
        tiles = np.concatenate([shapely.polygons(outline + at[:, None]) for outline in self._outlines])
        found = shapely.STRtree(tiles).nearest(shapely.points(points))
        return rows[found].reshape(n, n, 3)


def _plain_edges(unit: Unit) -> list[Floats]:
    """The edges as straight lines, or as their curves with fewer points."""
    import shapely

    if unit.curves is None:
        return list(edge_ends(unit))
    return [shapely.get_coordinates(shapely.LineString(curve).simplify(COARSE)) for curve in unit.curves]
