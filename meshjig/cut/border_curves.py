"""The borders between pieces on a cut mesh, as curves in the plane."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from meshjig.mesh.chains import chains
from meshjig.mesh.halfedges import edge_keys, edges, next_halfedge
from meshjig.mesh.measure import barycentric
from meshjig.mesh.types import Atlas, Bools, CutMesh, Floats, Ints, Outlines

__all__ = ["PlaneCurves", "SeamEdges", "along_seams", "cut_borders", "seam_borders"]

SAME_PLACE = 1e-3  # mm in the plane


@dataclass(frozen=True)
class PlaneCurves:
    """Stretches of borders that divide two pieces, in order along them."""

    start: Floats  # (k, 2), mm
    end: Floats  # (k, 2), mm
    parent: Ints  # (k,), the mesh's face that the stretch lies in
    follows: Bools  # (k,), the stretch starts where the one before it ends


@dataclass(frozen=True)
class SeamEdges:
    """Edges of the cut mesh on seams: one row for either side."""

    start: Floats  # (k, 2), mm, in the chart of this side
    end: Floats  # (k, 2), mm
    parent: Ints  # (k,), the mesh's face on this side
    vertices: Ints  # (k, 2), the cut mesh's vertices at start and end
    mate: Ints  # (k,), the row of the other side
    active: Bools  # (k,), the edge divides two pieces


def cut_borders(cut: CutMesh, outlines: Outlines, piece_of_face: Ints) -> PlaneCurves:
    """Give the stretches of cuts that have different pieces on their sides.

    Parameters
    ----------
    cut : CutMesh, made along the outlines
    outlines : Outlines
    piece_of_face : (m,) int64, for the cut mesh's faces
    """
    n = len(cut.V)
    e = edges(cut.F)
    h = np.flatnonzero(e.twin > np.arange(len(e.twin)))
    h = h[piece_of_face[h // 3] != piece_of_face[e.twin[h] // 3]]
    ends = e.E[e.edge_of_halfedge[h]]
    key, of_cut = edge_keys(ends, n), edge_keys(cut.cuts, n)
    order = np.argsort(key)
    at = np.searchsorted(key[order], of_cut)
    at = order[np.minimum(at, len(order) - 1)] if len(order) else np.zeros(len(of_cut), np.int64)
    active = key[at] == of_cut if len(order) else np.zeros(len(of_cut), bool)
    chosen = np.flatnonzero(active)
    segment, param = cut.cut_segment[chosen], cut.cut_param[chosen]
    in_order = np.lexsort((param[:, 0], segment))
    chosen, segment, param = chosen[in_order], segment[in_order], param[in_order]
    a, b = (outlines.points[outlines.segments[segment, k]] for k in (0, 1))
    start, end = a + (b - a) * param[:, :1], a + (b - a) * param[:, 1:]
    follows = np.zeros(len(chosen), bool)
    if len(chosen):
        follows[1:] = cut.cuts[chosen[1:], 0] == cut.cuts[chosen[:-1], 1]
        follows[1:] &= (np.abs(start[1:] - end[:-1]) < SAME_PLACE).all(1)  # not so over a seam
    return PlaneCurves(start, end, cut.parent[h[at[chosen]] // 3], follows)


def seam_borders(atlas: Atlas, cut: CutMesh, piece_of_face: Ints) -> SeamEdges:
    """Give the cut mesh's edges along the seams between charts, from both sides."""
    e = edges(cut.F)
    h = np.flatnonzero(e.twin > np.arange(len(e.twin)))
    parent = np.stack([cut.parent[h // 3], cut.parent[e.twin[h] // 3]], 1)
    different = parent[:, 0] != parent[:, 1]
    h, parent = h[different], parent[different]
    both = np.concatenate([h, e.twin[h]])
    start, end = cut.F.ravel()[both], cut.F.ravel()[next_halfedge(both)]
    face = np.concatenate([parent[:, 0], parent[:, 1]])
    k = len(h)
    candidates = np.flatnonzero(_on_seam(atlas, parent))
    rows = np.concatenate([candidates, candidates + k])
    start, end, face = start[rows], end[rows], face[rows]
    half = len(candidates)
    mate = np.concatenate([np.arange(half) + half, np.arange(half)])
    active = (piece_of_face[h // 3] != piece_of_face[e.twin[h] // 3])[candidates]
    uv_start, uv_end = (_place_in_chart(atlas, face, cut.V[v]) for v in (start, end))
    return SeamEdges(uv_start, uv_end, face, np.stack([start, end], 1), mate, np.tile(active, 2))


def along_seams(seams: SeamEdges) -> tuple[PlaneCurves, Ints]:
    """Put the seam edges that divide two pieces in order along the seams.

    Returns
    -------
    curves : PlaneCurves
    row : (k,) int64, the seam edge that each stretch is
    """
    rows = np.flatnonzero(seams.active)
    start = {(v, *uv): k for k, v, uv in _places(rows, seams.vertices[:, 0], seams.start)}
    ends = _places(rows, seams.vertices[:, 1], seams.end)
    order, first = chains(np.array([start.get((v, *uv), -1) for _, v, uv in ends], np.int64))
    follows = np.ones(len(order), bool)
    follows[first] = False
    chosen = rows[order]
    return PlaneCurves(seams.start[chosen], seams.end[chosen], seams.parent[chosen], follows), chosen


def _places(rows: Ints, vertex: Ints, uv: Floats) -> Iterator[tuple[int, int, tuple[int, int]]]:
    """Name the places of rows by vertex and rounded point: a vertex may lie in several charts."""
    cells = np.rint(uv[rows] / SAME_PLACE).astype(np.int64)
    return zip(range(len(rows)), vertex[rows].tolist(), map(tuple, cells.tolist()), strict=True)


def _on_seam(atlas: Atlas, parent: Ints) -> Bools:
    """Tell which pairs of neighbouring faces have their common edge at two places in the plane."""
    F, G = atlas.mesh.F[parent], atlas.F_uv[parent]
    same = F[:, 0, :, None] == F[:, 1, None, :]
    glued = G[:, 0, :, None] == G[:, 1, None, :]
    return (same & glued).sum((1, 2)) < 2


def _place_in_chart(atlas: Atlas, face: Ints, xyz: Floats) -> Floats:
    bary = np.clip(barycentric(atlas.mesh.V, atlas.mesh.F, face, xyz), 0, 1)
    bary /= bary.sum(1, keepdims=True)
    return np.einsum("kj,kjd->kd", bary, atlas.uv[atlas.F_uv[face]])
