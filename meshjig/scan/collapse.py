"""Thin out a very fine mesh in little time, before the quadrics that look well at every collapse."""

from __future__ import annotations

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints, connected
from meshjig.mesh.components import fans
from meshjig.mesh.halfedges import compact, edge_keys, edges

__all__ = ["collapse_fast"]

_EDGE = 3.0  # mean edge that suits the library's ladder of error limits, which knows no unit
_ROUNDS = 8


def collapse_fast(V: Floats, F: Ints, faces: int) -> tuple[Floats, Ints]:
    """Simplify a mesh to about a number of faces; its topology and the vertices of its borders are kept.

    Parameters
    ----------
    V : (n, 3) float64
    F : (m, 3) int64, manifold and coherent, without unused vertices
    faces : int, target

    Returns
    -------
    V : (n', 3) float64
    F : (m', 3) int64, manifold and coherent; both are the input where no such mesh was found

    Notes
    -----
    The library collapses edges without asking whether a surface is left. What it gives is the input with
    clusters of vertices drawn together: where that is no surface, these are taken apart again, and their
    vertices are where they were. Drawing together connected vertices never lowers the Euler number while
    each cluster is still there, and borders stay as they are: so an equal one, in all, means that every
    component has its genus.
    """
    import fast_simplification

    length = float(np.linalg.norm(V[F[:, 1]] - V[F[:, 0]], axis=1).mean())
    scale, origin = _EDGE / length, V.mean(axis=0)
    P, T, collapses = fast_simplification.simplify(
        (V - origin) * scale,
        F.astype(np.int32),
        target_count=faces,
        return_collapses=True,
        preserve_border=True,
    )
    cluster = _clusters(len(V), collapses.astype(np.int64))
    G, kept = _drawn_together(F, cluster)
    if not np.array_equal(G, T):  # the library has numbered otherwise than it says
        return V, F
    W = V.copy()
    W[kept] = P / scale + origin
    for _ in range(_ROUNDS):
        bad = _no_surface(G, kept, len(V))
        if not bad.any():
            bad = _lost(F, cluster, G, kept)
        if not bad.any():
            return (W[kept], G) if 2 * len(V) - len(F) == 2 * len(kept) - len(G) else (V, F)
        apart = bad[cluster]
        cluster[apart] = np.flatnonzero(apart)
        W[apart] = V[apart]
        G, kept = _drawn_together(F, cluster)
    return V, F


def _clusters(n: int, collapses: Ints) -> Ints:
    """Give the vertex that each of n ends in, when the second of every pair (k, 2) goes into the first."""
    count, label = connected(n, collapses[:, 0], collapses[:, 1])
    left = np.delete(np.arange(n), collapses[:, 1])
    end = np.empty(count, np.int64)
    end[label[left]] = left
    return end[label]


def _drawn_together(F: Ints, cluster: Ints) -> tuple[Ints, Ints]:
    """Give the faces that are left when clusters become vertices, and the old numbers of these."""
    G = cluster[F]
    a, b, c = G.T
    return compact(G[(a != b) & (b != c) & (c != a)])


def _no_surface(G: Ints, kept: Ints, n: int) -> Bools:
    """Tell which vertices, of the n of old, lie where faces are no coherent surface, (n,)."""
    g = edges(G)
    bad = np.zeros(len(kept), bool)
    bad[g.E[g.n_faces > 2]] = True
    inner = g.twin != np.arange(len(g.twin))
    bad[G.ravel()[inner & (G.ravel() == G.ravel()[g.twin])]] = True
    beside = (g.twin // 3).reshape(-1, 3)
    double = (beside == beside[:, :1]).all(axis=1) & (beside[:, 0] != np.arange(len(G)))
    bad[G[double]] = True
    bad[np.bincount(fans(G, g.twin)[1], minlength=len(kept)) > 1] = True
    out = np.zeros(n, bool)
    out[kept[bad]] = True
    return out


def _lost(F: Ints, cluster: Ints, G: Ints, kept: Ints) -> Bools:
    """Tell which vertices, (n,), have lost all faces, or those at an edge: a tube is a line there."""
    n = len(cluster)
    out = np.zeros(n, bool)
    out[cluster] = True
    out[kept] = False
    if not out.any() and 2 * n - len(F) == 2 * len(kept) - len(G):
        return out
    drawn = cluster[edges(F).E]
    drawn = drawn[drawn[:, 0] != drawn[:, 1]]
    bare = ~np.isin(edge_keys(drawn, n), edge_keys(kept[edges(G).E], n))
    out[drawn[bare]] = True
    return out
