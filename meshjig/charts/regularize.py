"""Ready a mesh for flattening: faces without area get a little, noise is smoothed away."""

from typing import Any

import numpy as np

from meshjig.errors import ChartError
from meshjig.mesh.measure import edge_lengths
from meshjig.mesh.mesh import Mesh

__all__ = ["denoise", "regularize", "smoothed"]

_THIN = 1e-6  # of the mean edge: a face of less height counts as one without area
_SHIFT = 1e-3  # of the mean edge
_LIKE = 0.15  # correlation of bumps over an edge: noise has about -0.2, smooth shapes 0.25 and more
_HIGH = 0.06  # mean height of bumps, in mean edges, from which noise hinders
_PASSES = 10
_SHRINK, _GROW = 0.5, -0.53  # Taubin's steps: the second gives back what the first takes of the large shape


def regularize(mesh: Mesh, seed: int = 0) -> Mesh:
    """Shift the corners of faces without area at random, by far less than an edge; smooth a noisy surface.

    A single such face leaves the equations of a chart without a solution. Noise counts as curvature,
    and mirrors faces when charts are transferred from a proxy.

    Parameters
    ----------
    mesh : Mesh
    seed : int

    Returns
    -------
    Mesh
        For flattening only, with the same faces; itself where no face is thin and there is little noise.

    Raises
    ------
    ChartError
        The mesh has no extent, or a coordinate is not finite.
    """
    V, F = mesh
    e = mesh.edges
    side = edge_lengths(V, e.E)[e.edge_of_halfedge].reshape(-1, 3)
    edge = float(side.mean())
    if not np.isfinite(edge) or edge <= 0:
        raise ChartError("the mesh has no extent", hint="remove faces without area and points at infinity")
    thin = 2 * mesh.areas < _THIN * edge * np.maximum(side.max(1), _THIN * edge)
    if not thin.any():
        return denoise(mesh)
    moved = np.unique(F[thin])
    out = V.copy()
    out[moved] += _SHIFT * edge * np.random.default_rng(seed).normal(size=(len(moved), 3))
    return denoise(mesh.moved(out))


def denoise(mesh: Mesh) -> Mesh:
    """Smooth a surface whose vertices are strewn about it at random; leave any other as it is.

    Each vertex stands above or below the mean of its neighbours. On a smooth shape, however finely
    modelled, neighbours do so alike; noise makes them differ. Vertices move along the normal only:
    were they moved sideways, a map of the smooth surface would stretch the faces of the noisy one.

    Parameters
    ----------
    mesh : Mesh, manifold

    Returns
    -------
    Mesh
        With the same faces; itself where there is little noise. A border stays where it is.

    References
    ----------
    Taubin, "A Signal Processing Approach to Fair Surface Design", 1995.
    """
    mean = _mean(mesh)
    if not _is_noisy(mesh, mean):
        return mesh
    smooth = _taubin(mesh, mean, _PASSES)
    N = smooth.vertex_normals
    return mesh.moved(mesh.V + np.einsum("ij,ij->i", smooth.V - mesh.V, N)[:, None] * N)


def smoothed(mesh: Mesh, passes: int) -> Mesh:
    """Smooth a surface a little, noisy or not, by a number of passes; a border stays where it is."""
    return _taubin(mesh, _mean(mesh), passes)


def _mean(mesh: Mesh) -> Any:
    """The matrix (n, n) that takes values at vertices to the mean of their neighbours'."""
    from scipy.sparse import coo_matrix, diags

    n, E = len(mesh.V), mesh.edges.E
    W = coo_matrix((np.ones(len(E)), E.T), shape=(n, n)).tocsr()
    W = W + W.T
    return diags(1 / np.maximum(np.asarray(W.sum(1)).ravel(), 1)) @ W


def _taubin(mesh: Mesh, mean: Any, passes: int) -> Mesh:
    V, free = mesh.V, np.where(mesh.is_border_vertex, 0.0, 1.0)[:, None]
    for _ in range(passes):
        for step in (_SHRINK, _GROW):
            move = mean @ V - V
            move *= step * free
            V = V + move
    return mesh.moved(V)


def _is_noisy(mesh: Mesh, mean: Any) -> bool:
    V, E = mesh.V, mesh.edges.E
    height = np.einsum("ij,ij->i", V - mean @ V, mesh.vertex_normals)
    edge = edge_lengths(V, E).mean()
    alike = (height[E[:, 0]] * height[E[:, 1]]).sum() / max(float((height[E] ** 2).sum() / 2), 1e-300)
    return bool(alike < _LIKE and np.abs(height).mean() > _HIGH * edge)
