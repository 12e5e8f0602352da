"""Borders that give up their knobs, and pieces that become one with a neighbour."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np

from meshjig.layout.layout import Layout
from meshjig.mesh.arrays import Bools, Ints
from meshjig.mesh.measure import face_areas

__all__ = ["joined", "numbered", "without_knobs"]


def without_knobs(layout: Layout, pairs: Iterable[tuple[int, int]]) -> tuple[Layout, int]:
    """Take the knobs and waves off the borders between some pieces: each keeps what lies in its own cell.

    Parameters
    ----------
    layout : Layout, of cells; others come back as they are
    pairs : of pieces

    Returns
    -------
    Layout
    count : int, borders that have changed
    """
    if layout.cells is None:
        return layout, 0
    piece, chart = layout.piece_of_face, layout.atlas.chart_of_face[layout.cut.parent]
    area = face_areas(layout.cut.V, layout.cut.F)
    n = layout.stitching.n_pieces
    key, at = np.unique(chart * n + piece, return_inverse=True)
    size = np.bincount(at, area)
    owner = np.zeros(int(chart.max(initial=-1)) + 1, np.int64)
    for k in np.argsort(size, kind="stable").tolist():  # the largest is the last
        owner[key[k] // n] = key[k] % n
    parts: list[tuple[Bools, int]] = []
    for p, q in pairs:
        for one, other in ((p, q), (q, p)):
            head = (piece == one) & (owner[chart] == other)
            if head.any():
                parts.append((head, other))
    return _relabelled(layout, parts), len(parts)


def joined(layout: Layout, pairs: Iterable[tuple[int, int]]) -> tuple[Layout, Ints]:
    """Make one piece of two, by the first one's number; numbers of the others close up.

    Parameters
    ----------
    layout : Layout
    pairs : of pieces

    Returns
    -------
    Layout
    number : (p,) int64, that every piece has now
    """
    to = np.arange(layout.stitching.n_pieces)
    for p, q in pairs:
        to[to == to[q]] = to[p]
    number = np.unique(to, return_inverse=True)[1]
    return numbered(layout, number), number


def numbered(layout: Layout, number: Ints) -> Layout:
    """Give pieces other numbers, (p,)."""
    return _with_pieces(layout, number[layout.stitching.piece_of_region])


def _with_pieces(layout: Layout, piece_of_region: Ints) -> Layout:
    return replace(layout, stitching=replace(layout.stitching, piece_of_region=piece_of_region))


def _relabelled(layout: Layout, parts: Sequence[tuple[Bools, int]]) -> Layout:
    """Make regions of their own of some faces, and give them to pieces."""
    region, pieces = layout.cut.region.copy(), layout.stitching.piece_of_region.tolist()
    for faces, piece in parts:
        region[faces] = len(pieces)
        pieces.append(piece)
    return _with_pieces(replace(layout, cut=replace(layout.cut, region=region)), np.array(pieces))
