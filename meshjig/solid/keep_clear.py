"""A body that yields where other bodies come too near to it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from meshjig.mesh.arrays import Bools
from meshjig.mesh.booleans import arrays, body, largest, sound
from meshjig.mesh.mesh import Mesh
from meshjig.solid.cutters import ball

__all__ = ["keep_clear"]

_WANTED = 1.02  # of the clearance: how thick the others become where they are near
_NEAR = 1.5  # of the clearance: faces farther from the body than that can't matter
_SHORTEST = 0.003  # mm; details of the booleans below this are dissolved


def keep_clear(solid: Mesh, others: Sequence[Mesh], clearance: float) -> Mesh:
    """Take from a body what lies in others, or nearer to them than a gap.

    Parameters
    ----------
    solid : Mesh, closed, mm
    others : sequence of Mesh, closed, which stay as they are
    clearance : float, mm

    Returns
    -------
    Mesh, its largest part; the body as it was where nothing sound would be left
    """
    import manifold3d

    whole = body(*solid)
    cutters = []
    for other in others:
        near = other.V[other.F[_near(other, solid, _NEAR * clearance)]]
        if not len(near):
            continue
        round_ = _WANTED * clearance * ball()
        cutters.append(body(*other))
        cutters += [manifold3d.Manifold.hull_points((x[:, None] + round_).reshape(-1, 3)) for x in near]
    if not cutters:
        return solid
    rest = manifold3d.Manifold.batch_boolean([whole, *cutters], manifold3d.OpType.Subtract)
    rest, _, _ = largest(rest.simplify(_SHORTEST))
    return Mesh(*arrays(rest)) if sound(rest) else solid


def _near(other: Mesh, solid: Mesh, reach: float) -> Bools:
    """Mark faces that come near a body, by boxes and by places all over them; (m,)."""
    import igl

    low, high = solid.V.min(axis=0) - reach, solid.V.max(axis=0) + reach
    corners = other.V[other.F]
    near = ((corners.max(axis=1) >= low) & (corners.min(axis=1) <= high)).all(axis=1)
    faces = np.flatnonzero(near)
    if not len(faces):
        return near
    middle = corners[faces].mean(axis=1)
    radius = np.linalg.norm(corners[faces] - middle[:, None], axis=2).max(axis=1)
    squared, face, nearest = igl.point_mesh_squared_distance(middle, solid.V, solid.F)[:3]
    inside = np.einsum("ij,ij->i", middle - nearest, solid.area_vectors[face]) < 0
    near[faces] = inside | (np.sqrt(squared) <= reach + radius)
    return near
