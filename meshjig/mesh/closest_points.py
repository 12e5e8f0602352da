"""Where on a light mesh points are nearest."""

from typing import NamedTuple

import numpy as np

from meshjig.mesh.measure import barycentric, interpolate
from meshjig.mesh.types import Floats, Ints

__all__ = ["Nearest", "nearest"]

_BEYOND = 20.0  # barycentric coordinate: how far beyond a face its plane is followed


class Nearest(NamedTuple):
    """The nearest places on a mesh."""

    face: Ints  # (k,)
    bary: Floats  # (k, 3), in the face's plane; beyond the face where the mesh has a border or a fold

    def interpolated(self, F: Ints, uv: Floats) -> Floats:
        """Give what uv (n, 2), of the corners F of the mesh's faces, is at these places, (k, 2)."""
        bary = np.clip(self.bary, -_BEYOND, _BEYOND)
        bary[:, 0] = 1 - bary[:, 1] - bary[:, 2]
        return interpolate(uv, F, self.face, bary)


def nearest(points: Floats, W: Floats, G: Ints) -> Nearest:
    """Find the face of a mesh that is nearest to each point, and the place in its plane.

    Parameters
    ----------
    points : (k, 3) float64, mm
    W, G : (n, 3) float64, mm, and (m, 3) int64

    Returns
    -------
    Nearest
    """
    import igl

    _, face, _ = igl.point_mesh_squared_distance(points, W, G)
    return Nearest(face, barycentric(W, G, face, points))
