"""Implicit smoothing on a surface: (M + s^2/2 L) x = M y, solved in a time linear in the mesh."""

from __future__ import annotations

from typing import Any

import numpy as np

from meshjig.mesh.measure import face_areas
from meshjig.mesh.types import Floats, Ints

__all__ = ["Smoother", "solve_screened"]

_TOLERANCE = 1e-5  # of the right side; smoothing needs no more
_MAX_ITERATIONS = 400


class Smoother:
    """Smooth values over a surface by the heat that spreads in one implicit step.

    Cotangents are kept between 0 and 50, so that smoothing never overshoots and slivers stay harmless.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64
    """

    def __init__(self, V: Floats, F: Ints) -> None:
        self.mass = _vertex_areas(V, F)
        self.L = _laplacian(V, F)

    def __call__(self, values: Floats, scale: float, tolerance: float = _TOLERANCE) -> Floats:
        """Smooth values, one row a vertex.

        Parameters
        ----------
        values : (n,) or (n, d) float64
        scale : float, mm; details smaller than about this go
        tolerance : float, of the values' own size

        Returns
        -------
        float64, the shape of values
        """
        return self.solve((values.T * self.mass).T, scale, start=values, tolerance=tolerance)

    def solve(self, integrals: Floats, scale: float, start: Floats, tolerance: float = _TOLERANCE) -> Floats:
        """Solve (M + scale^2/2 L) x = integrals from a first guess; shapes as in a call."""
        x = start.reshape(len(self.mass), -1)
        b = integrals.reshape(x.shape)
        L = (scale * scale / 2) * self.L
        change = solve_screened(L, self.mass, b - self.mass[:, None] * x - L @ x, b, tolerance)
        return (x + change).reshape(start.shape)


def solve_screened(L: Any, mass: Floats, rhs: Floats, size: Floats, tolerance: float = _TOLERANCE) -> Floats:
    """Solve (M + L) x = rhs for several columns, until the residual is below a part of size.

    Parameters
    ----------
    L : (n, n) sparse, symmetric, diagonally dominant
    mass : (n,) float64, positive
    rhs : (n, d) float64
    size : (n, d) float64, what the residual is measured against, column by column
    tolerance : float, that part

    Returns
    -------
    (n, d) float64

    Notes
    -----
    Conjugate gradients with a diagonal preconditioner: while M and L are of like size a few dozen products
    with L are enough, whatever the size of the mesh.
    """
    diagonal = (mass + L.diagonal())[:, None]
    mass = mass[:, None]
    x, r = np.zeros_like(rhs), rhs.copy()
    z = r / diagonal
    p = z.copy()
    rz = np.einsum("ij,ij->j", r, z)
    enough = tolerance**2 * np.maximum(np.einsum("ij,ij->j", size, size / diagonal), 1e-300)
    for _ in range(_MAX_ITERATIONS):
        if (rz <= enough).all():
            break
        q = L @ p
        q += mass * p
        step = rz / np.maximum(np.einsum("ij,ij->j", p, q), 1e-300)
        x += step * p
        q *= step
        r -= q
        np.divide(r, diagonal, out=z)
        before, rz = rz, np.einsum("ij,ij->j", r, z)
        p *= rz / np.maximum(before, 1e-300)
        p += z
    return x


def _vertex_areas(V: Floats, F: Ints) -> Floats:
    areas = np.bincount(F.ravel(), np.repeat(face_areas(V, F) / 3, 3), len(V)).astype(np.float64)
    return np.maximum(areas, 1e-9 * areas.mean())


def _laplacian(V: Floats, F: Ints) -> Any:
    import igl
    from scipy.sparse import coo_matrix, diags

    half_cot = np.clip(igl.cotmatrix_entries(V, F), 1e-3, 50.0).ravel()
    i, j = F[:, [1, 2, 0]].ravel(), F[:, [2, 0, 1]].ravel()
    weights = coo_matrix((half_cot, (i, j)), shape=(len(V), len(V))).tocsr()
    weights = weights + weights.T
    return (diags(np.asarray(weights.sum(1)).ravel()) - weights).tocsr()
