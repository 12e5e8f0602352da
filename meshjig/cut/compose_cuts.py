"""Put together what a mesh that was cut twice is: first as a whole, then some of its faces once more."""

from typing import NamedTuple

import numpy as np

from meshjig.mesh.arrays import equal_pairs
from meshjig.mesh.halfedges import edge_keys, next_halfedge
from meshjig.mesh.measure import barycentric, interpolate
from meshjig.mesh.types import Atlas, CutMesh, Floats, Ints, Mesh, Outlines

__all__ = ["ComposedCut", "compose_cuts"]

_SAME_PLACE = 1e-6  # mm in the plane


class ComposedCut(NamedTuple):
    """A mesh cut twice, as if it had been cut once."""

    cut: CutMesh
    outlines: Outlines  # the first ones, then a segment for every edge of the second cut
    point: Ints  # (p,), where the points of the second outlines are among theirs; -1 off the mesh
    part_of: Ints  # (c,), the segments of the second outlines that the added ones are parts of, in order


def compose_cuts(
    atlas: Atlas, outlines: Outlines, first: CutMesh, chosen: Ints, kept: Ints, second: CutMesh
) -> ComposedCut:
    """Carry a cut of some faces of a cut mesh back to the atlas of the whole mesh.

    Parameters
    ----------
    atlas : Atlas
    outlines : Outlines, along which its mesh was cut first
    first : CutMesh
    chosen : (k,) int64, faces of the first cut
    kept : (v,) int64, their vertices
    second : CutMesh
        Of the mesh (first.V[kept], chosen faces), along outlines in whatever plane.

    Returns
    -------
    ComposedCut
        Vertices of the first cut keep their numbers. Where the second cut has been, it says which label
        and region faces have; its numbers follow those of the first.
    """
    n, n_kept = len(first.V), len(kept)
    number = np.concatenate([kept, n + np.arange(len(second.V) - n_kept)])
    rest = np.ones(len(first.F), bool)
    rest[chosen] = False
    rest_faces = np.flatnonzero(rest)
    face = np.concatenate([rest_faces, chosen[second.parent]])
    F = np.concatenate([first.F[rest_faces], number[second.F]])
    V = np.concatenate([first.V, second.V[n_kept:]])

    on, bary = chosen[second.vertex_face[n_kept:]], second.vertex_bary[n_kept:]
    parent, place = first.carry_back(on, bary)
    vertex_face = np.concatenate([first.vertex_face, parent])
    vertex_bary = np.concatenate([first.vertex_bary, place])
    cuts, source, param = _split(first, n + np.arange(len(on)), on, bary)

    order = np.lexsort([second.cut_param[:, 0], second.cut_segment])
    added = number[second.cuts[order]]
    left, right = (_face_left_of(F, way, len(V)) for way in (added, added[:, ::-1]))
    points, point_vertex, segments = _drawn(atlas, V, first.parent[face[left]], added)
    label = np.concatenate([first.label[rest_faces], int(first.label.max()) + 1 + second.label])
    region = np.concatenate([first.region[rest_faces], int(first.region.max()) + 1 + second.region])
    n_segments = len(outlines.segments)
    cut = CutMesh(
        mesh=Mesh(V, F),
        of=atlas.mesh,
        parent=first.parent[face],
        label=label,
        region=region,
        vertex_face=vertex_face,
        vertex_bary=vertex_bary,
        point_vertex=np.concatenate([first.point_vertex, point_vertex]),
        cuts=np.concatenate([cuts, added]),
        cut_segment=np.concatenate([source, n_segments + np.arange(len(added))]),
        cut_param=np.concatenate([param, np.tile([0.0, 1.0], (len(added), 1))]),
        facts=first.facts,
    )
    whole = _extended(outlines, points, segments, label[left], label[right])
    point = np.full(len(V) + 1, -1)
    point[point_vertex] = len(outlines.points) + np.arange(len(points))
    landed = np.where(second.point_vertex >= 0, number[second.point_vertex], -1)
    return ComposedCut(cut, whole, point[landed], second.cut_segment[order])


