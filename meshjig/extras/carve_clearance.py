"""Cut from a body whatever is nearer to faces around it than asked."""

from __future__ import annotations

from typing import Any

import numpy as np

from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.booleans import Body
from meshjig.mesh.measure import unit

__all__ = ["carve_clearance"]

_OVER = 1.02  # of the distance: balls are made of flat faces


def carve_clearance(core: Body, V: Floats, F: Ints, distance: float) -> Body:
    """Take from a body what is nearer to faces than a distance.

    Parameters
    ----------
    core : Body
    V : (n, 3) float64, mm
    F : (k, 3) int64, the faces
    distance : float, mm

    Returns
    -------
    Body

    Notes
    -----
    One convex hull a face; meant for some hundreds.
    """
    import manifold3d

    ball = _OVER * distance * _directions()
    hulls = [manifold3d.Manifold.hull_points((corners[:, None] + ball).reshape(-1, 3)) for corners in V[F]]
    return core - manifold3d.Manifold.batch_boolean(hulls, manifold3d.OpType.Add)


def _directions() -> Floats:
    """Give corners of a body of 80 faces that a ball of radius 1 just fits in, (42, 3)."""
    golden = (1 + np.sqrt(5)) / 2
    few = [[0, s, t * golden] for s in (-1, 1) for t in (-1, 1)]
    corners = unit(np.concatenate([np.roll(np.array(few), k, axis=1) for k in range(3)]))
    near = np.argwhere(np.triu(corners @ corners.T > 0.4, 1))
    directions: Floats = np.concatenate([corners, unit(corners[near[:, 0]] + corners[near[:, 1]])])
    return directions / _inner_radius(directions)


def _inner_radius(directions: Floats) -> Any:
    from scipy.spatial import ConvexHull

    return (-ConvexHull(directions).equations[:, 3]).min()
