"""How a mesh was split from another: one account for cells, cuts and evened borders."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.measure import barycentric, face_areas, interpolate
from meshjig.mesh.mesh import Mesh

__all__ = ["Refinement", "at_corners", "places", "unrefined"]


@dataclass(frozen=True)
class Refinement:
    """A mesh whose faces are parts of the faces of another mesh.

    The vertices of that mesh come first, and keep their numbers.
    """

    mesh: Mesh
    of: Mesh  # the mesh that was split
    parent: Ints  # (m,), its face that a face lies in
    vertex_face: Ints  # (n,), one of its faces that a vertex lies in
    vertex_bary: Floats  # (n, 3), where in that face

    @property
    def V(self) -> Floats:
        """The vertices, (n, 3), mm."""
        return self.mesh.V

    @property
    def F(self) -> Ints:
        """The faces, (m, 3)."""
        return self.mesh.F

    def carry(self, values: Floats) -> Floats:
        """Carry what belongs to vertices of the mesh that was split, (k, d), to those of this one, (n, d)."""
        return interpolate(values, self.of.F, self.vertex_face, self.vertex_bary)

    def carry_back(self, face: Ints, bary: Floats) -> tuple[Ints, Floats]:
        """Give the faces of the mesh that was split in which places of this one lie, and where in these.

        Parameters
        ----------
        face : (k,) int64
        bary : (k, 3) float64

        Returns
        -------
        face : (k,) int64
        bary : (k, 3) float64, at least 0 where the given ones are; rows sum to 1
        """
        parent, corner = self.parent[face], self.F[face]
        known = self.vertex_face[corner] == parent[:, None]
        at = self.vertex_bary[corner]
        row, k = np.nonzero(~known)
        at[row, k] = barycentric(self.of.V, self.of.F, parent[row], self.V[corner[row, k]])
        is_corner = corner[row, k][:, None] == self.of.F[parent[row]]
        at[row, k] = np.where(is_corner.any(1)[:, None], is_corner, np.maximum(at[row, k], 0.0))
        place = np.einsum("nk,nkd->nd", bary, at)
        return parent, place / place.sum(1, keepdims=True)

    def then(self, other: Refinement) -> Refinement:
        """Split this mesh further, as another refinement does: what that is of the first mesh."""
        places = self.carry_back(other.vertex_face, other.vertex_bary)
        return Refinement(other.mesh, self.of, self.parent[other.parent], *places)


def unrefined(mesh: Mesh) -> Refinement:
    """Take a mesh for a refinement of itself."""
    return Refinement(mesh, mesh, np.arange(len(mesh.F)), *at_corners(mesh))


def at_corners(mesh: Mesh) -> tuple[Ints, Floats]:
    """Give a face that each vertex is a corner of, (n,), and where in that face it is, (n, 3)."""
    face = np.zeros(len(mesh.V), np.int64)
    for corner in mesh.F.T:
        face[corner] = np.arange(len(mesh.F))
    return face, (mesh.F[face] == np.arange(len(mesh.V))[:, None]).astype(np.float64)


def places(of: Mesh, mesh: Mesh, parent: Ints) -> tuple[Ints, Floats]:
    """Find the place on a mesh of every vertex of its refinement.

    Parameters
    ----------
    of : Mesh
    mesh : Mesh, its refinement, which keeps the numbers of its vertices
    parent : (m,) int64, the face of the first mesh that each face of the refinement lies in

    Returns
    -------
    face : (n,) int64
    bary : (n, 3) float64, at least 0; exact for the vertices of the first mesh
    """
    n = len(of.V)
    face = np.empty(len(mesh.V), np.int64)
    order = np.argsort(face_areas(of.V, of.F)[parent], kind="stable")  # of the faces around it, the largest
    face[mesh.F[order].ravel()] = np.repeat(parent[order], 3)
    bary = np.maximum(barycentric(of.V, of.F, face, mesh.V), 0.0)
    bary[:n] = of.F[face[:n]] == np.arange(n)[:, None]
    return face, bary / bary.sum(1, keepdims=True)
