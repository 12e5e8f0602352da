"""Clean labels of faces: straight borders, no islands, no teeth, no pinched vertices."""

from collections.abc import Callable

import numpy as np

from meshjig.charts.segment.dual_graph import DualGraph
from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.components import label_components
from meshjig.mesh.mesh import Mesh

__all__ = ["clean_labels", "diffusion", "smooth"]

_ROUNDS = 60


def clean_labels(mesh: Mesh, label: Ints, area: Floats) -> Ints:
    """Let every label be one region with a plain border, as far as small changes can do it.

    Parameters
    ----------
    mesh : Mesh, manifold, one component
    label : (m,) int64; -1 where it is unknown
    area : (m,) float64, weighs the parts of a label against each other

    Returns
    -------
    label : (m,) int64, no -1 left where any label was given
    """
    F, twin = mesh.F, mesh.edges.twin
    around = np.where(twin == np.arange(len(twin)), -1, twin // 3).reshape(-1, 3)
    label = _without_islands(label.copy(), area, around)
    for n in range(_ROUNDS):
        _without_teeth(label, around, n)
        pinched = _pinched(F, label, twin)
        if not len(pinched):
            break
        _unpinch(F, label, pinched)
        label = _without_islands(label, area, around)
    return _without_islands(label, area, around)


def _without_islands(label: Ints, area: Floats, around: Ints) -> Ints:
    """Give all but the largest part of each label to the labels around."""
    n, part = label_components(label, around)
    size = np.bincount(part, area, n)
    owner = np.empty(n, np.int64)
    owner[part] = label
    order = np.argsort(size, kind="stable")
    largest = np.full(int(label.max()) + 1, -1)
    known = order[owner[order] >= 0]
    largest[owner[known]] = known
    island = (owner < 0) | (largest[owner] != np.arange(n))
    loose = island[part]
    todo = np.flatnonzero(loose)
    while len(todo):
        near = np.where((around[todo] >= 0) & ~loose[around[todo]], label[around[todo]], -1)
        best = np.where(near[:, 1] == near[:, 2], near[:, 1], near[:, 0])
        best = np.where(best < 0, near.max(1), best)
        reached = best >= 0
        if not reached.any():
            break
        label[todo[reached]] = best[reached]
        loose[todo[reached]] = False
        todo = todo[~reached]
    return label


def _without_teeth(label: Ints, around: Ints, seed: int) -> None:
    """Give faces between two neighbours of one other label that label, until none is left."""
    near = np.where(around >= 0, label[around], -1)
    active = np.flatnonzero((near != label[:, None]).any(1))
    for n in range(_ROUNDS):
        change = _majority(label, around[active])
        turn = (change >= 0) & (change != label[active])
        if not turn.any():
            return
        # All at once, neighbouring teeth would swap for ever.
        turn &= np.random.default_rng([seed, n]).random(len(active)) < 0.6
        turned = active[turn]
        label[turned] = change[turn]
        active = np.unique(np.concatenate([active, around[turned].ravel()]))
        active = active[active >= 0]


def _majority(label: Ints, around: Ints) -> Ints:
    """The label that two neighbours of a face share, or -1."""
    a, b, c = np.where(around >= 0, label[around], -1).T
    return np.where((a == b) | (a == c), a, np.where(b == c, b, -1))


def _pinched(F: Ints, label: Ints, twin: Ints) -> Ints:
    """List vertices at which one label has more than one sector."""
    k = int(label.max()) + 1
    h = np.arange(len(twin))
    rim = np.flatnonzero((twin == h) | (label[h // 3] != label[twin // 3]))
    key = F.ravel()[rim] * k + label[rim // 3]  # a sector has one half-edge of its rim leaving the vertex
    unique, count = np.unique(key, return_counts=True)
    return np.unique(unique[count > 1] // k)


def _unpinch(F: Ints, label: Ints, pinched: Ints) -> None:
    """Give all faces around a pinched vertex the label that most of them have."""
    n, k = int(F.max()) + 1, int(label.max()) + 1
    chosen = np.full(n, -1)
    touches = np.isin(F, pinched)
    face = np.repeat(np.flatnonzero(touches.any(1)), 3)
    corner = F[touches.any(1)].ravel()
    keep = np.isin(corner, pinched)
    key, count = np.unique(corner[keep] * k + label[face[keep]], return_counts=True)
    order = np.argsort(count, kind="stable")
    chosen[key[order] // k] = key[order] % k
    for j in range(3):
        hit = chosen[F[:, j]] >= 0
        label[hit] = chosen[F[hit, j]]


def smooth(graph: DualGraph, label: Ints, reach: float = 0.02, steps: int = 2) -> Ints:
    """Shorten borders; folds hold them in place.

    Each step diffuses the indicator of every label over the faces, and gives each face the label
    that it now has most of: motion of the border by its curvature.

    Parameters
    ----------
    graph : DualGraph
    label : (m,) int64, 0 to k - 1
    reach : float, of the root of the area: how far labels diffuse in a step
    steps : int

    Returns
    -------
    label : (m,) int64. Labels may be lost, and need not be connected.

    References
    ----------
    Merriman, Bence, Osher, "Diffusion Generated Motion by Mean Curvature", 1992.
    """
    diffuse = diffusion(graph, reach)
    for _ in range(steps):
        label = diffuse(label).argmax(1).astype(np.int64)
    return label


def diffusion(graph: DualGraph, reach: float) -> Callable[[Ints], Floats]:
    """The function that turns labels (m,) of faces into their diffused indicators (m, k).

    Parameters
    ----------
    graph : DualGraph
    reach : float, of the root of the area
    """
    from scipy.sparse import diags
    from scipy.sparse.linalg import splu

    fold = 0.02 + 0.98 * np.clip(graph.bend, 0, 1) ** 4
    W = graph.adjacency(graph.length / np.maximum(graph.span, 1e-9 * graph.span.max()) * fold)
    L = diags(np.asarray(W.sum(1)).ravel()) - W
    time = reach**2 * graph.area.sum()
    area = np.maximum(graph.area, 1e-9 * graph.area.mean())
    matrix = (diags(area) + time * L).tocsc()
    solver = splu(matrix, permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True})

    def diffuse(label: Ints) -> Floats:
        indicator = np.zeros((len(label), int(label.max()) + 1))
        indicator[np.arange(len(label)), label] = area
        shares: Floats = solver.solve(indicator)
        return shares

    return diffuse
