"""Which side of a thin part gives its pieces: a direction through the part, alike all over it."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints, connected
from meshjig.mesh.chains import summed_along
from meshjig.mesh.measure import unit
from meshjig.mesh.mesh import Mesh
from meshjig.mesh.ray_thickness import RayThickness
from meshjig.mesh.smoothing import solve_screened
from meshjig.thin.thin_faces import linked_faces

__all__ = ["Sides", "choose_sides", "smoothed_sides"]

_FLAT = 0.2  # weight of a part's flattest direction, beside its rays
_NORMAL_SCALE = 0.15  # of the scale: over which normals are smoothed before they decide
_STEEP = 0.2  # cosine to the way through: what is steeper goes with the far side, so that no knob lies on it
_VOTES = 30  # rounds in which a face goes where two of its neighbours are
_SOLVED = 1e-3


class Sides(NamedTuple):
    """Directions and sides of thin parts."""

    direction: Floats  # (m, 3), unit, through the part towards the side that owns it; zero elsewhere
    owns: Bools  # (m,), faces whose pieces reach through
    far: Bools  # (m,), faces of the other side


class _Links(NamedTuple):
    i: Ints  # (k,), rows of thin faces
    j: Ints  # (k,)
    weight: Floats  # (k,)


def choose_sides(mesh: Mesh, thin: Bools, rays: RayThickness, scale: float) -> Sides:
    """Divide every thin part into a side that owns it and its far side.

    The way through is a field of lines that turns slowly: the rays of faces, averaged over the surface and
    across the part; where any way goes through, as in a rod, the part's flattest direction decides. Lines get
    their signs along a tree, and the larger side owns the part.

    Parameters
    ----------
    mesh : Mesh
    thin : (m,) bool
    rays : RayThickness
    scale : float, mm, over which directions even out

    Returns
    -------
    Sides
    """
    faces = np.flatnonzero(thin)
    links = _links(mesh, faces, rays)
    n, part = connected(len(faces), links.i, links.j)
    area, N = mesh.areas[faces], unit(mesh.area_vectors)[faces]
    lines = _outer(rays.across[faces]) + _FLAT * _flattest(mesh, faces, part, n)[part]
    lines = _smoothed(lines.reshape(-1, 9), area, links, scale).reshape(-1, 3, 3)
    way = _alike(np.linalg.eigh(lines)[1][:, :, 2], links, part, n)
    facing = np.bincount(part, area * np.sign(np.einsum("ij,ij->i", N, way)), n)
    way *= np.where(facing < 0, -1.0, 1.0)[part][:, None]
    k = len(links.i) - len(_across(faces, rays, thin)[0])
    near = _Links(links.i[:k], links.j[:k], links.weight[:k])
    smooth = _smoothed(N, area, near, _NORMAL_SCALE * scale)
    direction = np.zeros((len(thin), 3))
    direction[faces] = way
    far = np.zeros(len(thin), bool)
    far[faces] = np.einsum("ij,ij->i", smooth, way) <= _STEEP
    far = smoothed_sides(mesh, far, thin)
    return Sides(direction, thin & ~far, far)


def _across(faces: Ints, rays: RayThickness, thin: Bools) -> tuple[Ints, Ints]:
    """List the faces of thin parts with a thin face across, and those."""
    far = rays.far[faces]
    linked = (far >= 0) & thin[far]
    return faces[linked], far[linked]


def _links(mesh: Mesh, faces: Ints, rays: RayThickness) -> _Links:
    """Link thin faces to their neighbours, then to those across, the less the thicker the part."""
    number = np.full(len(mesh.F), -1)
    number[faces] = np.arange(len(faces))
    i, j = linked_faces(mesh)
    both = (number[i] >= 0) & (number[j] >= 0)
    here, there = _across(faces, rays, number >= 0)
    weight = mesh.areas[here] / np.maximum(rays.depth[here], 0.1) ** 2
    return _Links(
        np.r_[number[i[both]], number[here]],
        np.r_[number[j[both]], number[there]],
        np.r_[np.ones(int(both.sum())), np.minimum(weight, 1.0)],
    )


def _outer(v: Floats) -> Floats:
    return np.asarray(v[:, :, None] * v[:, None, :])


def _flattest(mesh: Mesh, faces: Ints, part: Ints, n: int) -> Floats:
    """Give each part's direction of least extent, as (n, 3, 3) projections onto it."""
    P, area = mesh.V[mesh.F[faces]].mean(axis=1), mesh.areas[faces]
    total = np.bincount(part, area, n)
    centre = np.stack([np.bincount(part, area * x, n) for x in P.T], 1) / total[:, None]
    X = P - centre[part]
    spread = [np.bincount(part, area * X[:, p] * X[:, q], n) / total for p in range(3) for q in range(3)]
    return _outer(np.linalg.eigh(np.stack(spread, 1).reshape(-1, 3, 3))[1][:, :, 0])


def _smoothed(values: Floats, area: Floats, links: _Links, scale: float) -> Floats:
    """Average values, (k, d), over linked faces."""
    from scipy.sparse import coo_matrix, diags

    k = len(area)
    W = coo_matrix((links.weight, (links.i, links.j)), (k, k)).tocsr()
    W = W + W.T
    L = (scale * scale) * (diags(np.asarray(W.sum(1)).ravel()) - W).tocsr()
    rhs = area[:, None] * values
    return values + solve_screened(L, area, -(L @ values), rhs, _SOLVED)


def _alike(way: Floats, links: _Links, part: Ints, n: int) -> Floats:
    """Give lines the signs that agree along a tree over the links where they differ least."""
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import breadth_first_order, minimum_spanning_tree

    k = len(way)
    differ = 1.0 + 1e-6 - np.abs(np.einsum("ij,ij->i", way[links.i], way[links.j]))
    first = np.unique(part, return_index=True)[1]
    i, j = np.r_[links.i, np.full(n, k)], np.r_[links.j, first]  # one more, so that all are one tree
    tree = minimum_spanning_tree(coo_matrix((np.r_[differ, np.ones(n)], (i, j)), (k + 1, k + 1)).tocsr())
    before = breadth_first_order(tree, k, directed=False)[1].astype(np.int64)
    before[k] = k
    before[first] = first
    against = np.einsum("ij,ij->i", way, way[np.minimum(before[:k], k - 1)]) < 0
    flips = summed_along(before[:k], against.astype(np.int64))[0]
    return way * np.where(flips % 2, -1.0, 1.0)[:, None]


def smoothed_sides(mesh: Mesh, far: Bools, thin: Bools) -> Bools:
    """Make the border between two sides smooth: a face goes where two of its neighbours are."""
    beside = mesh.edges.twin.reshape(-1, 3) // 3
    for _ in range(_VOTES):
        voted = (far[beside].sum(1) >= 2) & thin
        if (voted == far).all():
            break
        far = voted
    return far
