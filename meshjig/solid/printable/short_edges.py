"""Edges too short to be told from points, collapsed where the surface stays a surface."""

import numpy as np

from meshjig.mesh.halfedges import compact, edges
from meshjig.mesh.incident_faces import around
from meshjig.mesh.types import Bools, Floats, Ints

__all__ = ["without_degenerate", "without_short_edges"]

_ROUNDS = 60


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
    for _ in range(_ROUNDS):
        side = np.stack([_lengths(V, F[look, k], F[look, k - 2]) for k in range(3)], 1)
        look = look[side.min(1, initial=np.inf) < least]
        if not len(look):
            break
        rows = around(F, F[around(F, F[look].ravel(), len(V))].ravel(), len(V))
        rows = rows[left[rows]]
        G, kept = compact(F[rows])
        e = edges(G)
        length = _lengths(V[kept], *e.E.T)
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


def _lengths(V: Floats, a: Ints, b: Ints) -> Floats:
    (x, y, z) = (V[a, k] - V[b, k] for k in range(3))
    return np.sqrt(x * x + y * y + z * z)


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
