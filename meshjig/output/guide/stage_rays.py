"""Rays into a stage: they pass through pieces that are not placed yet."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from meshjig.mesh.types import Floats, Ints
from meshjig.output.guide.light_model import Stage
from meshjig.output.pictures.view import View

__all__ = ["Met", "meet", "ways"]

Floats32 = NDArray[np.float32]

_BEHIND = np.float32(1e-4)  # radii of the model: how far behind a face a ray goes on


class Met(NamedTuple):
    """What rays met, in the scene's own scale."""

    face: Ints  # (k,), -1 for nothing
    depth: Floats32  # (k,), in lengths of the ray's direction
    corner: Floats32  # (k, 3), barycentric


def meet(stage: Stage, eye: Floats, way: Floats32) -> Met:
    """Find the first face on the way of each ray.

    Parameters
    ----------
    stage : Stage
    eye : (3,) or (k, 3) float64, mm
    way : (k, 3) float32, directions

    Returns
    -------
    Met
    """
    scene, n = stage
    start = ((eye - scene.middle) / scene.radius).astype(np.float32)
    origin = np.broadcast_to(start, way.shape).copy()
    found = scene.embree.run(origin, way, output=1)
    face, depth = found["primID"].astype(np.int64), found["tfar"]
    corner = np.stack([1 - found["u"] - found["v"], found["u"], found["v"]], 1)
    through = np.flatnonzero(face >= n)
    while len(through):
        further = depth[through] + _BEHIND
        again = scene.embree.run(origin[through] + further[:, None] * way[through], way[through], output=1)
        face[through], depth[through] = again["primID"], further + again["tfar"]
        corner[through] = np.stack([1 - again["u"] - again["v"], again["u"], again["v"]], 1)
        through = through[face[through] >= n]
    return Met(face, depth, corner)


def ways(view: View, x: Floats, y: Floats) -> Floats32:
    """Give the directions (k, 3) of rays through points of the plane at distance 1."""
    right, up, forward = view.axes.astype(np.float32)
    out = np.empty((len(x), 3), np.float32)
    for k in range(3):
        out[:, k] = forward[k] + x * right[k] + y * up[k]
    return out
