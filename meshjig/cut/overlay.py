"""Cut a mesh along planar outlines, through its charts: the whole of it, step by step."""

import numpy as np

from meshjig.cut.assemble_mesh import assemble_faces, place_vertices
from meshjig.cut.cycles import cycles
from meshjig.cut.edge_nodes import edge_nodes
from meshjig.cut.inner_halfedges import make_ring, wire
from meshjig.cut.islands import without_islands
from meshjig.cut.places import corner_frames, half_edge_places, landing_weights
from meshjig.cut.region_labels import joined_over_seams, label_at, label_regions, regions
from meshjig.cut.snap import snap
from meshjig.cut.triangulate import fill
from meshjig.cut.uv_mesh import make_sheet
from meshjig.mesh.types import Atlas, CutMesh, Outlines

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
    sheet = make_sheet(mesh.V, mesh.F, U, atlas.F_uv, atlas.chart_of_face)
    sheet, origin, graph, (crossings, landings, links) = without_islands(sheet, graph)

    nodes = edge_nodes(sheet, graph, crossings)
    ring = make_ring(sheet, nodes, links.face)
    wiring = wire(sheet, graph, nodes, ring, links, (crossings, landings))
    parts = cycles(wiring.next)
    places = half_edge_places(
        sheet, ring, nodes, links, landing_weights(sheet, graph, landings), wiring.slot, wiring.leaving
    )
    places, filling = fill(places, parts, corner_frames(sheet, ring.faces))
    n_regions, *of = regions(sheet, ring, parts)
    faces = assemble_faces(sheet, ring, places, parts, filling, (of[0], of[1]))
    V, vertex_face, vertex_bary = place_vertices(sheet, origin, ring, places, parts, filling)

    label, known, n_conflicts = label_regions(graph, links, len(ring.next), parts, n_regions, of[1])
    sample = np.zeros(n_regions, np.int64)
    sample[faces.region[::-1]] = faces.face[::-1]
    for r in np.flatnonzero(~known).tolist():
        label[r] = label_at(graph, sheet.U[sheet.F_uv[sample[r], 0]])
    label_of_face = label[faces.region]

    vertex_of_place = np.full(len(graph.points), -1)
    vertex_of_place[landings.point[::-1]] = places.first_landing + np.arange(len(landings.point))[::-1]
    forth = len(ring.next) + np.arange(len(links.face))
    return CutMesh(
        V=V,
        F=faces.F,
        parent=origin.face[faces.face],
        label=label_of_face,
        region=joined_over_seams(faces.F, label_of_face, faces.region),
        vertex_face=vertex_face,
        vertex_bary=vertex_bary,
        point_vertex=vertex_of_place[graph.point],
        cuts=np.stack([places.vertex[forth], places.vertex[forth + len(links.face)]], 1),
        cut_segment=graph.source[links.segment],
        cut_param=links.param,
        facts={
            "crossings": len(crossings.side),
            "zero_predicates": crossings.n_zero,
            "ties": nodes.n_ties,
            "seam_merged": nodes.n_merged,
            "respaced": nodes.n_respaced,
            "split_faces": len(sheet.F) - len(mesh.F),
            "untangled": filling.n_untangled,
            "steiner": len(filling.centre_part),
            "label_conflicts": n_conflicts,
            "largest_part": int(parts.size.max(initial=0)),
        },
    )
