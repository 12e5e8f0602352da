"""Seams evened out: where pieces meet along the mesh edges of a seam, a smooth line takes their place."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from meshjig.cells.discs import DISC, shapes
from meshjig.cells.even_borders import Evened, Line, even_borders
from meshjig.layout.congruent import borders
from meshjig.layout.layout import Layout, cut_again
from meshjig.mesh.arrays import Bools, Ints
from meshjig.mesh.halfedges import Edges, compact, edge_keys, next_halfedge
from meshjig.mesh.types import CutMesh, Mesh

__all__ = ["smooth_seams"]

TRIES = 3
SHORTEST = 4  # edges: there is nothing to even out in less


def smooth_seams(layout: Layout) -> tuple[Layout, Bools]:
    """Draw the borders of pieces along seams again, smoothly; a border that would break a piece stays.

    Parameters
    ----------
    layout : Layout, made of tiles

    Returns
    -------
    layout : Layout, of the same pieces
    discs : (p,) bool, which pieces are discs
    """
    cut, n = layout.cut, layout.stitching.n_pieces
    discs = shapes(cut.mesh, layout.piece_of_face, n) == DISC
    lines = [line for line in _seam_lines(layout) if discs[line.left] and discs[line.right]]
    for _ in range(TRIES):
        if not lines:
            break
        wanted = np.unique([(line.left, line.right) for line in lines])
        chosen = np.flatnonzero(np.isin(layout.piece_of_face, wanted))
        made = _evened(layout, chosen, lines)
        good = shapes(made.mesh, made.cell, n) == DISC
        if good[wanted].all():
            return _taken_in(layout, chosen, made), discs
        lines = [line for line in lines if good[line.left] and good[line.right]]
    return layout, discs


def _seam_lines(layout: Layout) -> list[Line]:
    """List the stretches along which two pieces meet on a seam."""
    cut, corner = layout.cut, layout.cut.F.ravel()
    of_piece = borders(cut, layout.piece_of_face)
    once = [border for found in of_piece for border in found if border.piece < border.neighbour]
    vertices = [
        np.append(corner[border.halfedges], corner[next_halfedge(border.halfedges[-1:])]) for border in once
    ]
    ends = np.concatenate([np.zeros((0, 2), np.int64), *(np.stack([v[:-1], v[1:]], 1) for v in vertices)])
    on_seam = ~np.isin(edge_keys(ends, len(cut.V)), edge_keys(cut.cuts, len(cut.V)))
    lines = []
    at = 0
    for border, vertex in zip(once, vertices, strict=True):
        seam = on_seam[at : at + len(vertex) - 1]
        at += len(seam)
        change = np.flatnonzero(np.diff(seam)) + 1
        for begin, end in pairwise([0, *change.tolist(), len(seam)]):
            run = vertex[begin : end + 1]
            if seam[begin] and end - begin >= SHORTEST and run[0] != run[-1]:
                lines.append(Line(run, border.piece, border.neighbour))
    return lines


def _evened(layout: Layout, chosen: Ints, lines: list[Line]) -> Evened:
    """Even out lines in some faces of the cut mesh."""
    cut = layout.cut
    F, kept = compact(cut.F[chosen])
    number = np.full(len(cut.V), -1)
    number[kept] = np.arange(len(kept))
    moved = [line._replace(vertex=number[line.vertex]) for line in lines]
    return even_borders(Mesh(cut.V[kept], F), layout.piece_of_face[chosen], moved)


def _taken_in(layout: Layout, chosen: Ints, made: Evened) -> Layout:
    """Put evened faces in the place of those that they were made from."""
    kept = compact(layout.cut.F[chosen])[1]
    cuts = _new_borders(layout.piece_of_face[chosen], made)
    second = CutMesh(
        mesh=made.mesh,
        of=made.of,
        parent=made.parent,
        label=made.cell,
        region=made.cell,
        vertex_face=made.vertex_face,
        vertex_bary=made.vertex_bary,
        point_vertex=np.zeros(0, np.int64),
        cuts=cuts,
        cut_segment=np.arange(len(cuts)),
        cut_param=np.tile([0.0, 1.0], (len(cuts), 1)),
    )
    return cut_again(layout, chosen, kept, second, np.arange(layout.stitching.n_pieces))[0]


def _new_borders(cell: Ints, made: Evened) -> Ints:
    """List the edges (c, 2) between two cells that were no such edges before, a cell on their left."""
    n = len(made.V)
    ends = _between(made.F, made.cell, made.mesh.edges)
    return ends[~np.isin(edge_keys(ends, n), edge_keys(_between(made.of.F, cell, made.of.edges), n))]


def _between(F: Ints, cell: Ints, e: Edges) -> Ints:
    """List the edges (c, 2) between two cells, a cell on their left."""
    h = np.flatnonzero(e.twin > np.arange(len(e.twin)))
    h = h[cell[h // 3] != cell[e.twin[h] // 3]]
    corner = F.ravel()
    return np.stack([corner[h], corner[next_halfedge(h)]], 1)
