"""Split faces that hold outlines which never reach their border.

Such an outline would be a hole in a part of the face. A new vertex behind it, joined to the corners
of the face, makes it cross an edge.
"""

from typing import NamedTuple

import numpy as np

from meshjig.cut.places import kept_off_edges
from meshjig.cut.predicates import orient
from meshjig.cut.snap import Graph
from meshjig.cut.trace import Trace, trace
from meshjig.cut.uv_mesh import UvMesh, make_uv_mesh
from meshjig.mesh.arrays import connected
from meshjig.mesh.types import Bools, Floats, Ints

__all__ = ["Joined", "Origin", "in_mesh", "without_islands"]

ROUNDS = 60  # each round splits every face with islands once


class Origin(NamedTuple):
    """Where the faces of a UV mesh came from: whole faces first, then parts of faces."""

    face: Ints  # (m,), the face of the mesh
    n_whole: int
    bary: Floats  # (m - n_whole, 3, 3), where the corners of a part lie in its face of the mesh


class Joined(NamedTuple):
    """A UV mesh in which all outlines are joined to the borders of their faces."""

    uv_mesh: UvMesh  # new vertices come after the old ones
    origin: Origin
    graph: Graph
    seen: Trace  # of the graph on the UV mesh


def in_mesh(origin: Origin, face: Ints, bary: Floats) -> tuple[Ints, Floats]:
    """Carry places (face, bary (n, 3)) from the UV mesh to the mesh."""
    part = np.flatnonzero(face >= origin.n_whole)
    if len(part):
        bary = bary.copy()
        bary[part] = np.einsum("nk,nkj->nj", bary[part], origin.bary[face[part] - origin.n_whole])
    return origin.face[face], bary


def without_islands(uv_mesh: UvMesh, graph: Graph) -> Joined:
    """Split faces until every outline in them is joined to their border.

    An outline too small for that, a few grid steps across, is left out.

    Returns
    -------
    Joined
    """
    m = len(uv_mesh.F)
    first = trace(uv_mesh, graph)
    lonely = _island_segments(first)
    if not len(lonely):
        return Joined(uv_mesh, Origin(np.arange(m), m, np.zeros((0, 3, 3))), graph, first)

    faces = np.unique(first.face_segments.face[lonely])
    part = _Part(
        make_uv_mesh(uv_mesh.V, uv_mesh.F[faces], uv_mesh.U, uv_mesh.F_uv[faces], uv_mesh.chart[faces]),
        faces,
        np.tile(np.eye(3), (len(faces), 1, 1)),
    )
    for _ in range(ROUNDS):
        seen = trace(part.uv_mesh, graph)
        lonely = _island_segments(seen)
        if not len(lonely):
            break
        split = _split(part, graph, seen, lonely)
        if split is None:
            break
        part = split
    if len(lonely):
        kept = np.ones(len(graph.segments), bool)
        kept[seen.face_segments.segment[lonely]] = False
        graph = graph.take(kept)

    whole = np.setdiff1d(np.arange(m), faces, assume_unique=True)
    merged = make_uv_mesh(
        part.uv_mesh.V,
        np.concatenate([uv_mesh.F[whole], part.uv_mesh.F]),
        part.uv_mesh.U,
        np.concatenate([uv_mesh.F_uv[whole], part.uv_mesh.F_uv]),
        np.concatenate([uv_mesh.chart[whole], part.uv_mesh.chart]),
    )
    origin = Origin(np.concatenate([whole, part.face]), len(whole), part.bary)
    return Joined(merged, origin, graph, trace(merged, graph))


class _Part(NamedTuple):
    uv_mesh: UvMesh
    face: Ints
    bary: Floats


def _island_segments(seen: Trace) -> Ints:
    """List the segments that no chain of segments joins to the border of their face."""
    n_crossings = len(seen.crossings.side)
    start = np.maximum(seen.face_segments.start - n_crossings, -1) + 1
    end = np.maximum(seen.face_segments.end - n_crossings, -1) + 1
    inner = np.flatnonzero((start > 0) & (end > 0))
    if not len(inner):
        return inner
    n = len(seen.hits.point) + 1
    _, label = connected(n, start, end)
    return inner[label[start[inner]] != label[0]]


