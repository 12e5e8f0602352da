"""The edges between pieces, with the frame that walls are measured in."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.halfedges import edges, next_halfedge
from meshjig.mesh.measure import unit

__all__ = ["BorderEdges", "border_edges"]


class BorderEdges(NamedTuple):
    """Edges between two pieces; tangent, conormal and normal are at right angles."""

    tail: Ints  # (e,), vertices; the first piece is on the left on the way from tail to head
    head: Ints  # (e,)
    side: Ints  # (e, 2), the pieces left and right, lower first
    tangent: Floats  # (e, 3), unit
    conormal: Floats  # (e, 3), unit, out of the left piece
    normal: Floats  # (e, 3), unit, out of the surface
    length: Floats  # (e,), mm
    pairs: Ints  # (p, 2), neighbouring pieces, lower first
    pair: Ints  # (e,), the row of pairs
    knob: Bools  # (e,), part of a knob's curve

    @property
    def n_pieces(self) -> int:
        """How many pieces there may be: one more than the highest number."""
        return int(self.pairs.max(initial=-1)) + 1


def border_edges(V: Floats, F: Ints, piece: Ints, D: Floats, on_knob: Bools) -> BorderEdges:
    """Find the edges between pieces, half way between both sheets.

    Parameters
    ----------
    V : (n, 3) float64, mm, the outer sheet
    F : (m, 3) int64
    piece : (m,) int64; faces below 0 belong to none
    D : (n, 3) float64, mm, to the inner sheet
    on_knob : (n,) bool, vertices on the curves of knobs

    Returns
    -------
    BorderEdges
    """
    twin = edges(F).twin
    h = np.arange(len(twin))
    left, right = piece[h // 3], piece[twin // 3]
    h = h[(left < right) & (left >= 0)]
    tail, head = F.ravel()[h], F.ravel()[next_halfedge(h)]
    side = np.stack([piece[h // 3], piece[twin[h] // 3]], 1)
    middle = V + D / 2
    along = middle[head] - middle[tail]
    rough = -unit(unit(D[tail]) + unit(D[head]))
    tangent = unit(along)
    conormal = unit(np.cross(tangent, rough))
    pairs, row = np.unique(side, axis=0, return_inverse=True)
    return BorderEdges(
        tail,
        head,
        side,
        tangent,
        conormal,
        np.cross(conormal, tangent),
        np.linalg.norm(along, axis=1),
        pairs.reshape(-1, 2),
        row.ravel(),
        on_knob[tail] & on_knob[head],
    )
