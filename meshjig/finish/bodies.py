"""Meshes as manifold3d bodies, and back."""

from __future__ import annotations

from typing import Any

import numpy as np

from meshjig.types import Floats, Ints

__all__ = ["Body", "arrays", "body", "largest", "sound"]

Body = Any  # manifold3d.Manifold


def body(V: Floats, F: Ints) -> Body:
    """Give a closed mesh to manifold3d, in double precision."""
    import manifold3d

    mesh = manifold3d.Mesh64(np.ascontiguousarray(V, np.float64), np.ascontiguousarray(F, np.uint64))
    return manifold3d.Manifold(mesh)


def arrays(solid: Body) -> tuple[Floats, Ints]:
    """Give a body's vertices (n, 3) float64 and faces (m, 3) int64."""
    mesh = solid.to_mesh64()
    V = np.array(mesh.vert_properties, np.float64)[:, :3]
    return np.ascontiguousarray(V), np.array(mesh.tri_verts, np.int64)


def sound(solid: Body) -> bool:
    """Tell whether manifold3d accepts a body, and it holds something."""
    import manifold3d

    return bool(solid.status() == manifold3d.Error.NoError and solid.volume() > 0)


def largest(solid: Body) -> Body:
    """Give the largest connected part of a body."""
    return max(solid.decompose(), key=lambda part: float(part.volume()), default=solid)
