"""Stitching: which regions of the cut surface become one piece."""

import heapq

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.halfedges import edge_keys, edges
from meshjig.mesh.measure import face_areas, sums
from meshjig.mesh.types import CutMesh, RegionGraph, StitchFacts, Stitching

__all__ = ["region_graph", "stitch"]

LARGEST_JOIN = 1.4  # tiles; without a bound, joins of a third of a border run all along a seam
SMALLEST_PIECE = 0.25  # of the mean area


def region_graph(cut: CutMesh) -> RegionGraph:
    """Measure the regions of a cut mesh and the borders between them, by arc length in space."""
    e = edges(cut.F)
    h = np.flatnonzero(e.twin > np.arange(len(e.twin)))
    here, there = cut.region[h // 3], cut.region[e.twin[h] // 3]
    border = here != there
    h, here, there = h[border], here[border], there[border]
    ends = e.E[e.edge_of_halfedge[h]]
    length = np.linalg.norm(cut.V[ends[:, 0]] - cut.V[ends[:, 1]], axis=1)
    along_cut = np.isin(edge_keys(ends, len(cut.V)), edge_keys(cut.cuts, len(cut.V)))
    n = int(cut.region.max(initial=-1)) + 1
    area = sums(cut.region, face_areas(cut.V, cut.F), n)
    return sum_borders(area, here, there, length, ~along_cut)


def sum_borders(area: Floats, here: Ints, there: Ints, length: Floats, seam: Bools) -> RegionGraph:
    """Add up stretches of border between the same two regions.

    Parameters
    ----------
    area : (r,) float64, mm2
    here, there : (k,) int64, the regions on both sides of a stretch
    length : (k,) float64, mm
    seam : (k,) bool
    """
    low, high = np.minimum(here, there), np.maximum(here, there)
    key = (low * len(area) + high) * 2 + seam
    unique, inverse = np.unique(key, return_inverse=True)
    pairs = np.stack([unique // 2 // len(area), unique // 2 % len(area)], 1)
    total = sums(inverse, length, len(unique))
    return RegionGraph(area, pairs.astype(np.int64), total, unique % 2 == 1)


def stitch(
    graph: RegionGraph,
    share: float,
    tile_area: float,
    least_border: float = 0.0,
    smallest: float = SMALLEST_PIECE,
    alone: Ints | None = None,
) -> Stitching:
    """Join regions over seams, then give tiny pieces to a neighbour.

    Two regions join over a seam when the border between them is at least a given share of the seam
    border of either. Joins that leave the smallest pieces come first, and none makes a piece larger
    than 1.4 tiles. Then a piece that is too small joins the neighbour that it shares most border with.

    Parameters
    ----------
    graph : RegionGraph
    share : float, 0 to 1; at 1 only regions join that meet along the whole seam of one of them
    tile_area : float, area of a whole tile, mm2
    least_border : float, mm; over less of a seam than that a join would be too weak to be made
    smallest : float, share of the mean area under which a piece is too small
    alone : (k,) int64, regions that join over no seam; tiny pieces join others where they can

    Returns
    -------
    Stitching

    References
    ----------
    Elber and Kim, "Synthesis of 3D Jigsaw Puzzles over Freeform 2-Manifolds", section 3.2.2.
    """
    groups = _Groups(graph)
    joins = _join_over_seams(_without(graph, alone), groups, share, LARGEST_JOIN * tile_area, least_border)
    merged, left = _merge_tiny(groups, smallest, set() if alone is None else set(alone.tolist()))
    roots = np.array([groups.root(r) for r in range(len(graph.area))], dtype=np.int64)
    piece = np.unique(roots, return_inverse=True)[1].astype(np.int64)
    return Stitching(piece, StitchFacts(joins, merged, left))


def _without(graph: RegionGraph, regions: Ints | None) -> RegionGraph:
    """Leave out the borders of some regions."""
    if regions is None or not len(regions):
        return graph
    kept = ~np.isin(graph.pairs, regions).any(1)
    return RegionGraph(graph.area, graph.pairs[kept], graph.length[kept], graph.seam[kept])


class _Groups:
    """Regions joined so far: union-find that keeps areas and borders of every group."""

    def __init__(self, graph: RegionGraph) -> None:
        self.parent = list(range(len(graph.area)))
        self.area = graph.area.tolist()
        self.borders: list[dict[int, float]] = [{} for _ in self.area]
        for (a, b), length in zip(graph.pairs.tolist(), graph.length.tolist(), strict=True):
            self.borders[a][b] = self.borders[a].get(b, 0.0) + length
            self.borders[b][a] = self.borders[b].get(a, 0.0) + length

    def root(self, region: int) -> int:
        while self.parent[region] != region:
            self.parent[region] = self.parent[self.parent[region]]
            region = self.parent[region]
        return region

    def join(self, a: int, b: int) -> int:
        if len(self.borders[a]) < len(self.borders[b]):
            a, b = b, a
        self.parent[b] = a
        self.area[a] += self.area[b]
        for other, length in self.borders[b].items():
            del self.borders[other][b]
            if other != a:
                self.borders[a][other] = self.borders[a].get(other, 0.0) + length
                self.borders[other][a] = self.borders[a][other]
        self.borders[b] = {}
        return a


def _join_over_seams(
    graph: RegionGraph, groups: _Groups, share: float, largest: float, least_border: float
) -> int:
    seam = np.flatnonzero(graph.seam)
    pairs, length = graph.pairs[seam], graph.length[seam]
    total = np.bincount(pairs.ravel(), np.repeat(length, 2), len(graph.area))
    enough = length >= np.maximum(share * total[pairs].min(1), least_border)
    queue = [(groups.area[a] + groups.area[b], a, b) for a, b in pairs[enough].tolist()]
    heapq.heapify(queue)
    joins = 0
    while queue:
        area, a, b = heapq.heappop(queue)
        a, b = groups.root(a), groups.root(b)
        now = groups.area[a] + groups.area[b]
        if a == b or now > largest:
            continue
        if now > area:
            heapq.heappush(queue, (now, a, b))
            continue
        groups.join(a, b)
        joins += 1
    return joins


def _merge_tiny(groups: _Groups, smallest: float, alone: set[int]) -> tuple[int, int]:
    roots = {groups.root(r) for r in range(len(groups.parent))}
    queue = [(groups.area[r], r) for r in roots]
    heapq.heapify(queue)
    total, n, merged, left = sum(area for area, _ in queue), len(queue), 0, 0
    while queue:
        area, piece = heapq.heappop(queue)
        if groups.root(piece) != piece or groups.area[piece] != area:
            continue
        if area >= smallest * total / n:
            break
        if not groups.borders[piece]:
            left += 1
            continue
        others = [item for item in groups.borders[piece].items() if item[0] not in alone]
        neighbour = max(others or groups.borders[piece].items(), key=lambda item: (item[1], -item[0]))[0]
        whole = groups.join(piece, neighbour)
        heapq.heappush(queue, (groups.area[whole], whole))
        n, merged = n - 1, merged + 1
    return merged, left
