"""Many cells flattened at once: as round discs, and as rigidly as possible."""

import numpy as np
from numpy.typing import NDArray

from meshjig.cells.flatten.planar import CellPatches, rims, scaled
from meshjig.mesh.arrays import next_in_loop, starts
from meshjig.mesh.halfedges import edges
from meshjig.mesh.measure import sums, unit
from meshjig.mesh.types import Floats

__all__ = ["arap", "tutte"]

Complex = NDArray[np.complex128]

_LEAST, _MOST = 0.02, 50.0  # bounds on cotangents: a sliver must neither tear nor rule


def tutte(p: CellPatches) -> Floats:
    """Put the border of every cell on a circle and all else at the mean of its neighbours.

    Parameters
    ----------
    p : CellPatches, discs

    Returns
    -------
    uv : (k, 2) float64, mm, each cell of its own area

    References
    ----------
    Tutte, "How to Draw a Graph", 1963.
    """
    from scipy.sparse import coo_matrix, diags
    from scipy.sparse.linalg import splu

    E, k = edges(p.F).E, len(p.V)
    W = coo_matrix((np.ones(len(E)), (E[:, 0], E[:, 1])), shape=(k, k)).tocsr()
    W = W + W.T
    uv, border = np.zeros((k, 2)), np.zeros(k, bool)
    rim = rims(p)
    of_rim = p.of_vertex[rim]
    count = np.bincount(of_rim, minlength=p.n)
    step = np.linalg.norm(p.V[rim] - p.V[rim[next_in_loop(count)]], axis=1)
    step = np.maximum(step, (0.05 * sums(of_rim, step, p.n) / count)[of_rim])  # no two fall together
    total = sums(of_rim, step, p.n)
    along = starts(step) - starts(total)[of_rim]
    angle = 2 * np.pi * along / total[of_rim]
    uv[rim], border[rim] = np.stack([np.cos(angle), np.sin(angle)], 1), True
    free = np.flatnonzero(~border)
    if len(free):
        L = (diags(np.asarray(W.sum(1)).ravel()) - W).tocsr()[free]
        solver = splu(L[:, free].tocsc(), permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True})
        uv[free] = solver.solve(-(L[:, border] @ uv[border]))
    return scaled(p, uv)


def arap(p: CellPatches, uv: Floats, iterations: int = 10) -> Floats:
    """Bring the faces of flattened cells as near to rigid copies as they can be.

    All cells make one system with one factorisation. Faces may come out mirrored; the caller checks.

    Parameters
    ----------
    p : CellPatches
    uv : (k, 2) float64, mm, the start
    iterations : int

    Returns
    -------
    uv : (k, 2) float64, mm

    References
    ----------
    Liu et al., "A Local/Global Approach to Mesh Parameterization", 2008.
    """
    from scipy.sparse import csc_matrix
    from scipy.sparse.linalg import splu

    X = _laid_flat(p)
    side = X - X[:, [1, 2, 0]]  # (m, 3), complex: the vector of each side
    weight = _cotangents(X)
    a, b, w = p.F.ravel(), p.F[:, [1, 2, 0]].ravel(), weight.ravel()
    first = np.unique(p.of_vertex, return_index=True)[1]
    rows, columns = np.concatenate([a, b, a, b, first]), np.concatenate([b, a, a, b, first])
    k = len(p.V)
    L = csc_matrix((np.concatenate([-w, -w, w, w, np.ones(p.n)]), (rows, columns)), shape=(k, k))
    solver = splu(L, permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True})
    ends = csc_matrix(
        (np.concatenate([w, -w]), (np.concatenate([a, b]), np.tile(np.arange(len(a)), 2))), shape=(k, len(a))
    ).tocsr()
    z = uv[:, 0] + 1j * uv[:, 1]
    for _ in range(iterations):
        turn = (weight * (z[p.F] - z[p.F[:, [1, 2, 0]]]) * side.conj()).sum(1)
        turn /= np.maximum(np.abs(turn), 1e-300)
        turned = (turn[:, None] * side).ravel()
        out = solver.solve(ends @ turned.view(np.float64).reshape(-1, 2))
        z = out[:, 0] + 1j * out[:, 1]
    return np.stack([z.real, z.imag], 1)


def _laid_flat(p: CellPatches) -> Complex:
    """Give each face in a plane of its own, as complex numbers, (m, 3)."""
    a = p.V[p.F[:, 0]]
    d, e = p.V[p.F[:, 1]] - a, p.V[p.F[:, 2]] - a
    x = unit(d)
    ex = np.einsum("ij,ij->i", e, x)
    ey = np.linalg.norm(e - ex[:, None] * x, axis=1)
    return np.stack([np.zeros(len(a), complex), np.linalg.norm(d, axis=1) + 0j, ex + 1j * ey], 1)


def _cotangents(X: Complex) -> Floats:
    """Give half the cotangent of the angle opposite to each side, (m, 3)."""
    opposite = X[:, [2, 0, 1]]
    p, q = X - opposite, X[:, [1, 2, 0]] - opposite
    dot, area = (p * q.conj()).real, np.abs((p.conj() * q).imag)
    return np.clip(dot / np.maximum(area, 1e-300), _LEAST, _MOST) / 2
