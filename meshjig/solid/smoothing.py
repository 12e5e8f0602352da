"""Implicit smoothing on a surface: (M + s^2/2 L) x = M y, solved in a time linear in the mesh."""

from __future__ import annotations

from typing import Any

import numpy as np

from meshjig.measure import face_areas
from meshjig.types import Floats, Ints

__all__ = ["Smoother"]

_TOLERANCE = 1e-6  # of the residual, relative; smoothing needs no more
_MAX_ITERATIONS = 400


class Smoother:
    """Smooth values over a surface by the heat that spreads in one implicit step.

    Cotangents are kept between 0 and 50, so that smoothing never overshoots and slivers stay harmless.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64

    Notes
    -----
    Conjugate gradients with a diagonal preconditioner: the screened system is well conditioned as long as
    the scale is a few edges long, and then needs 10 to 60 products with a sparse matrix.
    """

    def __init__(self, V: Floats, F: Ints) -> None:
        self.mass = _vertex_areas(V, F)
        self._L = _laplacian(V, F)
        from scipy.sparse import coo_matrix, diags
        n=len(V);i,j=F.ravel(),F[:,[1,2,0]].ravel()
        A=coo_matrix((np.ones(2*len(i)),(np.concatenate([i,j]),np.concatenate([j,i]))),shape=(n,n)).tocsr();A.data[:]=1
        deg=np.asarray(A.sum(1)).ravel()
        h=float(np.linalg.norm(V[F[:,0]]-V[F[:,1]],axis=1).mean())
        self._U=((diags(deg)-A)*(1/6/h**2*4)).tocsr();self._deg=deg/6

    def __call__(self, values: Floats, scale: float) -> Floats:
        """Smooth values, one row a vertex.

        Parameters
        ----------
        values : (n,) or (n, d) float64
        scale : float, mm; details smaller than about this go

        Returns
        -------
        float64, the shape of values
        """
        return self.solve((values.T * self.mass).T, scale, start=values)

    def solve(self, integrals: Floats, scale: float, start: Floats) -> Floats:
        """Solve (M + scale^2/2 L) x = integrals from a first guess; shapes as in a call."""
        x = start.reshape(len(self.mass), -1)
        b = integrals.reshape(x.shape)
        half = scale * scale / 2
        lack = b - self.mass[:, None] * x - half * (self._L @ x)
        return (x + self._correction(self._L, self.mass, half, lack, b)).reshape(start.shape)

    def inside(self, values: Floats, scale: float, patch: Ints) -> Floats:
        """Smooth values at the vertices of a patch, with all others held; the shape of values[patch]."""
        x = values.reshape(len(self.mass), -1)
        mass, half, rows = self._deg[patch], scale * scale / 2, self._U[patch]
        lack = -half * (rows @ x)
        near = x[patch] - x[patch].mean(0) if len(patch) else x[patch]
        change = self._correction(rows[:, patch], mass, half, lack, mass[:, None] * (near + scale))
        return (x[patch] + change).reshape(values[patch].shape)

    @staticmethod
    def _correction(L: Any, mass: Floats, half: float, lack: Floats, size: Floats) -> Floats:
        """Solve (M + half L) x = lack by conjugate gradients, to a small part of what size is."""
        diagonal = (mass + half * L.diagonal())[:, None]
        mass = mass[:, None]
        x, r = np.zeros_like(lack), lack
        z = r / diagonal
        p = z
        rz = np.einsum("ij,ij->j", r, z)
        enough = _TOLERANCE**2 * np.maximum(np.einsum("ij,ij->j", size, size / diagonal), 1e-300)
        for _ in range(_MAX_ITERATIONS):
            if (rz <= enough).all():
                break
            q = mass * p + half * (L @ p)
            step = rz / np.maximum(np.einsum("ij,ij->j", p, q), 1e-300)
            x = x + step * p
            r = r - step * q
            z = r / diagonal
            before, rz = rz, np.einsum("ij,ij->j", r, z)
            p = z + (rz / np.maximum(before, 1e-300)) * p
        return x


def _vertex_areas(V: Floats, F: Ints) -> Floats:
    areas = np.bincount(F.ravel(), np.repeat(face_areas(V, F) / 3, 3), len(V))
    return np.maximum(areas, 1e-9 * areas.mean())


def _laplacian(V: Floats, F: Ints) -> Any:
    import igl
    from scipy.sparse import coo_matrix

    half_cot = np.clip(igl.cotmatrix_entries(V, F), 1e-3, 50.0).ravel()
    i, j = F[:, [1, 2, 0]].ravel(), F[:, [2, 0, 1]].ravel()
    n = len(V)
    off = coo_matrix((half_cot, (i, j)), shape=(n, n)).tocsr()
    off = off + off.T
    degree = np.asarray(off.sum(1)).ravel()
    return (coo_matrix((degree, (np.arange(n), np.arange(n))), shape=(n, n)) - off).tocsr()
