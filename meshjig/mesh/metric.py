"""How far a step in the plane goes on the surface."""

import numpy as np

from meshjig.mesh.types import Atlas, Floats, Ints

__all__ = ["face_metric"]


def face_metric(atlas: Atlas, faces: Ints) -> Floats:
    """Give the first fundamental form of the map from the plane to the surface.

    Parameters
    ----------
    atlas : Atlas
    faces : (k,) int64

    Returns
    -------
    (k, 3) float64, the entries E, F, G of J^T J; the identity where a face has no area in the plane
    """
    x, u = atlas.mesh.V[atlas.mesh.F[faces]], atlas.uv[atlas.F_uv[faces]]
    d, e = x[:, 1] - x[:, 0], x[:, 2] - x[:, 0]
    p, q = u[:, 1] - u[:, 0], u[:, 2] - u[:, 0]
    det = p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0]
    flat = np.abs(det) < 1e-12
    det = np.where(flat, 1.0, det)[:, None]
    du = (d * q[:, 1:] - e * p[:, 1:]) / det
    dv = (e * p[:, :1] - d * q[:, :1]) / det
    metric = np.stack([(du * du).sum(1), (du * dv).sum(1), (dv * dv).sum(1)], 1)
    metric[flat] = [1.0, 0.0, 1.0]
    return metric
