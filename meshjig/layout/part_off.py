"""Parts of pieces that came off when these were made solid: they join a neighbour, or become pieces."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from meshjig.layout.layout import Layout
from meshjig.mesh.arrays import Bools, Ints
from meshjig.mesh.halfedges import edges, next_halfedge
from meshjig.mesh.measure import edge_lengths, face_areas

__all__ = ["part_off"]


def part_off(layout: Layout, parts: Sequence[Bools], smallest: float) -> Layout:
    """Take parts out of their pieces.

    Parameters
    ----------
    layout : Layout
    parts : list of (m,) bool, faces of the cut mesh, of one piece each
    smallest : float, of the mean area of pieces; a smaller part joins the neighbour with the longest border

    Returns
    -------
    Layout
    """
    cut, stitching = layout.cut, layout.stitching
    area = face_areas(cut.V, cut.F)
    least = smallest * float(area.sum()) / max(stitching.n_pieces, 1)
    region, pieces = cut.region.copy(), list(stitching.piece_of_region)
    handed = parted = 0
    for part in parts:
        piece = np.array(pieces)[region]
        neighbour = _longest_border(layout, piece, part)
        alone = neighbour < 0 or float(area[part].sum()) >= least
        region[part] = len(pieces)
        pieces.append(max(pieces) + 1 if alone else neighbour)
        parted, handed = parted + alone, handed + (not alone)
    facts = replace(
        stitching.facts,
        handed_over=(stitching.facts.handed_over or 0) + handed,
        parted=(stitching.facts.parted or 0) + parted,
    )
    stitching = replace(stitching, piece_of_region=np.array(pieces), facts=facts)
    return replace(layout, cut=replace(cut, region=region), stitching=stitching)


def _longest_border(layout: Layout, piece: Ints, part: Bools) -> int:
    """Give the piece that shares most of a part's border, other than its own; -1 for none."""
    F = layout.cut.F
    twin = edges(F).twin
    h = np.flatnonzero(np.repeat(part, 3) & ~part[twin // 3])
    other = piece[twin[h] // 3]
    kept = (other != piece[h // 3]) & (other >= 0)
    if not kept.any():
        return -1
    h, other = h[kept], other[kept]
    ends = np.stack([F.ravel()[h], F.ravel()[next_halfedge(h)]], 1)
    return int(np.bincount(other, edge_lengths(layout.cut.V, ends)).argmax())
