"""Which faces of a model are parts of something thin: without crumbs, with tips and rims."""

from __future__ import annotations

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints, connected
from meshjig.mesh.mesh import Mesh
from meshjig.mesh.ray_thickness import RayThickness

__all__ = ["linked_faces", "thin_faces"]

_CLOSING = 0.6  # of the limit: rims and tips are no wider than that
_LEAST_AREA = 3.0  # of the square of the limit: what is smaller, on both sides together, is no part


def thin_faces(mesh: Mesh, rays: RayThickness, limit: float, certain: float) -> Bools:
    """Mark the faces of thin parts.

    What rays found is closed over some distance: at tips and rims they find no other side.

    Parameters
    ----------
    mesh : Mesh
    rays : RayThickness
    limit : float, mm
    certain : float, mm; what is thinner than that counts however small it is

    Returns
    -------
    (m,) bool
    """
    thin = rays.depth < limit
    if not thin.any():
        return thin
    thin = _closed(mesh.V[mesh.F].mean(axis=1), thin, _CLOSING * limit)
    i, j = linked_faces(mesh)
    within = thin[i] & thin[j]
    across = np.flatnonzero(thin & (rays.far >= 0))
    across = across[thin[rays.far[across]]]
    links = np.r_[i[within], across], np.r_[j[within], rays.far[across]]
    n, part = connected(len(thin), *links)
    area = np.bincount(part, mesh.areas * thin, n)
    needed = np.bincount(part, mesh.areas * (rays.depth < certain), n) > 0.01 * limit**2
    thin &= ((area >= _LEAST_AREA * limit**2) | needed)[part]
    outside = ~thin[i] & ~thin[j]
    n, part = connected(len(thin), i[outside], j[outside])
    crumb = np.bincount(part, mesh.areas * ~thin, n) < _LEAST_AREA * limit**2
    return np.asarray(thin | crumb[part])


def linked_faces(mesh: Mesh) -> tuple[Ints, Ints]:
    """List the pairs of faces that share an edge."""
    twin = mesh.edges.twin
    h = np.flatnonzero(twin > np.arange(len(twin)))
    return h // 3, twin[h] // 3


def _closed(P: Floats, inside: Bools, reach: float) -> Bools:
    """Dilate and erode a set of points by a distance."""
    from scipy.spatial import cKDTree

    def near(target: Bools, asked: Bools) -> Bools:
        tree = cKDTree(P[target])
        return np.asarray(tree.query(P[asked], distance_upper_bound=reach)[0] <= reach)

    grown = inside.copy()
    grown[~inside] = near(inside, ~inside)
    if grown.all():
        return grown
    rim = grown.copy()
    rim[inside] = False
    back = near(~grown, rim) if rim.any() else np.zeros(0, bool)
    closed = inside.copy()
    closed[rim] = ~back
    return closed
