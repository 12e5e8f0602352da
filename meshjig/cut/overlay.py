"""Cut a mesh along planar outlines, through its charts: the whole of it, step by step."""

from typing import NamedTuple

import numpy as np

from meshjig.cut.edge_nodes import edge_nodes
from meshjig.cut.inner_halfedges import Ring, make_ring, wire
from meshjig.cut.islands import Origin, in_mesh, without_islands
from meshjig.cut.places import Places, corner_frames, half_edge_places, hit_weights
from meshjig.cut.region_labels import Regions, joined_over_seams, label_at, label_regions, regions
from meshjig.cut.snap import snap
from meshjig.cut.triangulate import Filling, fill
from meshjig.cut.uv_mesh import UvMesh, make_uv_mesh
from meshjig.mesh.chains import Cycles, cycles
from meshjig.mesh.refinement import at_corners
from meshjig.mesh.types import Atlas, CutFacts, CutMesh, Floats, Ints, Mesh, Outlines

__all__ = ["overlay"]


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
    uv_mesh, origin, graph, seen = without_islands(uv_mesh, graph)
    crossings, hits, inside = seen

    nodes = edge_nodes(uv_mesh, graph, crossings)
    ring = make_ring(uv_mesh, nodes, inside.face)
    wiring = wire(uv_mesh, graph, nodes, ring, seen)
    parts = cycles(wiring.next)
    places = half_edge_places(uv_mesh, ring, nodes, inside, hit_weights(uv_mesh, graph, hits), wiring)
    places, filling = fill(places, parts, corner_frames(uv_mesh, ring.faces))
    of = regions(uv_mesh, ring, parts)
    faces = _faces(uv_mesh, ring, places, parts, filling, of)
    V, vertex_face, vertex_bary = _vertices(uv_mesh, origin, ring, places, parts, filling)

    label, known, n_conflicts = label_regions(graph, inside, len(ring.next), parts, of)
    sample = np.zeros(of.n, np.int64)
    sample[faces.region[::-1]] = faces.face[::-1]
    for r in np.flatnonzero(~known).tolist():
        label[r] = label_at(graph, uv_mesh.U[uv_mesh.F_uv[sample[r], 0]])
    label_of_face = label[faces.region]

    vertex_of_place = np.full(len(graph.points), -1)
    vertex_of_place[hits.point[::-1]] = places.first_hit + np.arange(len(hits.point))[::-1]
    forth = len(ring.next) + np.arange(len(inside.face))
    return CutMesh(
        mesh=Mesh(V, faces.F),
        of=mesh,
        parent=origin.face[faces.face],
        label=label_of_face,
        region=joined_over_seams(faces.F, label_of_face, faces.region),
        vertex_face=vertex_face,
        vertex_bary=vertex_bary,
        point_vertex=vertex_of_place[graph.point],
        cuts=np.stack([places.vertex[forth], places.vertex[forth + len(inside.face)]], 1),
        cut_segment=graph.source[inside.segment],
        cut_param=inside.param,
        facts=CutFacts(
            crossings=len(crossings.side),
            zero_predicates=crossings.n_zero,
            ties=nodes.n_ties,
            seam_merged=nodes.n_merged,
            respaced=nodes.n_respaced,
            split_faces=len(uv_mesh.F) - len(mesh.F),
            untangled=filling.n_untangled,
            steiner=len(filling.centre_part),
            label_conflicts=n_conflicts,
            largest_part=int(parts.size.max(initial=0)),
        ),
    )


class _Faces(NamedTuple):
    """The faces of the cut mesh: untouched ones first."""

    F: Ints  # (f, 3)
    face: Ints  # (f,), the face of the UV mesh that each was cut from
    region: Ints  # (f,)


def _faces(
    uv_mesh: UvMesh, ring: Ring, places: Places, parts: Cycles, filling: Filling, of: Regions
) -> _Faces:
    """Put untouched faces and the triangles in cut ones together."""
    untouched = np.flatnonzero(ring.row < 0)
    n_placed = places.n_vertices
    vertex = np.append(places.vertex, n_placed + np.arange(len(filling.centre_part)))
    face_of_part = ring.faces[places.row[parts.members[parts.first]]]
    return _Faces(
        np.concatenate([uv_mesh.F[untouched], vertex[filling.T]]),
        np.concatenate([untouched, face_of_part[filling.part]]),
        np.concatenate([of.face[untouched], of.part[filling.part]]),
    )


def _vertices(
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
    face[:n_old], bary[:n_old] = at_corners(Mesh(uv_mesh.V, uv_mesh.F))
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
