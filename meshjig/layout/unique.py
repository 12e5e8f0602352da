"""Whether every piece has one place only, and which knobs to draw anew where that is not so."""

from __future__ import annotations

from typing import Any

import numpy as np

from meshjig.cut import merge_periodic
from meshjig.layout.congruent import Border, borders, congruent_borders, interchangeable
from meshjig.layout.layout import Layout
from meshjig.mesh.halfedges import edge_keys, next_halfedge
from meshjig.mesh.types import CutMesh, Ints, Knobs

__all__ = ["LEAST_DIFFERENCE", "clashes"]

LEAST_DIFFERENCE = 0.1  # mm by which borders must differ where no clearance is asked for


def clashes(layout: Layout, tolerance: float) -> tuple[Ints, dict[str, Any]]:
    """Find borders that look alike.

    Parameters
    ----------
    layout : Layout
    tolerance : float, mm

    Returns
    -------
    edges : (k,) int64, as Knobs.edge counts them: drawn anew, their borders would be unlike the rest
    facts : {"congruent_borders": pairs, "interchangeable_pieces": pairs}
    """
    cut = merge_periodic(layout.cut, layout.outlines)
    rims = borders(cut, layout.piece_of_face)
    alike = congruent_borders(cut, rims, tolerance)
    swaps = interchangeable(cut, rims, tolerance)
    facts = {"congruent_borders": len(alike), "interchangeable_pieces": len(swaps)}
    found = _edges_on([b for _, b in alike], cut, layout.knobs)
    return found, facts


def _edges_on(of: list[Border], cut: CutMesh, knobs: Knobs) -> Ints:
    """List the edges of the tiling whose knobs lie on some borders."""
    if not of or knobs.edge is None or not len(knobs.edge):
        return np.zeros(0, np.int64)
    n, corner = len(cut.V), cut.F.ravel()
    h = np.concatenate([border.halfedges for border in of])
    on_border = np.isin(
        edge_keys(cut.cuts, n), edge_keys(np.stack([corner[h], corner[next_halfedge(h)]], 1), n)
    )
    segment = np.zeros(max(int(cut.cut_segment.max(initial=0)), int(knobs.span.max())) + 2, np.int64)
    segment[cut.cut_segment[on_border]] = 1
    before = np.concatenate([[0], np.cumsum(segment)])
    found = np.unique(knobs.edge[before[knobs.span[:, 1]] > before[knobs.span[:, 0]]])
    return found[found >= 0]
