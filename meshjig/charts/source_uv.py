"""The UVs that came with a file: their islands, and where each face of a mesh lies in them."""

from typing import Any, NamedTuple

import numpy as np

from meshjig.errors import ChartError
from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.components import components
from meshjig.mesh.measure import area_vectors, barycentric, interpolate, sums
from meshjig.mesh.mesh import Mesh

__all__ = ["SourceUV", "are_connected", "is_as_loaded", "island_seams", "sample", "source_uv"]

_SAME = 2.0**-30  # of the extent: vertices nearer than that, with equal UVs, are one
_AS_LOADED = 1e-9  # of the extent: corners that near to the file's are those
_INSET = 0.8  # share from a face's middle to its corners: what lies on a seam would belong to both sides
_APART = 0.5  # of an edge's length in the texture: sides farther apart are those of a seam
_TORN = 0.02  # of an island's area


class SourceUV(NamedTuple):
    """A mesh with UVs."""

    V: Floats  # (n, 3), mm
    F: Ints  # (m, 3)
    uv: Floats  # (n, 2), in widths of the texture
    island: Ints  # (m,), faces that are connected in the texture


def source_uv(source: Any, to_source: Floats) -> SourceUV:
    """Bring a loaded mesh and its UVs into the coordinates of the working mesh.

    Parameters
    ----------
    source : with vertices (n, 3), faces (m, 3) and look.uv (m, 3, 2), such as a loaded mesh
    to_source : (4, 4) float64, takes mesh coordinates to those of source

    Raises
    ------
    ChartError
        There are no UVs, or they are no numbers.
    """
    X, F = np.asarray(source.vertices, np.float64), np.asarray(source.faces, np.int64)
    uv = source.look.uv
    if uv is None:
        raise ChartError("the file holds no UVs", hint="use --charts auto")
    if not np.isfinite(uv).all():
        raise ChartError("the file's UVs are not all numbers", hint="use --charts auto")
    V = np.linalg.solve(to_source, np.c_[X, np.ones(len(X))].T).T[:, :3]
    # files split vertices at creases too: joined again, islands end at seams of the texture only
    V, uv = V[F.ravel()], uv.reshape(-1, 2)
    place = np.c_[V / max(float(np.ptp(V, axis=0).max()), 1e-300), uv]
    _, first, number = np.unique(np.rint(place / _SAME), axis=0, return_index=True, return_inverse=True)
    F = number.reshape(-1, 3)
    whole = (F[:, 0] != F[:, 1]) & (F[:, 1] != F[:, 2]) & (F[:, 2] != F[:, 0])
    F = F[whole]
    return SourceUV(V[first], F, uv[first], components(F)[1])


def is_as_loaded(V: Floats, F: Ints, source: SourceUV) -> Bools:
    """Tell which faces of a mesh (V, F) are those of the file, in their order, (m,)."""
    if len(F) != len(source.F):
        return np.zeros(len(F), bool)
    same: Bools = np.abs(V[F] - source.V[source.F]).max((1, 2)) <= _AS_LOADED * np.ptp(V)
    return same


def sample(V: Floats, F: Ints, source: SourceUV) -> tuple[Ints, Floats]:
    """Give each face of a mesh its island, and each corner its UV there.

    Parameters
    ----------
    V, F : (n, 3) float64, mm, and (m, 3) int64
    source : SourceUV

    Returns
    -------
    island : (m,) int64, that of most places in the face; -1 where the source has no face near that
        looks the same way
    uv : (m, 3, 2) float64, as the nearest face of that island would go on
    """
    same = is_as_loaded(V, F, source)
    if not same.any():
        return _sampled(V, F, source)
    island, uv = source.island.copy(), source.uv[source.F]
    if not same.all():
        island[~same], uv[~same] = _sampled(V, F[~same], source)
    return island, uv


def _sampled(V: Floats, F: Ints, source: SourceUV) -> tuple[Ints, Floats]:
    """Look for places in the faces of a mesh where the file's are nearest."""
    import igl

    corners = V[F]
    middle = corners.mean(1)
    places = np.concatenate([middle[:, None] + _INSET * (corners - middle[:, None]), middle[:, None]], 1)
    _, near, _ = igl.point_mesh_squared_distance(places.reshape(-1, 3), source.V, source.F)
    near = near.reshape(-1, 4).astype(np.int64)
    N, M = area_vectors(V, F), area_vectors(source.V, source.F)
    alike = np.einsum("ij,ikj->ik", N, M[near])
    turned = -1 if np.sign(alike).mean() < 0 else 1  # a file may have been inside out
    found = np.where(turned * alike >= 0, source.island[near], -1)
    votes = (found[:, :, None] == found[:, None, :]).sum(2) * (found >= 0)
    votes[:, 3] *= 2  # the middle decides between equals
    island = np.take_along_axis(found, votes.argmax(1)[:, None], 1)[:, 0]
    # a corner follows the face nearest to it, or another corner's where that is of another island
    good = found == island[:, None]
    best = np.where(good.any(1), good.argmax(1), 3)
    follows = np.where(good[:, :3], near[:, :3], np.take_along_axis(near, best[:, None], 1))
    bary = np.clip(barycentric(source.V, source.F, follows.ravel(), corners.reshape(-1, 3)), -1.0, 2.0)
    bary[:, 0] = 1 - bary[:, 1] - bary[:, 2]
    uv = interpolate(source.uv, source.F, follows.ravel(), bary)
    return island, uv.reshape(-1, 3, 2)


def are_connected(mesh: Mesh, island: Ints) -> bool:
    """Tell whether the faces of each island (m,) are connected."""
    sides = np.repeat(island, 3)
    wall = sides != sides[mesh.edges.twin]
    return components(mesh.F, wall, mesh.edges.twin)[0] == len(np.unique(island))


def island_seams(mesh: Mesh, island: Ints, uv: Floats) -> tuple[Bools, Bools]:
    """Find the seams of islands on a mesh.

    Parameters
    ----------
    mesh : Mesh
    island : (m,) int64
    uv : (m, 3, 2) float64

    Returns
    -------
    seam : (e,) bool, edges whose sides lie in different islands, or apart in one
    torn : (m,) bool, faces of small parts that sampling has torn off their island, joined to it again
    """
    e = mesh.edges
    h = np.flatnonzero(e.twin > np.arange(len(e.twin)))
    t = e.twin[h]
    here, there = h // 3, t // 3
    start, end = uv.reshape(-1, 2), np.roll(uv, -1, 1).reshape(-1, 2)
    length = (np.linalg.norm(end[h] - start[h], axis=1) + np.linalg.norm(end[t] - start[t], axis=1)) / 2
    apart = np.linalg.norm(start[h] - end[t], axis=1) + np.linalg.norm(end[h] - start[t], axis=1)
    seam = np.zeros(len(e.E), bool)
    seam[e.edge_of_halfedge[h]] = (island[here] != island[there]) | (apart > _APART * length)
    _, part = components(mesh.F, seam[e.edge_of_halfedge], e.twin)
    size, of_island = (sums(x, mesh.areas, int(x.max()) + 1)[x] for x in (part, island))
    torn: Bools = size < _TORN * of_island
    mended = (island[here] == island[there]) & (torn[here] | torn[there])
    seam[e.edge_of_halfedge[h[mended]]] = False
    return seam, torn
