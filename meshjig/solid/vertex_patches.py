"""Patches of vertices, and smoothing inside them that evens out the spacing."""

from __future__ import annotations

import numpy as np

from meshjig.mesh.smoothing import solve_screened
from meshjig.mesh.types import Bools, Floats, Ints

__all__ = ["Patches"]


class Patches:
    """Neighbourhoods on a mesh.

    Smoothing weighs all neighbours alike. On positions it also moves vertices along the surface, towards
    the middle of their neighbours: so it can open what has been folded, where cotangents would keep the fold.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64
    held : (n,) bool, vertices that no patch takes in
    """

    def __init__(self, V: Floats, F: Ints, held: Bools | None = None) -> None:
        from scipy.sparse import coo_matrix, diags

        n = len(V)
        i, j = F.ravel(), F[:, [1, 2, 0]].ravel()
        both = np.concatenate([i, j]), np.concatenate([j, i])
        weights = coo_matrix((np.ones(2 * len(i)), both), shape=(n, n)).tocsr()
        weights.data[:] = 1.0
        self.degree = np.asarray(weights.sum(1)).ravel()
        self._L = (diags(self.degree) - weights).tocsr()
        self._held = np.zeros(n, bool) if held is None else held
        length = np.linalg.norm(V[F] - V[F[:, [1, 2, 0]]], axis=2)
        corners = np.maximum(np.bincount(i, minlength=n), 1)
        self.edge: Floats = np.bincount(i, length.ravel(), n) / corners  # mean length at each vertex, mm
        self.mean_edge = float(length.mean())

    def around(self, core: Ints, radius: float) -> Ints:
        """List the vertices within about a radius (mm) of some, those included, but none that is held."""
        mark = np.zeros(len(self.degree), bool)
        front = np.unique(core)
        mark[front] = True
        for _ in range(max(1, int(np.ceil(radius / self.mean_edge)))):
            reached = np.unique(self._L[front].indices)
            front = reached[~mark[reached]]
            mark[front] = True
        return np.flatnonzero(mark & ~self._held)

    def smoothed(self, values: Floats, scale: float, patch: Ints) -> Floats:
        """Smooth values (n, d) inside a patch, with all outside held; details below the scale (mm) go.

        Returns
        -------
        (k, d) float64, the patch's values
        """
        scale = max(scale, 0.8 * self.mean_edge)
        rows = 2 * (scale / self.mean_edge) ** 2 * self._L[patch]
        degree, inside = self.degree[patch], values[patch]
        spread = inside - inside.mean(0) + scale
        return inside + solve_screened(rows[:, patch], degree, -(rows @ values), degree[:, None] * spread)

    def bump(self, core: Ints, scale: float) -> tuple[Ints, Floats]:
        """Give a patch and weights on it that are 1 at the core and fall to 0 over about the scale (mm)."""
        patch = self.around(core, 2 * scale)
        weight = np.zeros((len(self.degree), 1))
        weight[core] = 1.0
        soft = np.minimum(1.0, 2 * self.smoothed(weight, scale, patch))
        return patch, np.maximum(weight[patch], soft)