def _split(part: _Part, graph: Graph, seen: Trace, lonely: Ints) -> _Part | None:
    """Split each face with lonely segments into three; None when none can be."""
    uv_mesh, origin, corners = part
    face, points, bary = _behind(uv_mesh, graph, seen, lonely)
    if not len(face):
        return None
    bary = kept_off_edges(bary, uv_mesh.V[uv_mesh.F[face]])
    middle = np.einsum("nk,nkj->nj", bary, corners[face])
    V = np.concatenate([uv_mesh.V, np.einsum("nk,nkd->nd", bary, uv_mesh.V[uv_mesh.F[face]])])
    U = np.concatenate([uv_mesh.U, points])
    keep = np.ones(len(uv_mesh.F), bool)
    keep[face] = False
    kept = np.flatnonzero(keep)
    parts, F, F_uv, C = [kept], [uv_mesh.F[kept]], [uv_mesh.F_uv[kept]], [corners[kept]]
    new, new_uv = len(uv_mesh.V) + np.arange(len(face)), len(uv_mesh.U) + np.arange(len(face))
    for k in range(3):
        j = (k + 1) % 3
        parts.append(face)
        F.append(np.stack([uv_mesh.F[face, k], uv_mesh.F[face, j], new], 1))
        F_uv.append(np.stack([uv_mesh.F_uv[face, k], uv_mesh.F_uv[face, j], new_uv], 1))
        C.append(np.stack([corners[face, k], corners[face, j], middle], 1))
    of = np.concatenate(parts)
    split = make_uv_mesh(V, np.concatenate(F), U, np.concatenate(F_uv), uv_mesh.chart[of])
    return _Part(split, origin[of], np.concatenate(C))


def _behind(uv_mesh: UvMesh, graph: Graph, seen: Trace, lonely: Ints) -> tuple[Ints, Ints, Floats]:
    """Choose, in each face, a lonely segment and a point that a corner sees through its middle.

    Returns
    -------
    face : (f,) int64
    points : (f, 2) int64, in the plane
    bary : (f, 3) float64, the same in the face
    """
    ends = graph.points[graph.segments[seen.face_segments.segment[lonely]]]
    middle = ends.mean(axis=1)
    face = seen.face_segments.face[lonely]
    corners = uv_mesh.U[uv_mesh.F_uv[face]].astype(float)
    off = np.linalg.norm(middle - corners.mean(axis=1), axis=1)
    order = np.lexsort((off, face))
    chosen = order[_first_of_runs(face[order])]
    ends, middle, face, corners = ends[chosen], middle[chosen], face[chosen], corners[chosen]

    along = (ends[:, 1] - ends[:, 0]).astype(float)
    ray = middle[:, None, :] - corners
    across = np.abs(along[:, None, 0] * ray[:, :, 1] - along[:, None, 1] * ray[:, :, 0])
    across /= np.maximum(np.linalg.norm(ray, axis=2), 1e-300)
    k, i = across.argmax(axis=1), np.arange(len(face))
    ray, far = ray[i, k], _weights(corners, middle)[i, k]
    reach = np.minimum(
        0.5 * far / np.maximum(1 - far, 1e-300),
        np.linalg.norm(along, axis=1) / np.maximum(np.linalg.norm(ray, axis=1), 1e-300),
    )
    points = np.rint(middle + reach[:, None] * ray).astype(np.int64)
    bary = _weights(corners, points.astype(float))
    sound = (bary > 0).all(axis=1)
    return face[sound], points[sound], bary[sound]


def _first_of_runs(x: Ints) -> Bools:
    return np.append(True, x[1:] != x[:-1])


def _weights(corners: Floats, p: Floats) -> Floats:
    """Give barycentric coordinates of p (n, 2) in corners (n, 3, 2)."""
    a, b, c = (corners[:, k].astype(np.int64) for k in range(3))
    q, d, e = p - corners[:, 0], corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    area = np.where(orient(a, b, c) == 0, 1, orient(a, b, c)).astype(float)
    v = (q[:, 0] * e[:, 1] - q[:, 1] * e[:, 0]) / area
    w = (d[:, 0] * q[:, 1] - d[:, 1] * q[:, 0]) / area
    return np.stack([1 - v - w, v, w], 1)
