"""Everything that outlines do to a UV mesh: cross its sides, lie in its faces, run through them."""

from typing import NamedTuple

import numpy as np

from meshjig.cut.broad_phase import Boxes, Cells, box_pairs, boxes, make_cells, near
from meshjig.cut.predicates import orient, point_left_of_edge, vertex_left_of_segment
from meshjig.cut.snap import Graph
from meshjig.cut.uv_mesh import UvMesh, corner_of_side, forward
from meshjig.errors import CutError
from meshjig.mesh.arrays import ragged, row_of, starts
from meshjig.mesh.types import Bools, Floats, Ints

__all__ = ["Crossings", "FaceSegments", "PointHits", "Trace", "trace"]


class Crossings(NamedTuple):
    """Segments through sides of the mesh, one row a crossing."""

    side: Ints  # (x,)
    segment: Ints  # (x,)
    along_side: Floats  # (x,), 0 to 1 from the side's first end
    along_segment: Floats  # (x,), 0 to 1
    first_left: Bools  # (x,), whether the side's first end is left of the segment; the other is not
    turns: Ints  # (x, 2), orient(segment, end of the side): along_side, exactly
    n_zero: int  # answers that the symbolic shift gave


class PointHits(NamedTuple):
    """Outline points inside faces. Where the plane image overlaps itself, a point lands repeatedly."""

    point: Ints  # (l,)
    face: Ints  # (l,)


class FaceSegments(NamedTuple):
    """Pieces of segments inside faces, in the direction of their segment.

    Stops are numbered crossings first, then hits.
    """

    start: Ints  # (l,), the stop that a piece starts from
    end: Ints  # (l,), the stop it ends at
    face: Ints  # (l,)
    segment: Ints  # (l,)
    param: Floats  # (l, 2), start and end on the segment of the outlines, 0 to 1
    mirrored: Bools  # (l,), whether the face lies face down in the plane


class Trace(NamedTuple):
    """The stops of outlines on a UV mesh, and the segments between them."""

    crossings: Crossings
    hits: PointHits
    face_segments: FaceSegments


def trace(uv_mesh: UvMesh, graph: Graph) -> Trace:
    """Follow outlines over a UV mesh.

    Raises
    ------
    CutError
        An outline ends inside the mesh.
    """
    a, b = graph.points[graph.segments[:, 0]], graph.points[graph.segments[:, 1]]
    cells, around = make_cells(uv_mesh.U, uv_mesh.S, a, b)
    crossings = _cross(uv_mesh, graph, cells, around)
    hits = _locate(uv_mesh, graph, cells)
    return Trace(crossings, hits, _follow(uv_mesh, graph, crossings, hits))


def _cross(uv_mesh: UvMesh, graph: Graph, cells: Cells, around: Boxes) -> Crossings:
    """Find all crossings of segments with sides of the mesh.

    Parameters
    ----------
    uv_mesh : UvMesh
    graph : Graph
    cells, around : what make_cells gave for the graph's segments
    """
    a, b = graph.points[graph.segments[:, 0]], graph.points[graph.segments[:, 1]]
    bounds = boxes(cells.size, uv_mesh.U)
    first, second = uv_mesh.S[:, 0], uv_mesh.S[:, 1]
    sides = Boxes(
        np.minimum(bounds.low[first], bounds.low[second]), np.maximum(bounds.low[first], bounds.low[second])
    )
    close = np.flatnonzero(near(cells, sides))
    side, segment = box_pairs(sides.take(close), around)
    side = close[side]

    p, q, A, B = uv_mesh.U[first[side]], uv_mesh.U[second[side]], a[segment], b[segment]
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


