"""Triangles that are all but lines: their planes mean nothing, and rounding turns them over."""

import numpy as np

from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.halfedges import edge_keys, edges
from meshjig.mesh.incident_faces import around

__all__ = ["low_faces", "without_needles"]

_ROUNDS = 12
_BLOCK = 8192  # faces: what is worked on stays in the cache
_ROUNDING = 1e-9


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
    for turn in range(_ROUNDS):
        height, longest = _heights(V, F[look])
        low = np.flatnonzero(height < least)
        if not len(low):
            break
        low = low[np.argsort(height[low], kind="stable")]
        height, longest, look = height[low], longest[low], look[low]
        rows = around(F, F[look].ravel(), len(V))
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
