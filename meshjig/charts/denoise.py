"""Tell a noisy surface from a smooth one, and smooth it."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from meshjig.mesh.halfedges import Edges, edges
from meshjig.mesh.measure import edge_lengths, vertex_normals

__all__ = ["denoise", "smoothed"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

_LIKE = 0.15  # correlation of bumps over an edge: noise has about -0.2, smooth shapes 0.25 and more
_HIGH = 0.06  # mean height of bumps, in mean edges, from which noise hinders
_PASSES = 10
_SHRINK, _GROW = (
    0.5,
    -0.53,
)  # Taubin's steps: what the first takes from the large shape, the second gives back


def denoise(V: Floats, F: Ints, e: Edges | None = None) -> Floats:
    """Smooth a surface whose vertices are strewn about it at random; leave any other as it is.

    Each vertex stands above or below the mean of its neighbours. On a smooth shape, however finely
    modelled, neighbours do so alike; noise makes them differ. Vertices move along the normal only:
    were they moved sideways, a map of the smooth surface would stretch the faces of the noisy one.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, manifold, using every vertex
    e : Edges, of F, where the caller has them

    Returns
    -------
    V : (n, 3) float64, mm; V itself where there is little noise. A border stays where it is.

    References
    ----------
    Taubin, "A Signal Processing Approach to Fair Surface Design", 1995.
    """
    e = edges(F) if e is None else e
    mean = _mean(len(V), e.E)
    if not _is_noisy(V, F, e.E, mean):
        return V
    smooth = _taubin(V, e, mean, _PASSES)
    N = vertex_normals(smooth, F)
    moved: Floats = V + np.einsum("ij,ij->i", smooth - V, N)[:, None] * N
    return moved


def smoothed(V: Floats, F: Ints, passes: int) -> Floats:
    """Smooth a surface, noisy or not, a little; a border stays where it is.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, manifold, using every vertex
    passes : int

    Returns
    -------
    V : (n, 3) float64, mm
    """
    e = edges(F)
    return _taubin(V, e, _mean(len(V), e.E), passes)


def _mean(n: int, E: Ints) -> Any:
    """Give the matrix (n, n) that takes values at vertices to the mean of their neighbours'."""
    from scipy.sparse import coo_matrix, diags

    W = coo_matrix((np.ones(len(E)), E.T), shape=(n, n)).tocsr()
    W = W + W.T
    return diags(1 / np.maximum(np.asarray(W.sum(1)).ravel(), 1)) @ W


def _taubin(V: Floats, e: Edges, mean: Any, passes: int) -> Floats:
    free = np.ones((len(V), 1))
    free[e.E[e.n_faces == 1].ravel()] = 0
    for _ in range(passes):
        for step in (_SHRINK, _GROW):
            move = mean @ V - V
            move *= step * free
            V = V + move
    return V


def _is_noisy(V: Floats, F: Ints, E: Ints, mean: Any) -> bool:
    height = np.einsum("ij,ij->i", V - mean @ V, vertex_normals(V, F))
    edge = edge_lengths(V, E).mean()
    alike = (height[E[:, 0]] * height[E[:, 1]]).sum() / max(float((height[E] ** 2).sum() / 2), 1e-300)
    return bool(alike < _LIKE and np.abs(height).mean() > _HIGH * edge)