def _locate(uv_mesh: UvMesh, graph: Graph, cells: Cells) -> PointHits:
    """Find the faces that contain the shifted outline points which have segments."""
    used = np.zeros(len(graph.points), bool)
    used[graph.segments.ravel()] = True
    used_points = np.flatnonzero(used)
    corner = boxes(cells.size, uv_mesh.U).low
    a, b, c = (corner[uv_mesh.F_uv[:, k]] for k in range(3))
    faces = Boxes(np.minimum(np.minimum(a, b), c), np.maximum(np.maximum(a, b), c))
    close = np.flatnonzero(near(cells, faces))
    point, face = box_pairs(boxes(cells.size, graph.points[used_points]), faces.take(close))
    point, face = used_points[point], close[face]
    left = None
    for k in range(3):
        tail, head = uv_mesh.F_uv[face, k], uv_mesh.F_uv[face, (k + 1) % 3]
        runs_up = tail < head
        # asked along the side's own direction, so that both its faces get the same answer
        p, q = uv_mesh.U[np.where(runs_up, tail, head)], uv_mesh.U[np.where(runs_up, head, tail)]
        answer = point_left_of_edge(orient(p, q, graph.points[point]), p, q) == runs_up
        if left is None:
            left = answer
            continue
        agree = np.flatnonzero(left == answer)
        point, face, left = point[agree], face[agree], left[agree]
    order = np.lexsort((face, point))
    return PointHits(point[order], face[order])


def _follow(uv_mesh: UvMesh, graph: Graph, crossings: Crossings, hits: PointHits) -> FaceSegments:
    """Pair what happens to a segment in a face: it comes in or starts there, leaves or ends there.

    A face is convex, so that each segment does two of these things in it, or nothing.

    Raises
    ------
    CutError
        An outline ends inside the mesh.
    """
    nx = len(crossings.side)
    one, other = uv_mesh.faces[crossings.side, 0], uv_mesh.faces[crossings.side, 1]
    both = np.flatnonzero(other >= 0)
    at, incident = _incidences(graph, hits)
    stop = np.concatenate([np.arange(nx), both, nx + at])
    face = np.concatenate([one, other[both], hits.face[at]])
    segment = np.concatenate([crossings.segment, crossings.segment[both], incident])
    key = face * np.int64(len(graph.segments)) + segment
    order = np.argsort(key, kind="stable")
    key, stop, face, segment = (x[order] for x in (key, stop, face, segment))
    if len(key) % 2 or (key[::2] != key[1::2]).any():
        raise CutError("the outlines can't be followed over the mesh", hint="flatten it again")
    first, second, face, segment = stop[::2], stop[1::2], face[::2], segment[::2]

    u, v, w = (uv_mesh.U[uv_mesh.F_uv[face, k]] for k in range(3))
    mirrored = orient(u, v, w) < 0
    either_way = FaceSegments(first, second, face, segment, np.zeros((0, 2)), mirrored)
    swap = _starts(uv_mesh, graph, Trace(crossings, hits, either_way))
    start, end = np.where(swap, second, first), np.where(swap, first, second)
    at_hit = np.zeros(len(hits.point))
    param = np.stack(
        [
            np.concatenate([crossings.along_segment, at_hit])[start],
            np.concatenate([crossings.along_segment, at_hit + 1])[end],
        ],
        1,
    )
    whole = graph.span[segment]
    param = whole[:, :1] + param * (whole[:, 1:] - whole[:, :1])
    return FaceSegments(start, end, face, segment, param, mirrored)


def _incidences(graph: Graph, hits: PointHits) -> tuple[Ints, Ints]:
    """List (hit, segment) for all segments at all points that hit a face."""
    ends = graph.segments.ravel()
    order = np.argsort(ends, kind="stable")
    degree = np.bincount(ends, minlength=len(graph.points))
    count = degree[hits.point]
    if (count == 1).any():
        raise CutError("an outline ends inside the mesh", hint="close it, or let it end on another outline")
    return row_of(count), order[ragged(starts(degree)[hits.point], count)] // 2


def _starts(uv_mesh: UvMesh, graph: Graph, seen: Trace) -> Bools:
    """Tell whether segments enter their face at the second of their stops, or start there.

    A segment comes in over a half-edge whose tail it has on the left, or on the right where the
    face is mirrored. A face without area in the plane is read as if it were not mirrored: of its
    two crossed half-edges, one answers yes.
    """
    crossings, hits, inside = seen
    nx = len(crossings.side)
    enters = np.empty(len(inside.end), bool)
    at_hit = inside.end >= nx
    point = hits.point[inside.end[at_hit] - nx]
    enters[at_hit] = graph.segments[inside.segment[at_hit], 0] == point
    x, f = inside.end[~at_hit], inside.face[~at_hit]
    h = 3 * f + corner_of_side(uv_mesh, f, crossings.side[x])
    tail_left = crossings.first_left[x] == forward(uv_mesh.F_uv)[h]
    enters[~at_hit] = tail_left != inside.mirrored[~at_hit]
    return enters
