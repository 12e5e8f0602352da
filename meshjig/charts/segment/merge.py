"""Fewer charts with shorter borders: whole neighbours merged, small charts absorbed, borders polished."""

import numpy as np

from meshjig.charts.segment.accept import Acceptance
from meshjig.charts.segment.clean_labels import clean_labels, diffusion
from meshjig.charts.segment.dual_graph import DualGraph, dual_graph, patches
from meshjig.mesh.arrays import Ints
from meshjig.mesh.halfedges import compact
from meshjig.mesh.mesh import Mesh

__all__ = ["absorb", "merge", "polish"]

_CREASE_WORTH = 0.15  # a border along a sharp fold is hardly seen: little is won by removing it
_SIZE, _RIM = 0.5, 0.15  # what a large chart, and one with a long rim for its size, counts against a merge
_ABSORBED = 0.06  # of the area: larger charts stay
_PARTS = 5  # that a small chart is given away in
_REACH = (0.05, 0.035, 0.025, 0.02)  # of the root of the area: borders move far, then get smooth


def merge(graph: DualGraph, label: Ints, acceptance: Acceptance) -> Ints:
    """Merge greedily, the pair first that loses most border for what is left, in size and in rim.

    Parameters
    ----------
    graph : DualGraph
    label : (m,) int64, 0 to k - 1
    acceptance : Acceptance

    Returns
    -------
    label : (m,) int64, 0 to k' - 1
    """
    label = label.copy()
    refused: set[tuple[int, int]] = set()
    while True:
        for a, b in _pairs(graph, label):
            if (a, b) in refused:
                continue
            faces = np.flatnonzero((label == a) | (label == b))
            if acceptance.accepts(faces):
                label[faces] = a
                refused = {p for p in refused if a not in p and b not in p}
                break
            refused.add((a, b))
        else:
            return np.unique(label, return_inverse=True)[1].astype(np.int64)


def _pairs(graph: DualGraph, label: Ints) -> list[tuple[int, int]]:
    """List neighbours, the most promising first."""
    k = int(label.max()) + 1
    a, b = label[graph.first], label[graph.second]
    seam = np.flatnonzero(a != b)
    a, b = np.minimum(a, b)[seam], np.maximum(a, b)[seam]
    worth = graph.length[seam] * (_CREASE_WORTH + (1 - _CREASE_WORTH) * np.clip(graph.bend[seam], 0, 1))
    pair, which = np.unique(a * k + b, return_inverse=True)
    shared = np.bincount(which, worth, len(pair))
    a, b = pair // k, pair % k
    border = np.bincount(a, shared, k) + np.bincount(b, shared, k)
    area = np.bincount(label, graph.area, k)
    gain = shared / np.maximum(np.minimum(border[a], border[b]), 1e-300)
    size = np.sqrt(area[a] + area[b])
    rim = (border[a] + border[b] - 2 * shared) / np.maximum(size, 1e-300)
    cost = _SIZE * size / np.sqrt(area.sum()) + _RIM * rim - gain
    order = np.argsort(cost, kind="stable")
    return list(zip(a[order].tolist(), b[order].tolist(), strict=True))


def absorb(mesh: Mesh, graph: DualGraph, label: Ints, acceptance: Acceptance, seed: int) -> Ints:
    """Empty every small chart whose parts all find a place in charts around it.

    Merging takes whole neighbours only; this frees what it left between them.

    Parameters
    ----------
    mesh : Mesh, manifold
    graph : DualGraph, of the mesh
    label : (m,) int64, 0 to k - 1
    acceptance : Acceptance
    seed : int

    Returns
    -------
    label : (m,) int64, 0 to k' - 1
    """
    area = np.bincount(label, graph.area)
    for chart in np.argsort(area, kind="stable"):
        if area[chart] > _ABSORBED * area.sum():
            break
        faces = np.flatnonzero(label == chart)
        G, kept = compact(mesh.F[faces])
        part = patches(dual_graph(mesh.V[kept], G), min(_PARTS, len(faces)), seed, rounds=4)
        given = _given_away(graph, label, [faces[part == p] for p in range(int(part.max()) + 1)], acceptance)
        label = label if given is None else given
    return np.unique(label, return_inverse=True)[1].astype(np.int64)


def _given_away(graph: DualGraph, label: Ints, parts: list[Ints], acceptance: Acceptance) -> Ints | None:
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
                if acceptance.accepts(np.append(np.flatnonzero(label == host), part)):
                    label[part] = host
                    del waiting[n]
                    refused = {pair for pair in refused if pair[1] != host}
                    progress = True
                    break
                refused.add((n, host))
    return None if waiting else label


def _hosts(graph: DualGraph, label: Ints, part: Ints, home: int) -> list[int]:
    """List the charts around a part, the longest shared border first."""
    inside = np.zeros(len(label), bool)
    inside[part] = True
    rim = np.flatnonzero(inside[graph.first] != inside[graph.second])
    other = np.where(inside[graph.first[rim]], graph.second[rim], graph.first[rim])
    shared = np.bincount(label[other], graph.length[rim])
    order = np.argsort(-shared, kind="stable")
    return [int(h) for h in order if shared[h] > 0 and h != home]


def polish(mesh: Mesh, graph: DualGraph, label: Ints, acceptance: Acceptance) -> Ints:
    """Let borders move by their curvature, over folds hardly at all.

    Parameters
    ----------
    mesh : Mesh, manifold, one component
    graph : DualGraph, of the mesh
    label : (m,) int64, 0 to k - 1, every chart one that is accepted
    acceptance : Acceptance

    Returns
    -------
    label : (m,) int64, 0 to k - 1, every chart one that is accepted
    """
    k = int(label.max()) + 1
    for reach in _REACH:
        wanted = clean_labels(mesh, diffusion(graph, reach)(label).argmax(1).astype(np.int64), graph.area)
        low, high = np.minimum(label, wanted), np.maximum(label, wanted)
        for pair in np.unique((low * k + high)[low != high]).tolist():
            moved = (low == pair // k) & (high == pair % k)
            after = np.where(moved, wanted, label)
            if _seam(graph, after) < _seam(graph, label) and all(
                acceptance.accepts(np.flatnonzero(after == chart)) for chart in (pair // k, pair % k)
            ):
                label = after
    return label


def _seam(graph: DualGraph, label: Ints) -> float:
    """The length of the borders between labels, mm; along folds they count for less."""
    rim = label[graph.first] != label[graph.second]
    return float((graph.length[rim] * (0.3 + 0.7 * np.clip(graph.bend[rim], 0, 1))).sum())
