"""Give small charts away, part by part, to the charts around them."""

import numpy as np
from numpy.typing import NDArray

from meshjig.charts.segment.accept import Judge
from meshjig.charts.segment.dual_graph import Dual, dual
from meshjig.charts.segment.patches import patches
from meshjig.mesh.halfedges import compact

__all__ = ["dissolve"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

_SMALL = 0.06  # of the area: larger charts stay
_PARTS = 5


def dissolve(V: Floats, F: Ints, graph: Dual, label: Ints, judge: Judge, seed: int) -> Ints:
    """Empty every small chart whose parts all find a place in charts around it.

    Merging takes whole neighbours only; this frees what it left between them.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, manifold
    graph : Dual, of the mesh
    label : (m,) int64, 0 to k - 1
    judge : Judge
    seed : int

    Returns
    -------
    label : (m,) int64, 0 to k' - 1
    """
    area = np.bincount(label, graph.area)
    for chart in np.argsort(area, kind="stable"):
        if area[chart] > _SMALL * area.sum():
            break
        faces = np.flatnonzero(label == chart)
        G, kept = compact(F[faces])
        part = patches(dual(V[kept], G), min(_PARTS, len(faces)), seed, rounds=4)
        given = _given_away(graph, label, [faces[part == p] for p in range(int(part.max()) + 1)], judge)
        label = label if given is None else given
    return np.unique(label, return_inverse=True)[1].astype(np.int64)


def _given_away(graph: Dual, label: Ints, parts: list[Ints], judge: Judge) -> Ints | None:
    """Place all parts of one chart elsewhere; None when one of them stays."""
    home = label[parts[0][0]]
    label = label.copy()
    waiting = dict(enumerate(parts))
    refused: set[tuple[int, int]] = set()
    progress = True
    while waiting and progress:
        progress = False
        for n, part in list(waiting.items()):
            for host in _hosts(graph, label, part, home):
                if (n, host) in refused:
                    continue
                if judge.accepts(np.append(np.flatnonzero(label == host), part)):
                    label[part] = host
                    del waiting[n]
                    refused = {pair for pair in refused if pair[1] != host}
                    progress = True
                    break
                refused.add((n, host))
    return None if waiting else label


def _hosts(graph: Dual, label: Ints, part: Ints, home: int) -> list[int]:
    """List the charts around a part, the longest shared border first."""
    inside = np.zeros(len(label), bool)
    inside[part] = True
    rim = np.flatnonzero(inside[graph.first] != inside[graph.second])
    other = np.where(inside[graph.first[rim]], graph.second[rim], graph.first[rim])
    shared = np.bincount(label[other], graph.length[rim])
    order = np.argsort(-shared, kind="stable")
    return [int(h) for h in order if shared[h] > 0 and h != home]
