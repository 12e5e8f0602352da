"""Rays through the pieces."""

from __future__ import annotations

from typing import Any

import numpy as np

from meshjig.mesh.sampling import Soup
from meshjig.mesh.types import Floats, Ints

__all__ = ["first_hit", "scene_of"]

_SKIN = 1e-3  # mm; rays start this far from the surface, since Embree works in float32


def scene_of(s: Soup) -> Any:
    """Ready all pieces for rays."""
    from embreex import rtcore_scene
    from embreex.mesh_construction import TriangleMesh

    scene = rtcore_scene.EmbreeScene()
    TriangleMesh(scene, s.V[s.F].astype(np.float32))
    return scene


def first_hit(scene: Any, s: Soup, P: Floats, direction: Floats) -> tuple[Ints, Floats]:
    """Shoot rays from points of the surface; give the faces they meet, -1 for none, and the way there.

    The way is measured to the plane of the face in double precision.
    """
    origin = P + _SKIN * direction
    face = np.asarray(scene.run(origin.astype(np.float32), direction.astype(np.float32)), np.int64)
    toward = np.einsum("ij,ij->i", s.N[face], direction)
    height = np.einsum("ij,ij->i", s.N[face], s.V[s.F[face, 0]] - P)
    flat = np.abs(toward) < 1e-6
    way = np.where(flat, np.inf, height / np.where(flat, 1.0, toward))
    return np.where(way > 0, face, -1), way
