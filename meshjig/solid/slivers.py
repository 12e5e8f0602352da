"""Triangles that are all but lines, and edges that are all but points: rounding turns them over."""

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.halfedges import compact, edge_keys, edges, incident_faces
from meshjig.mesh.measure import edge_lengths

__all__ = ["low_faces", "without_degenerate", "without_needles", "without_short_edges"]

_FLIPS = 12  # rounds of them
_BLOCK = 8192  # faces: what is worked on stays in the cache
_ROUNDING = 1e-9
_COLLAPSES = 60  # rounds of them


def low_faces(V: Floats, F: Ints, least: float) -> Ints:
    """List the triangles that are lower than a limit over their longest side, or have a shorter side.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64
    least : float, mm

    Returns
    -------
    (k,) int64, in order
    """
    blocks = range(0, len(F), _BLOCK)
    heights = [_heights(V, F[k : k + _BLOCK])[0] for k in blocks]
    return np.flatnonzero(np.concatenate([np.zeros(0), *heights]) < least * (1 + _ROUNDING))


def without_needles(V: Floats, F: Ints, least: float, among: Ints | None = None) -> Ints:
    """Flip the longest side of triangles that are lower than a limit over it.

    The corner opposite lies all but on that side, so that the shape stays what it is. A flip that would
    make an edge twice, or triangles no higher, is left out.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, closed
    least : float, mm
    among : (k,) int64, optional, faces of which all others are known to be high enough

    Returns
    -------
    F : (m, 3) int64, closed
    """
    look = low_faces(V, F, least) if among is None else among
    for turn in range(_FLIPS):
        height, longest = _heights(V, F[look])
        low = np.flatnonzero(height < least)
        if not len(low):
            break
        low = low[np.argsort(height[low], kind="stable")]
        height, longest, look = height[low], longest[low], look[low]
        rows = incident_faces(F, F[look].ravel(), len(V))
        G, e = F[rows], edges(F[rows])
        a, b, c = (F[look, (longest + k) % 3] for k in range(3))
        here = np.searchsorted(rows, look)
        across = e.twin[3 * here + longest]
        other, d = across // 3, G[across // 3, (across + 2) % 3]
        faces, pair = np.stack([here, other], 1), np.stack([[a, d, c], [d, b, c]]).transpose(2, 0, 1)
        before = np.minimum(height, _heights(V, G[other])[0])
        better = _heights(V, pair.reshape(-1, 3))[0].reshape(-1, 2).min(1) > before
        made = edge_keys(np.stack([c, d], 1), len(V))
        fit = better & (c != d) & ~np.isin(made, edge_keys(e.E, len(V)))
        chosen = np.flatnonzero(fit)[_first_of_their_faces(faces[fit], made[fit], len(G))]
        if not len(chosen):
            break
        F = F if turn else F.copy()
        F[rows[faces[chosen]]] = pair[chosen]
        look = np.union1d(look, rows[other[chosen]])
    return F


def _heights(V: Floats, F: Ints) -> tuple[Floats, Ints]:
    """Give the height of triangles over their longest side, mm, and where that side starts."""
    X = np.ascontiguousarray(V[F].T)  # axis, corner, face
    S = X[:, [1, 2, 0]] - X
    side = _lengths(S)
    (d, e, f), (u, v, w) = S[:, 0], S[:, 2]
    twice = _lengths(np.stack([e * w - f * v, f * u - d * w, d * v - e * u]))
    return twice / np.maximum(side.max(0), 1e-300), side.argmax(0)


def _lengths(X: Floats) -> Floats:
    return np.sqrt(X[0] * X[0] + X[1] * X[1] + X[2] * X[2])


