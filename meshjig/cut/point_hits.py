"""Which faces contain the points of outlines, exactly."""

from typing import NamedTuple

import numpy as np

from meshjig.cut.broad_phase import Boxes, Cells, box_pairs, boxes, near
from meshjig.cut.predicates import orient, point_left_of_edge
from meshjig.cut.snap import Graph
from meshjig.cut.uv_mesh import Sheet
from meshjig.mesh.types import Ints

__all__ = ["Landings", "locate"]


class Landings(NamedTuple):
    """Outline points inside faces. Where the plane image overlaps itself, a point lands repeatedly."""

    point: Ints  # (l,)
    face: Ints  # (l,)


def locate(sheet: Sheet, graph: Graph, cells: Cells) -> Landings:
    """Find the faces that contain the shifted outline points which have segments."""
    used = np.zeros(len(graph.points), bool)
    used[graph.segments.ravel()] = True
    used_points = np.flatnonzero(used)
    corner = boxes(cells.size, sheet.U).low
    a, b, c = (corner[sheet.F_uv[:, k]] for k in range(3))
    faces = Boxes(np.minimum(np.minimum(a, b), c), np.maximum(np.maximum(a, b), c))
    close = np.flatnonzero(near(cells, faces))
    point, face = box_pairs(boxes(cells.size, graph.points[used_points]), faces.take(close))
    point, face = used_points[point], close[face]
    left = None
    for k in range(3):
        tail, head = sheet.F_uv[face, k], sheet.F_uv[face, (k + 1) % 3]
        runs_up = tail < head
        # asked along the side's own direction, so that both its faces get the same answer
        p, q = sheet.U[np.where(runs_up, tail, head)], sheet.U[np.where(runs_up, head, tail)]
        answer = point_left_of_edge(orient(p, q, graph.points[point]), p, q) == runs_up
        if left is None:
            left = answer
            continue
        agree = np.flatnonzero(left == answer)
        point, face, left = point[agree], face[agree], left[agree]
    order = np.lexsort((face, point))
    return Landings(point[order], face[order])
