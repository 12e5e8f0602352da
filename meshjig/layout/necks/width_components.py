"""Which parts of pieces are connected by paths of some width on the surface."""

from itertools import product

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import dijkstra

from meshjig.layout.necks.border_distance import ALONG, BorderPoints, between, border_points, distances_along
from meshjig.mesh.arrays import Bools, Floats, Ints, connected
from meshjig.mesh.halfedges import compact, edges

__all__ = ["width_components"]

THROUGH = np.linspace(0, 1, 5)[1:-1]  # of the way through a face
NEARLY = 0.95  # of half the width that must be free in there


def width_components(V: Floats, F: Ints, piece: Ints, width: float) -> Ints:
    """Divide pieces where they are narrower than a width.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64
    piece : (m,) int64, of every face
    width : float, mm

    Returns
    -------
    part : (m,) int64
        Faces of one piece have the same number when a path leads from one to the other that stays half the
        width away from the borders of pieces; faces too near to a border go with the nearest part.

    Notes
    -----
    Of every edge the stretches that are far enough from the borders are found. A path leads along these, and
    straight through faces from one to another.
    """
    F, kept = compact(F)
    V, e = V[kept], edges(F)
    h = np.flatnonzero(e.twin > np.arange(len(e.twin)))
    inner = h[piece[h // 3] == piece[e.twin[h] // 3]]
    ends = e.E[e.edge_of_halfedge[inner]]
    near = border_points(V, F, e, piece, width)
    far = distances_along(ends, near)
    stretch, n = _stretches(far > width / 2)
    pairs = np.concatenate(
        [np.stack([stretch[:, k], n + ends[:, k]], 1)[stretch[:, k] >= 0] for k in (0, -1)]
    )
    row = np.full(len(e.twin), -1)
    row[inner] = row[e.twin[inner]] = np.arange(len(inner))
    sides = row.reshape(-1, 3)
    label = connected(n + len(V), *pairs.T)[1]
    pairs = np.concatenate([pairs, _through_faces(sides, ends, stretch, label, near)])
    core = _of_widest_side(sides, far, stretch, connected(n + len(V), *pairs.T)[1])
    return _filled(V, F, np.stack([inner // 3, e.twin[inner] // 3], 1), core)


def _stretches(wide: Bools) -> tuple[Ints, int]:
    """Number the runs of places along every edge that are wide, (k, 9), -1 elsewhere, and count them."""
    begins = wide & np.hstack([np.ones((len(wide), 1), bool), ~wide[:, :-1]])
    return np.where(wide, begins.cumsum().reshape(wide.shape) - 1, -1), int(begins.sum())


def _of_widest_side(sides: Ints, far: Floats, stretch: Ints, label: Ints) -> Ints:
    """Give faces (m, 3), by their edges, the label of the stretch farthest from borders; -1 for none."""
    edge = np.arange(len(far))
    best = np.where(stretch >= 0, far, -1.0).argmax(1)
    stretch, most = stretch[edge, best], far[edge, best]
    of_edge = np.append(np.where(stretch >= 0, label[stretch], -1), -1)
    most = np.append(np.where(stretch >= 0, most, -1.0), -1.0)
    return of_edge[sides[np.arange(len(sides)), most[sides].argmax(1)]]


def _through_faces(row: Ints, ends: Ints, stretch: Ints, label: Ints, near: BorderPoints) -> Ints:
    """List pairs (k, 2) of stretches in different parts that a straight path through a face connects."""
    row = row[_torn(row, stretch, label)]
    first = np.array([_places(stretch, last=False), _places(stretch, last=True)])
    found: list[Ints] = [np.zeros((0, 2), np.int64)]
    for k, one, other in product(range(3), first, first):
        a, b = row[:, k - 1], row[:, k]
        both = (a >= 0) & (b >= 0)
        a, b = a[both], b[both]
        for s, t in product(range(3), repeat=2):
            p, q = one[a, s], other[b, t]
            runs = np.stack([stretch[a, p], stretch[b, q]], 1)
            tried = np.flatnonzero((runs >= 0).all(1) & (label[runs[:, 0]] != label[runs[:, 1]]))
            a, b, p, q, runs = a[tried], b[tried], p[tried], q[tried], runs[tried]
            leads = _free_between(near, (ends[a], ALONG[p]), (ends[b], ALONG[q]))
            found.append(runs[leads])
            a, b = a[~leads], b[~leads]
    return np.concatenate(found)


def _torn(sides: Ints, stretch: Ints, label: Ints) -> Bools:
    """Tell which faces (m, 3), by their edges, have stretches in different parts."""
    found, part, none = stretch >= 0, label[stretch], len(label)
    low = np.append(np.where(found, part, none).min(1, initial=none), none)
    high = np.append(np.where(found, part, -1).max(1, initial=-1), -1)
    return np.asarray(low[sides].min(1) < high[sides].max(1))


def _places(stretch: Ints, last: bool) -> Ints:
    """Give where the first or last stretch of every edge begins, is halfway and ends, (k, 3)."""
    n = stretch.shape[1]
    found = stretch >= 0
    edge = n - 1 - found[:, ::-1].argmax(1) if last else found.argmax(1)
    same = found & (stretch == stretch[np.arange(len(edge)), edge][:, None])
    begin, end = same.argmax(1), n - 1 - same[:, ::-1].argmax(1)
    return np.stack([(begin + end) // 2, begin, end], 1)


def _free_between(near: BorderPoints, one: tuple[Ints, Floats], other: tuple[Ints, Floats]) -> Bools:
    """Tell between which points, each given as ends of an edge and place on it, all is far from borders."""
    (P, N), (Q, M) = (tuple(between(X, *place) for X in (near.V, near.N)) for place in (one, other))
    free = np.ones(len(P), bool)
    for t in THROUGH.tolist():
        left = np.flatnonzero(free)
        free[left] = (
            near.distance(P[left] + t * (Q - P)[left], N[left] + t * (M - N)[left]) > NEARLY * near.width / 2
        )
    return free


def _filled(V: Floats, F: Ints, beside: Ints, core: Ints) -> Ints:
    """Give faces in no part to the nearest part of their piece; what has none is a part of its own."""
    m, part = len(core), core.copy()
    middle = V[F].mean(1)
    beside = beside[(core[beside] < 0).any(1)]
    length = np.linalg.norm(middle[beside[:, 0]] - middle[beside[:, 1]], axis=1) + 1e-9
    seeds = np.unique(beside[core[beside] >= 0])
    if len(seeds):
        graph = coo_matrix((length, tuple(beside.T)), shape=(m, m)).tocsr()
        source = dijkstra(graph, False, seeds, return_predecessors=True, min_only=True)[2]
        reached = (core < 0) & (source >= 0)
        part[reached] = core[source[reached]]
    left = part < 0
    thin = beside[left[beside].all(1)]
    part[left] = int(core.max(initial=-1)) + 1 + connected(m, *thin.T)[1][left]
    return np.unique(part, return_inverse=True)[1].astype(np.int64)
