"""Parts of a mesh that are worked on alone: patches of vertices that are smoothed, and faces cut out."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints, connected
from meshjig.mesh.smoothing import solve_screened
from meshjig.solid.crossing_pairs import near

__all__ = ["Submesh", "VertexPatches", "submesh_around"]


class VertexPatches:
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

    def filled(self, values: Floats, patch: Ints) -> Floats:
        """Fill a patch so that each value is the mean of its neighbours', with all outside held.

        A part of the patch that is a whole component of the mesh keeps its values.

        Returns
        -------
        (k, d) float64, the patch's values
        """
        from scipy.sparse import diags
        from scipy.sparse.linalg import splu

        rows = self._L[patch]
        inside = rows[:, patch]
        held = 1e-9 * self.degree[patch]
        rhs = held[:, None] * values[patch] + inside @ values[patch] - rows @ values
        return np.asarray(splu((inside + diags(held)).tocsc()).solve(rhs))

    def mean(self, values: Floats, patch: Ints) -> Floats:
        """Give the mean of values (n, d) over the neighbours of a patch's vertices, (k, d)."""
        return values[patch] - (self._L[patch] @ values) / self.degree[patch][:, None]

    def components(self, patch: Ints) -> Ints:
        """Number the connected parts of a patch, (k,) int64."""
        a, b = self._L[patch][:, patch].nonzero()
        return connected(len(patch), a, b)[1]

    def bump(self, core: Ints, scale: float) -> tuple[Ints, Floats]:
        """Give a patch and weights on it that are 1 at the core and fall to 0 over about the scale (mm)."""
        patch = self.around(core, 2 * scale)
        weight = np.zeros((len(self.degree), 1))
        weight[core] = 1.0
        soft = np.minimum(1.0, 2 * self.smoothed(weight, scale, patch))
        return patch, np.maximum(weight[patch], soft)


@dataclass(frozen=True)
class Submesh:
    """Some faces of a mesh, and the vertices they use."""

    faces: Ints  # (k,), into the mesh
    vertices: Ints  # (j,), into the mesh
    F: Ints  # (k, 3), corners into vertices
    held: Bools  # (j,), the vertices where the part was cut out

    def inside(self, pairs: Ints, n_faces: int) -> Ints:
        """Renumber pairs of faces of two sheets, the second's counted from n_faces; others drop out."""
        number = np.full(n_faces, -1)
        number[self.faces] = np.arange(len(self.faces))
        sheet, face = np.divmod(pairs, n_faces)
        known = (number[face] >= 0).all(1)
        return number[face[known]] + sheet[known] * len(self.faces)


def submesh_around(V: Floats, F: Ints, core: Bools, reach: float) -> Submesh:
    """Cut out the faces within about a reach of some.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64
    core : (m,) bool
    reach : float, mm, to the nearest vertex left out, or twice that

    Returns
    -------
    Submesh
    """
    faces = np.flatnonzero(near(V, F, core, reach))
    vertices, G = np.unique(F[faces], return_inverse=True)
    outside = np.ones(len(F), bool)
    outside[faces] = False
    shared = np.zeros(len(V), bool)
    shared[F[outside].ravel()] = True
    return Submesh(faces, vertices, G.reshape(-1, 3), shared[vertices])