def _split(first: CutMesh, vertex: Ints, on: Ints, bary: Floats) -> tuple[Ints, Ints, Floats]:
    """Divide cuts at new vertices (k,) on them, which lie at bary (k, 3) in faces of the cut mesh."""
    at_edge = np.flatnonzero((bary == 0).sum(1) == 1)
    opposite = (bary[at_edge] == 0).argmax(1)
    rows = np.arange(len(at_edge))
    corner = first.F[on[at_edge]]
    a, b = corner[rows, (opposite + 1) % 3], corner[rows, (opposite + 2) % 3]
    towards_b = bary[at_edge, (opposite + 2) % 3]
    n = len(first.V)
    key, of_cut = edge_keys(np.stack([a, b], 1), n), edge_keys(first.cuts, n)
    of, hit = equal_pairs(key, of_cut)  # a cut may be there twice, where two segments fell together
    along = np.where(first.cuts[hit, 0] == a[of], towards_b[of], 1 - towards_b[of])

    cut = np.concatenate([np.arange(len(of_cut)), np.arange(len(of_cut)), hit])
    t = np.concatenate([np.zeros(len(of_cut)), np.ones(len(of_cut)), along])
    v = np.concatenate([first.cuts[:, 0], first.cuts[:, 1], vertex[at_edge[of]]])
    order = np.lexsort([t, cut])
    cut, t, v = cut[order], t[order], v[order]
    step = np.flatnonzero(cut[1:] == cut[:-1])
    of_step, p = cut[step], first.cut_param
    span = p[of_step, 1] - p[of_step, 0]
    param = p[of_step, 0][:, None] + span[:, None] * np.stack([t[step], t[step + 1]], 1)
    return np.stack([v[step], v[step + 1]], 1), first.cut_segment[of_step], param


def _face_left_of(F: Ints, cuts: Ints, n: int) -> Ints:
    """Give the face on the left of every edge (c, 2), which has one on either side; (c,)."""
    near = np.zeros(n, bool)
    near[cuts] = True
    at_corner = near[F]
    h = np.flatnonzero(at_corner & at_corner[:, [1, 2, 0]])
    start, end = F.ravel()[h], F.ravel()[next_halfedge(h)]
    key = start * np.int64(n) + end
    order = np.argsort(key)
    at = np.searchsorted(key[order], cuts[:, 0] * np.int64(n) + cuts[:, 1])
    left: Ints = h[order[np.minimum(at, len(order) - 1)]] // 3
    return left


def _drawn(atlas: Atlas, V: Floats, parent: Ints, cuts: Ints) -> tuple[Floats, Ints, Ints]:
    """Draw cuts (c, 2), each in a face of the mesh, in the plane of the atlas.

    Returns
    -------
    points : (p, 2) float64, mm; one for every vertex and chart
    vertex : (p,) int64
    segments : (c, 2) int64, into points
    """
    face, vertex = np.repeat(parent, 2), cuts.ravel()
    uv = interpolate(atlas.uv, atlas.F_uv, face, barycentric(atlas.mesh.V, atlas.mesh.F, face, V[vertex]))
    name = np.column_stack([vertex, np.rint(uv / _SAME_PLACE).astype(np.int64)])
    _, sample, point = np.unique(name, axis=0, return_index=True, return_inverse=True)
    return uv[sample], vertex[sample], point.reshape(-1, 2)


def _extended(outlines: Outlines, points: Floats, segments: Ints, left: Ints, right: Ints) -> Outlines:
    """Add points and segments between them to outlines."""
    n, k = len(outlines.points), len(outlines.segments)
    same_point, same_segment = outlines.same_point, outlines.same_segment
    return Outlines(
        np.concatenate([outlines.points, points]),
        np.concatenate([outlines.segments, n + segments]),
        np.concatenate([outlines.left, left]),
        np.concatenate([outlines.right, right]),
        None if same_point is None else np.concatenate([same_point, n + np.arange(len(points))]),
        None if same_segment is None else np.concatenate([same_segment, k + np.arange(len(segments))]),
    )
