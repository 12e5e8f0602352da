"""A part of a mesh cut out around some faces, to be worked on alone."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from meshjig.mesh.types import Bools, Floats, Ints
from meshjig.solid.crossing_pairs import near

__all__ = ["Part", "part_around"]


@dataclass(frozen=True)
class Part:
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


def part_around(V: Floats, F: Ints, core: Bools, reach: float) -> Part:
    """Cut out the faces within about a reach of some.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64
    core : (m,) bool
    reach : float, mm, to the nearest vertex left out, or twice that

    Returns
    -------
    Part
    """
    faces = np.flatnonzero(near(V, F, core, reach))
    vertices, G = np.unique(F[faces], return_inverse=True)
    outside = np.ones(len(F), bool)
    outside[faces] = False
    shared = np.zeros(len(V), bool)
    shared[F[outside].ravel()] = True
    return Part(faces, vertices, G.reshape(-1, 3), shared[vertices])