def _first_of_their_faces(faces: Ints, made: Ints, n: int) -> Ints:
    """Pick rows, the first first, that share no face and no new edge with one before them."""
    rank = np.arange(len(faces))
    first = np.full(n, len(faces))
    np.minimum.at(first, faces.ravel(), np.repeat(rank, 2))
    new = np.zeros(len(faces), bool)
    new[np.unique(made, return_index=True)[1]] = True
    return np.flatnonzero((first[faces] == rank[:, None]).all(1) & new)


def without_short_edges(V: Floats, F: Ints, least: float, among: Ints) -> tuple[Ints, Ints]:
    """Collapse short edges, in each round all those that are shortest in their neighbourhood.

    An edge stays where its collapse would change what the surface is (the link condition).

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64
    least : float, mm
    among : (k,) int64, the faces that may have a short edge

    Returns
    -------
    F : (m', 3) int64
    changed : (c,) int64, the faces among them and those that were changed
    """
    left, changed = np.ones(len(F), bool), np.zeros(len(F), bool)
    changed[among] = True
    look = among
    for _ in range(_COLLAPSES):
        side = np.stack([edge_lengths(V, F[look][:, [k, k - 2]]) for k in range(3)], 1)
        look = look[side.min(1, initial=np.inf) < least]
        if not len(look):
            break
        rows = incident_faces(F, F[incident_faces(F, F[look].ravel(), len(V))].ravel(), len(V))
        rows = rows[left[rows]]
        G, kept = compact(F[rows])
        e = edges(G)
        length = edge_lengths(V[kept], e.E)
        short = np.flatnonzero(length < least)
        short = short[_collapsible(e.E, e.n_faces, short)]
        if not len(short):
            break
        short = short[np.argsort(length[short], kind="stable")]
        chosen = e.E[short[_far_apart(e.E, short)]]
        target = np.arange(len(kept))
        target[chosen[:, 1]] = chosen[:, 0]
        F = F.copy() if left.all() else F
        F[rows] = kept[target[G]]
        changed[rows] = True
        left[rows] = ~_is_degenerate(F[rows])
        look = rows[left[rows]]
    return F[left], np.flatnonzero(changed[left])


def without_degenerate(F: Ints) -> Ints:
    """Leave out faces that have a corner twice."""
    bad = _is_degenerate(F)
    return F[~bad] if bad.any() else F


def _is_degenerate(F: Ints) -> Bools:
    bad: Bools = (F[:, 0] == F[:, 1]) | (F[:, 1] == F[:, 2]) | (F[:, 2] == F[:, 0])
    return bad


def _collapsible(E: Ints, count: Ints, candidates: Ints) -> Bools:
    """Tell which edges meet the link condition: their ends share the two vertices opposite and no more."""
    from scipy.sparse import coo_matrix

    n = int(E.max(initial=0)) + 1
    both = np.concatenate([E, E[:, ::-1]])
    touching = coo_matrix((np.ones(len(both), np.int32), (both[:, 0], both[:, 1])), shape=(n, n)).tocsr()
    on_border = np.zeros(n, bool)
    on_border[E[count != 2].ravel()] = True
    degree = np.bincount(E.ravel(), minlength=n)
    a, b = E[candidates].T
    shared = np.asarray(touching[a].multiply(touching[b]).sum(axis=1)).ravel()
    tetrahedron = (degree[a] == 3) & (degree[b] == 3)
    return (shared == 2) & ~tetrahedron & ~on_border[a] & ~on_border[b]


def _far_apart(E: Ints, ordered: Ints) -> Ints:
    """Pick from ordered edges those with no better one within two steps: they can collapse at once."""
    rank = np.full(int(E.max()) + 1, len(ordered))
    np.minimum.at(rank, E[ordered].ravel(), np.repeat(np.arange(len(ordered)), 2))
    for _ in range(2):
        wider = rank.copy()
        np.minimum.at(wider, E[:, 0], rank[E[:, 1]])
        np.minimum.at(wider, E[:, 1], rank[E[:, 0]])
        rank = wider
    return np.flatnonzero(rank[E[ordered]].min(axis=1) == np.arange(len(ordered)))
