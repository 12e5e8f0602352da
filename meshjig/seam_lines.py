"""Seams evened out: where pieces meet along the mesh edges of a seam, a smooth line takes their place."""

from __future__ import annotations

import numpy as np

from meshjig.cells.discs import DISC, shapes
from meshjig.cells.even_borders import Evened, Line, even_borders
from meshjig.check.congruent import borders
from meshjig.layout import Layout
from meshjig.recut import recut
from meshjig.topology import compact, edge_keys, edges, next_halfedge
from meshjig.types import CutMesh, Ints

__all__ = ["even_seams"]

TRIES = 3
SHORTEST = 4  # edges: there is nothing to even out in less


def even_seams(layout: Layout) -> Layout:
    """Draw the borders of pieces along seams anew, smoothly; a border that would break a piece stays.

    Parameters
    ----------
    layout : Layout, made of tiles

    Returns
    -------
    Layout, of the same pieces
    """
    n = layout.stitching.n_pieces
    before = shapes(layout.cut.F, layout.piece_of_face, n, edges(layout.cut.F)) == DISC
    lines = [line for line in _seam_lines(layout) if before[line.left] and before[line.right]]
    for _ in range(TRIES):
        if not lines:
            break
        made = _evened(layout, lines)
        good = shapes(made.cut.F, made.piece_of_face, n, edges(made.cut.F)) == DISC
        if (good | ~before).all():
            return made
        lines = [line for line in lines if good[line.left] and good[line.right]]
    return layout


def _seam_lines(layout: Layout) -> list[Line]:
    """List the stretches along which two pieces meet on a seam."""
    cut = layout.cut
    corner = cut.F.ravel()
    ends = np.stack([corner, corner[next_halfedge(np.arange(len(corner)))]], 1)
    on_seam = ~np.isin(edge_keys(ends, len(cut.V)), edge_keys(cut.cuts, len(cut.V)))
    lines = []
    for of_piece in borders(cut, layout.piece_of_face):
        for border in of_piece:
            if border.piece >= border.neighbour:
                continue
            h = border.halfedges
            for run in np.split(h, np.flatnonzero(np.diff(on_seam[h])) + 1):
                vertex = np.append(ends[run, 0], ends[run[-1], 1])
                if on_seam[run[0]] and len(run) >= SHORTEST and vertex[0] != vertex[-1]:
                    lines.append(Line(vertex, border.piece, border.neighbour))
    return lines


def _evened(layout: Layout, lines: list[Line]) -> Layout:
    cut, piece = layout.cut, layout.piece_of_face
    wanted = np.zeros(layout.stitching.n_pieces, bool)
    wanted[[p for line in lines for p in (line.left, line.right)]] = True
    chosen = np.flatnonzero(wanted[piece])
    F, kept = compact(cut.F[chosen])
    number = np.full(len(cut.V), -1)
    number[kept] = np.arange(len(kept))
    made = even_borders(
        cut.V[kept], F, piece[chosen], [line._replace(vertex=number[line.vertex]) for line in lines]
    )
    cuts = _new_borders(F, piece[chosen], made)
    second = CutMesh(
        V=made.V,
        F=made.F,
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
    return recut(layout, chosen, kept, second, np.arange(layout.stitching.n_pieces))[0]


def _new_borders(F: Ints, cell: Ints, made: Evened) -> Ints:
    """List the edges (c, 2) between two cells that were no such edges before, a cell on their left."""
    n = len(made.V)
    ends = _between(made.F, made.cell)
    return ends[~np.isin(edge_keys(ends, n), edge_keys(_between(F, cell), n))]


def _between(F: Ints, cell: Ints) -> Ints:
    """List the edges (c, 2) between two cells, a cell on their left."""
    twin = edges(F).twin
    h = np.flatnonzero(twin > np.arange(len(twin)))
    h = h[cell[h // 3] != cell[twin[h] // 3]]
    corner = F.ravel()
    return np.stack([corner[h], corner[next_halfedge(h)]], 1)
