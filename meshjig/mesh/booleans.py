"""Meshes as manifold3d bodies, and back."""

from __future__ import annotations

import functools
import os
from typing import Any

import numpy as np

from meshjig.mesh.types import Floats, Ints

__all__ = ["Body", "arrays", "body", "largest", "share_cores", "sound"]

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


def largest(solid: Body) -> tuple[Body, float, int]:
    """Give the largest connected part, the volume of the others in mm3, and their number.

    Hollows inside count as parts without volume.
    """
    parts = sorted(solid.decompose(), key=lambda part: -float(part.volume()))
    if not parts:
        return solid, 0.0, 0
    lost = sum(max(float(part.volume()), 0.0) for part in parts[1:])
    return parts[0], lost, len(parts) - 1


@functools.cache
def share_cores(second: bool = False) -> None:
    """Let manifold3d use half of the cores in this process, for good: another one has the others.

    Its threads are made when it first needs them, for the cores that are open to the caller then.

    Parameters
    ----------
    second : bool, take the other half
    """
    import manifold3d

    if not hasattr(os, "sched_setaffinity"):
        return
    cores = sorted(os.sched_getaffinity(0))
    half = max(1, len(cores) // 2)
    try:
        os.sched_setaffinity(0, cores[-half:] if second else cores[:half])
    except OSError:  # not allowed in here
        return
    try:
        manifold3d.Manifold.sphere(1.0, 8).num_tri()
    finally:
        os.sched_setaffinity(0, cores)
