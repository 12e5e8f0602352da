"""Cut a mesh along planar outlines, through its charts: the whole of it, step by step."""

from typing import NamedTuple

import numpy as np

from meshjig.cut.edge_nodes import edge_nodes
from meshjig.cut.inner_halfedges import Ring, make_ring, wire
from meshjig.cut.islands import Origin, in_mesh, without_islands
from meshjig.cut.places import Places, corner_frames, half_edge_places, hit_weights
from meshjig.cut.region_labels import joined_over_seams, label_at, label_regions, regions
from meshjig.cut.snap import snap
from meshjig.cut.triangulate import Filling, fill
from meshjig.cut.uv_mesh import UvMesh, make_uv_mesh
from meshjig.mesh.cycles import Cycles, cycles
from meshjig.mesh.types import Atlas, CutMesh, Floats, Ints, Outlines

__all__ = ["Faces", "assemble_faces", "overlay", "place_vertices"]


def overlay(atlas: Atlas, outlines: Outlines) -> CutMesh:
    """Cut every face of a mesh along the outlines that cross its image in the plane.

    UV and outlines are rounded to an integer grid, on which every question has an exact answer;
    outlines are shifted by a symbolic infinitesimal, so that they meet neither mesh vertices nor lie
    along mesh edges. Then the cut mesh follows by counting alone. Cuts from both sides of a seam
    end in vertices that both sides share.

    Parameters
    ----------
    atlas : Atlas
        Faces may be mirrored, or without area, in the plane; then outlines are pulled back through
        the map all the same.
    outlines : Outlines
        They may reach beyond the charts.

    Returns
    -------
    CutMesh
        Sub-faces cover their parent exactly. No cut is shorter than about 5e-5 mm where the mesh
        is not: new vertices keep that distance on edges. facts: crossings, zero_predicates,
        ties, seam_merged, respaced, split_faces, untangled, steiner, label_conflicts, largest_part.

    Raises
    ------
    CutError
        An outline ends inside the mesh, or a coordinate is not finite.

    Notes
    -----
    Time and memory grow linearly with faces touched plus crossings; the rest of the mesh costs
    its edge list.
    """
    mesh = atlas.mesh
    U, graph = snap(atlas.uv, outlines)
    uv_mesh = make_uv_mesh(mesh.V, mesh.F, U, atlas.F_uv, atlas.chart_of_face)
    uv_mesh, origin, graph, (crossings, hits, face_segments) = without_islands(uv_mesh, graph)

    nodes = edge_nodes(uv_mesh, graph, crossings)
    ring = make_ring(uv_mesh, nodes, face_segments.face)
    wiring = wire(uv_mesh, graph, nodes, ring, face_segments, (crossings, hits))
    parts = cycles(wiring.next)
    places = half_edge_places(
        uv_mesh, ring, nodes, face_segments, hit_weights(uv_mesh, graph, hits), wiring.slot, wiring.leaving
    )
    places, filling = fill(places, parts, corner_frames(uv_mesh, ring.faces))
    n_regions, *of = regions(uv_mesh, ring, parts)
    faces = assemble_faces(uv_mesh, ring, places, parts, filling, (of[0], of[1]))
    V, vertex_face, vertex_bary = place_vertices(uv_mesh, origin, ring, places, parts, filling)

    label, known, n_conflicts = label_regions(graph, face_segments, len(ring.next), parts, n_regions, of[1])
    sample = np.zeros(n_regions, np.int64)
    sample[faces.region[::-1]] = faces.face[::-1]
    for r in np.flatnonzero(~known).tolist():
        label[r] = label_at(graph, uv_mesh.U[uv_mesh.F_uv[sample[r], 0]])
    label_of_face = label[faces.region]

    vertex_of_place = np.full(len(graph.points), -1)
    vertex_of_place[hits.point[::-1]] = places.first_hit + np.arange(len(hits.point))[::-1]
    forth = len(ring.next) + np.arange(len(face_segments.face))
    return CutMesh(
        V=V,
        F=faces.F,
        parent=origin.face[faces.face],
        label=label_of_face,
        region=joined_over_seams(faces.F, label_of_face, faces.region),
        vertex_face=vertex_face,
        vertex_bary=vertex_bary,
        point_vertex=vertex_of_place[graph.point],
        cuts=np.stack([places.vertex[forth], places.vertex[forth + len(face_segments.face)]], 1),
        cut_segment=graph.source[face_segments.segment],
        cut_param=face_segments.param,
        facts={
            "crossings": len(crossings.side),
            "zero_predicates": crossings.n_zero,
            "ties": nodes.n_ties,
            "seam_merged": nodes.n_merged,
            "respaced": nodes.n_respaced,
            "split_faces": len(uv_mesh.F) - len(mesh.F),
            "untangled": filling.n_untangled,
            "steiner": len(filling.centre_part),
            "label_conflicts": n_conflicts,
            "largest_part": int(parts.size.max(initial=0)),
        },
    )


class Faces(NamedTuple):
    """The faces of the cut mesh: untouched ones first."""

    F: Ints  # (f, 3)
    face: Ints  # (f,), the face of the UV mesh that each was cut from
    region: Ints  # (f,)


def assemble_faces(
    uv_mesh: UvMesh, ring: Ring, places: Places, parts: Cycles, filling: Filling, regions: tuple[Ints, Ints]
) -> Faces:
    """Put untouched faces and the triangles in cut ones together.

    Parameters
    ----------
    regions : (of_face, of_part)
    """
    of_face, of_part = regions
    untouched = np.flatnonzero(ring.row < 0)
    n_placed = places.n_vertices
    vertex = np.append(places.vertex, n_placed + np.arange(len(filling.centre_part)))
    face_of_part = ring.faces[places.row[parts.members[parts.first]]]
    return Faces(
        np.concatenate([uv_mesh.F[untouched], vertex[filling.T]]),
        np.concatenate([untouched, face_of_part[filling.part]]),
        np.concatenate([of_face[untouched], of_part[filling.part]]),
    )


def place_vertices(
    uv_mesh: UvMesh, origin: Origin, ring: Ring, places: Places, parts: Cycles, filling: Filling
) -> tuple[Floats, Ints, Floats]:
    """Place all vertices of the cut mesh.

    Returns
    -------
    V : (n, 3) float64
    face : (n,) int64, a face of the mesh that each lies in
    bary : (n, 3) float64, where it lies in that face
    """
    n_old, n_placed = len(uv_mesh.V), places.n_vertices
    face = np.zeros(n_placed + len(filling.centre_part), np.int64)
    bary = np.zeros((len(face), 3))
    for k in range(3):
        face[uv_mesh.F[:, k]] = np.arange(len(uv_mesh.F))
    bary[:n_old] = uv_mesh.F[face[:n_old]] == np.arange(n_old)[:, None]
    new = np.flatnonzero(places.vertex >= n_old)
    face[places.vertex[new]] = ring.faces[places.row[new]]
    bary[places.vertex[new]] = places.bary[new]
    face[n_placed:] = ring.faces[places.row[parts.members[parts.first[filling.centre_part]]]]
    bary[n_placed:] = filling.centre_bary

    V = np.empty((len(face), 3))
    V[:n_old] = uv_mesh.V
    V[n_old:] = np.einsum("nk,nkd->nd", bary[n_old:], uv_mesh.V[uv_mesh.F[face[n_old:]]])
    face, bary = in_mesh(origin, face, bary)
    return V, face, bary
