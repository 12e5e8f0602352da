"""How large a tile must be for the puzzle to have the wanted number of pieces."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from meshjig.measure import face_areas, unit
from meshjig.stitch import stitch, sum_borders
from meshjig.tiling import Grid, chart_polygons, place_grid
from meshjig.topology import edges, next_halfedge
from meshjig.types import Atlas, Floats, Ints, RegionGraph

__all__ = ["TileChoice", "choose_tiles"]

_SHIFTS = ((0.0, 0.0), (0.0, 0.5), (0.5, 0.0), (0.5, 0.5))


@dataclass(frozen=True)
class TileChoice:
    """A size and a place for the grids, and what is expected of them."""

    size: float  # edge of a tile, mm
    shift: tuple[float, float]
    expected: int  # pieces


def choose_tiles(
    atlas: Atlas, pieces: int, share: float, least_border: float = 0.0, size: float | None = None
) -> TileChoice:
    """Find the tile size and the grid's place that give a number of pieces.

    Tiles with straight edges are clipped by the charts' polygons and stitched by the same rule as
    the real ones: knobs shift little of that, and a trial costs hundredths of a second.

    Parameters
    ----------
    atlas : Atlas
    pieces : int
    share, least_border : float, see `meshjig.stitch.stitch`
    size : float, mm; given, only the grid's place is chosen, for the most even pieces

    Returns
    -------
    TileChoice
    """
    trial = _Trial(atlas, share, least_border)
    if size is not None:
        best = min(((*trial.count(size, shift), shift) for shift in _SHIFTS), key=lambda c: c[1])
        return TileChoice(size, best[2], best[0])
    found: list[tuple[float, float, float, tuple[float, float], int]] = []
    s = float(np.sqrt(face_areas(atlas.mesh.V, atlas.mesh.F).sum() / pieces))
    for _ in range(6):
        counts = []
        for shift in _SHIFTS:
            n, cv = trial.count(s, shift)
            miss = abs(n - pieces) / pieces
            counts.append(n)
            found.append((round(miss / 0.03), cv, s, shift, n))
        if min(found)[0] == 0 and len(found) > len(_SHIFTS):
            break
        s *= float(np.clip(np.sqrt(np.mean(counts) / pieces), 0.6, 1.6))
    _, _, s, shift, n = min(found)
    return TileChoice(s, shift, n)


class _Trial:
    """Straight tiles clipped by the charts, again and again."""

    def __init__(self, atlas: Atlas, share: float, least_border: float) -> None:
        import shapely

        self.polygons = [p.simplify(0.05) for p in chart_polygons(atlas)]
        self.share, self.least_border = share, least_border
        for polygon in self.polygons:
            shapely.prepare(polygon)
        e = edges(atlas.mesh.F)
        h = np.flatnonzero(e.twin > np.arange(len(e.twin)))
        corner = atlas.F_uv.ravel()
        t = e.twin[h]
        seam = (corner[h] != corner[next_halfedge(t)]) | (corner[next_halfedge(h)] != corner[t])
        h, t = h[seam], t[seam]
        self.here, self.there = (
            (atlas.uv[corner[x]] + atlas.uv[corner[next_halfedge(x)]]) / 2 for x in (h, t)
        )
        ends = atlas.mesh.V[e.E[e.edge_of_halfedge[h]]]
        self.seam_length = np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1)

    def count(self, size: float, shift: tuple[float, float]) -> tuple[int, float]:
        """Give the number of pieces and their areas' coefficient of variation."""
        graph = self._graph(size, shift)
        stitching = stitch(graph, self.share, size**2, self.least_border)
        area = np.bincount(stitching.piece_of_region, graph.area)
        return stitching.n_pieces, float(area.std() / area.mean())

    def _graph(self, size: float, shift: tuple[float, float]) -> RegionGraph:
        import shapely

        regions, lines = [], []
        for polygon in self.polygons:
            grid = place_grid(polygon, size, shift)
            regions.append(_clipped_tiles(polygon, grid))
            ends = grid.nodes().reshape(-1, 2)[grid.inner_edges()[0]]
            lines.append(_clipped(polygon, shapely.linestrings(ends)))
        region, line = np.concatenate(regions), np.concatenate(lines)
        line = line[shapely.get_type_id(line) == 1]
        tree = shapely.STRtree(region)
        xy = shapely.get_coordinates(shapely.line_interpolate_point(line, 0.5, normalized=True))
        first = shapely.get_coordinates(shapely.get_point(line, 0))
        along = xy - first
        across = 1e-3 * unit(np.stack([-along[:, 1], along[:, 0]], 1))
        here = _nearest(tree, np.vstack([xy + across, self.here]))
        there = _nearest(tree, np.vstack([xy - across, self.there]))
        length = np.concatenate([shapely.length(line), self.seam_length])
        seam = np.arange(len(length)) >= len(line)
        differ = here != there
        return sum_borders(shapely.area(region), here[differ], there[differ], length[differ], seam[differ])


def _clipped_tiles(polygon: Any, grid: Grid) -> np.ndarray:
    import shapely

    low = grid.nodes()[:-1, :-1].reshape(-1, 2)
    high = low + grid.size
    return _clipped(polygon, shapely.box(low[:, 0], low[:, 1], high[:, 0], high[:, 1]))


def _clipped(polygon: Any, shapes: np.ndarray) -> np.ndarray:
    """Give the parts of shapes that lie in a polygon."""
    import shapely

    shapes = shapes[shapely.intersects(polygon, shapes)]
    crossing = ~shapely.contains_properly(polygon, shapes)
    parts = shapely.get_parts(shapely.intersection(shapes[crossing], polygon))
    parts = parts[shapely.get_dimensions(parts) == shapely.get_dimensions(shapes[:1]).max(initial=0)]
    return np.concatenate([shapes[~crossing], parts])


def _nearest(tree: Any, xy: Floats) -> Ints:
    import shapely

    found: Ints = tree.nearest(shapely.points(xy)).astype(np.int64)
    return found
