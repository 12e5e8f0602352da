"""Where outlines cross the sides of faces, exactly."""

from typing import NamedTuple

import numpy as np

from meshjig.cut.broad_phase import Boxes, Cells, box_pairs, boxes, near
from meshjig.cut.predicates import orient, point_left_of_edge, vertex_left_of_segment
from meshjig.cut.snap import Graph
from meshjig.cut.uv_mesh import Sheet
from meshjig.mesh.types import Bools, Floats, Ints

__all__ = ["Crossings", "cross"]


class Crossings(NamedTuple):
    """Segments through sides of the mesh, one row a crossing."""

    side: Ints  # (x,)
    segment: Ints  # (x,)
    along_side: Floats  # (x,), 0 to 1 from the side's first end
    along_segment: Floats  # (x,), 0 to 1
    first_left: Bools  # (x,), whether the side's first end is left of the segment; the other is not
    turns: Ints  # (x, 2), orient(segment, end of the side): along_side, exactly
    n_zero: int  # answers that the symbolic shift gave


def cross(sheet: Sheet, graph: Graph, cells: Cells, around: Boxes) -> Crossings:
    """Find all crossings of segments with sides of the mesh.

    Parameters
    ----------
    sheet : Sheet
    graph : Graph
    cells, around : what make_cells gave for the graph's segments
    """
    a, b = graph.points[graph.segments[:, 0]], graph.points[graph.segments[:, 1]]
    bounds = boxes(cells.size, sheet.U)
    first, second = sheet.S[:, 0], sheet.S[:, 1]
    sides = Boxes(
        np.minimum(bounds.low[first], bounds.low[second]), np.maximum(bounds.low[first], bounds.low[second])
    )
    close = np.flatnonzero(near(cells, sides))
    side, segment = box_pairs(sides.take(close), around)
    side = close[side]

    p, q, A, B = sheet.U[first[side]], sheet.U[second[side]], a[segment], b[segment]
    turn_a, turn_b = orient(p, q, A), orient(p, q, B)
    hit = np.flatnonzero(point_left_of_edge(turn_a, p, q) != point_left_of_edge(turn_b, p, q))
    side, segment, p, q, A, B, turn_a, turn_b = (x[hit] for x in (side, segment, p, q, A, B, turn_a, turn_b))
    turn_p, turn_q = orient(A, B, p), orient(A, B, q)
    p_left = vertex_left_of_segment(turn_p, A, B)
    hit = np.flatnonzero(p_left != vertex_left_of_segment(turn_q, A, B))
    turns = np.stack([turn_p[hit], turn_q[hit]], 1)
    return Crossings(
        side[hit],
        segment[hit],
        _share(turn_p[hit], turn_q[hit]),
        _share(turn_a[hit], turn_b[hit]),
        p_left[hit],
        turns,
        int((turns == 0).sum()),
    )


def _share(first: Ints, second: Ints) -> Floats:
    """Give how far from first to second a value that goes from one to minus the other is zero."""
    total = np.abs(first) + np.abs(second)
    return np.where(total > 0, np.abs(first) / np.maximum(total, 1), 0.5)
