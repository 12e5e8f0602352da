"""Rays from the surface of pieces to other pieces."""

from __future__ import annotations

import numpy as np

from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.rays import RayScene
from meshjig.mesh.sampling import Soup

__all__ = ["first_hit", "scene_of"]

_SKIN = 1e-3  # mm; rays start this far from the surface, since Embree works in float32


def scene_of(s: Soup) -> RayScene:
    """Ready all pieces for rays."""
    return RayScene(s.V, s.F)


def first_hit(scene: RayScene, s: Soup, P: Floats, direction: Floats) -> tuple[Ints, Floats]:
    """Shoot rays from points of the surface; give the faces they meet, -1 for none, and how far it is.

    The distance is measured to the plane of the face in double precision.
    """
    face = scene.first_face(P + _SKIN * direction, direction)
    toward = np.einsum("ij,ij->i", s.N[face], direction)
    height = np.einsum("ij,ij->i", s.N[face], s.V[s.F[face, 0]] - P)
    flat = np.abs(toward) < 1e-6
    way = np.where(flat, np.inf, height / np.where(flat, 1.0, toward))
    return np.where(way > 0, face, -1), way
