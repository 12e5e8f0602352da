"""How large a tile must be for the puzzle to have the wanted number of pieces."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from meshjig.layout.stitch import stitch, sum_borders
from meshjig.mesh.arrays import Floats, Ints, connected
from meshjig.mesh.halfedges import edge_keys, next_halfedge
from meshjig.mesh.measure import face_areas, sums
from meshjig.mesh.measure import unit as unit_length
from meshjig.mesh.types import Atlas, RegionGraph
from meshjig.tiling import (
    Fit,
    Placing,
    TileShapes,
    Unit,
    chart_borders,
    chart_periods,
    chart_polygons,
    squares,
)
from meshjig.tiling.template import classic

__all__ = ["TileChoice", "choose_tiles"]

ROUNDS = 6  # sizes that are tried at most
ENOUGH = 3  # at least
PLACES = 2  # of the tiles, that each size is tried with
LOCKED = 0.6  # of a tile's edge: a straight border as long as that is taken to have a knob
NEAR = 0.03  # of the number of pieces; choices as near as that differ by their pieces only


@dataclass(frozen=True)
class TileChoice:
    """A size and a place for the tiles of every chart, and what is expected of them."""

    size: float  # mm, edge of a square as large as the mean tile
    placings: tuple[Placing, ...]  # one a chart
    expected: int  # pieces


def choose_tiles(
    atlas: Atlas,
    pieces: int,
    share: float,
    least_border: float = 0.0,
    size: float | None = None,
    *,
    unit: Unit | None = None,
    angle: float | None = None,
) -> TileChoice:
    """Find the size of tiles and their place on every chart that give a number of pieces.

    Tiles without knobs are clipped by the charts' polygons and stitched by the same rule as the real
    ones: knobs shift little of that, and a trial costs hundredths of a second.

    Parameters
    ----------
    atlas : Atlas
    pieces : int
    share, least_border : float, see `meshjig.layout.stitch.stitch`
    size : float, mm; given, only the tiles' places are chosen
    unit : Unit, the tiling; squares with classic knobs if not given
    angle : float, degrees, optional
        How the tiling is turned; chosen chart by chart if not given, so that few tiles are clipped.

    Returns
    -------
    TileChoice
    """
    s = size or float(np.sqrt(face_areas(atlas.mesh.V, atlas.mesh.F).sum() / pieces))
    shapes, polygons = TileShapes(unit or squares(classic)), chart_polygons(atlas)
    fit = Fit(polygons, chart_periods(atlas), shapes, s, angle)
    trial = _Trial(atlas, polygons, shapes, share, least_border)
    found: list[tuple[float, float, int, TileChoice]] = []
    for k in range(1 if size else ROUNDS):
        counts = []
        for placings in fit.placings(s, PLACES):
            n, flaw = trial.count(placings)
            counts.append(n)
            miss = round(abs(n - pieces) / pieces / NEAR) if not size else 0
            found.append((miss, flaw, len(found), TileChoice(s, placings, n)))
        if k + 1 >= ENOUGH and min(found)[0] == 0:
            break
        s *= float(np.clip(np.sqrt(np.mean(counts) / pieces), 0.6, 1.6)) * (1 + 1e-3 * k)
    return min(found)[-1]


class _Trial:
    """Plain tiles clipped by the charts, again and again."""

    def __init__(
        self, atlas: Atlas, polygons: list[Any], shapes: TileShapes, share: float, least_border: float
    ) -> None:
        import shapely

        self.polygons = [polygon.simplify(0.05) for polygon in polygons]
        self.shapes, self.share, self.least_border = shapes, share, least_border
        shapely.prepare(self.polygons)
        F, corner = atlas.mesh.F, atlas.F_uv.ravel()
        h = chart_borders(atlas.F_uv)
        ends = np.stack([F.ravel()[h], F.ravel()[next_halfedge(h)]], 1)
        key = edge_keys(ends, len(atlas.mesh.V))
        order = np.argsort(key, kind="stable")
        twice = np.flatnonzero(key[order][1:] == key[order][:-1])
        both = np.stack([order[twice], order[twice + 1]])
        self.seam_points = (atlas.uv[corner[h]] + atlas.uv[corner[next_halfedge(h)]])[both] / 2
        self.seam_chart = atlas.chart_of_face[h // 3][both]
        across = atlas.mesh.V[ends[both[0]]]
        self.seam_length = np.linalg.norm(across[:, 0] - across[:, 1], axis=1)

    def count(self, placings: tuple[Placing, ...]) -> tuple[int, float]:
        """Give the number of pieces, and how uneven, badly locked and cut up the tiles are."""
        graph, size = self._graph(placings), placings[0].size
        piece = stitch(graph, self.share, size**2, self.least_border).piece_of_region
        area = np.bincount(piece, graph.area)
        pairs = np.sort(piece[graph.pairs], axis=1)
        between = pairs[:, 0] != pairs[:, 1]
        _, pair = np.unique(pairs[between] @ np.array([len(area), 1]), return_inverse=True)
        length, seam = graph.length[between], graph.seam[between]
        plain = np.bincount(pair, length)[np.bincount(pair, length * ~seam) < LOCKED * size].sum()
        plain /= max(length.sum(), 1e-300)
        small = (graph.area < size**2 / 3).mean()
        return len(area), float(2 * area.std() / area.mean() + plain + small / 2)

    def _graph(self, placings: tuple[Placing, ...]) -> RegionGraph:
        import shapely

        regions, labels, lines, sides = [], [], [], []
        at_seam = np.zeros_like(self.seam_chart)
        n_labels = 0
        for chart, (polygon, placing) in enumerate(zip(self.polygons, placings, strict=True)):
            mine = self.seam_chart == chart
            laid = self.shapes.lay(placing, np.array(polygon.bounds), self.seam_points[mine])
            tiles, of_tile = _clipped(polygon, laid.tiles)
            line, of_line = _clipped(polygon, laid.lines)
            regions.append(tiles)
            labels.append(laid.of_tile[of_tile] + n_labels)
            lines.append(line)
            sides.append(laid.of_side[of_line] + n_labels)
            at_seam[mine] = laid.of_point + n_labels
            n_labels += len(laid.of_tile) + len(laid.of_side)
        region, label, line, side = (np.concatenate(parts) for parts in (regions, labels, lines, sides))
        middle, ahead = (
            shapely.get_coordinates(shapely.line_interpolate_point(line, t, normalized=True))
            for t in (0.5, 0.501)
        )
        along = unit_length(ahead - middle)
        across = 1e-3 * np.stack([-along[:, 1], along[:, 0]], 1)  # mm, from a line into a tile
        here, there = (
            _regions_at(
                region,
                label,
                np.concatenate([side[:, k], at_seam[k]]),
                np.concatenate([middle + (across, -across)[k], self.seam_points[k]]),
            )
            for k in (0, 1)
        )
        length = np.concatenate([shapely.length(line), self.seam_length])
        seam = np.arange(len(length)) >= len(line)
        whole = _one_over_seams(label, here[seam], there[seam])
        area = sums(whole, shapely.area(region), int(whole.max()) + 1)
        here, there = whole[here], whole[there]
        differ = here != there
        return sum_borders(area, here[differ], there[differ], length[differ], seam[differ])


def _regions_at(region: Any, label: Ints, wanted: Ints, points: Floats) -> Ints:
    """Give the region with a wanted label (k,), the one next to a point (k, 2) where there are several."""
    import shapely

    n = int(max(label.max(), wanted.max(initial=0))) + 1
    parts = np.bincount(label, minlength=n)[wanted]
    last = np.zeros(n, np.int64)
    last[label] = np.arange(len(label))
    found = last[wanted]
    unclear = np.flatnonzero(parts != 1)
    found[unclear] = shapely.STRtree(region).nearest(shapely.points(points[unclear]))
    return found


def _one_over_seams(label: Ints, here: Ints, there: Ints) -> Ints:
    """Number regions again, (r,): those that meet over a seam with one label are one."""
    one = label[here] == label[there]
    return connected(len(label), here[one], there[one])[1]


def _clipped(polygon: Any, shapes: Any) -> tuple[Any, Ints]:
    """Give the parts of shapes that lie in a polygon, and the shape that each part is of."""
    import shapely

    inside = np.flatnonzero(shapely.intersects(polygon, shapes))
    crossing = ~shapely.contains_properly(polygon, shapes[inside])
    parts, of_shape = shapely.get_parts(
        shapely.intersection(shapes[inside[crossing]], polygon), return_index=True
    )
    whole = shapely.get_dimensions(parts) == shapely.get_dimensions(shapes[:1]).max(initial=0)
    source = np.concatenate([inside[~crossing], inside[crossing][of_shape[whole]]])
    return np.concatenate([shapes[inside[~crossing]], parts[whole]]), source
