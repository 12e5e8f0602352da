"""How thick a model is below its faces, by rays to a far side that faces back."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.measure import unit
from meshjig.mesh.mesh import Mesh
from meshjig.mesh.rays import RayScene

__all__ = ["RayThickness", "ray_thickness"]

_TURNED = -0.5  # cosine between the normals of two sides of a part: 120 degrees
_TILT = np.radians(20.0)  # of the rays around the one straight in
_AROUND = 6
_BELOW = 1e-5  # of the extent: where rays start below a face


class RayThickness(NamedTuple):
    """What rays found below faces."""

    depth: Floats  # (m,), mm, to the far side; infinite where there is none
    across: Floats  # (m, 3), unit, from the far side to the face; zero where there is none
    far: Ints  # (m,), the face on the far side, -1 for none


def ray_thickness(mesh: Mesh, most: float = np.inf) -> RayThickness:
    """Measure a model below the middle of each face, by the shortest of seven rays.

    One goes straight in, six are tilted by 20 degrees. A ray counts where the first face that it meets is
    turned by more than 120 degrees: the flanks of a ridge are no part's two sides.

    Parameters
    ----------
    mesh : Mesh, oriented outward; where it is open, rays that leave through the opening find nothing
    most : float, mm
        What is thicker counts as infinite. Faces that are so by far, straight in, get no further rays.

    Returns
    -------
    RayThickness
    """
    N = unit(mesh.area_vectors)
    start = mesh.V[mesh.F].mean(axis=1) - _BELOW * np.ptp(mesh.V, axis=0).max(initial=0.0) * N
    scene = RayScene(mesh.V, mesh.F)
    depth = np.full(len(N), np.inf)
    across, far = np.zeros_like(N), np.full(len(N), -1)
    asked = np.arange(len(N))
    for i in range(_AROUND + 1):
        way = _tilted(-N[asked], i)
        hit = scene.hits(start[asked], way)
        face = np.asarray(hit["primID"], np.int64)
        length = np.asarray(hit["tfar"], np.float64)
        if i == 0 and np.isfinite(most):
            near = (face >= 0) & (length < 2 * most)
            asked, face, length, way = asked[near], face[near], length[near], way[near]
        good = (face >= 0) & (np.einsum("ij,ij->i", N[asked], N[face]) <= _TURNED)
        good &= length < np.minimum(depth[asked], most)
        at = asked[good]
        depth[at], across[at], far[at] = length[good], -way[good], face[good]
    return RayThickness(depth, across, far)


def _tilted(inward: Floats, i: int) -> Floats:
    """Give the direction of a face's ray: straight in for 0, tilted around it else; (k, 3), unit."""
    if i == 0:
        return inward
    u = unit(np.cross(inward, np.eye(3)[np.abs(inward).argmin(axis=1)]))
    v = np.cross(inward, u)
    a = 2 * np.pi * (i - 1) / _AROUND
    return np.asarray(np.cos(_TILT) * inward + np.sin(_TILT) * (np.cos(a) * u + np.sin(a) * v))
