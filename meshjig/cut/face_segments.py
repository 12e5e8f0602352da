"""Follow the outlines through faces: a link is a piece of one segment inside one face."""

from typing import NamedTuple

import numpy as np

from meshjig.cut.edge_crossings import Crossings
from meshjig.cut.point_hits import Landings
from meshjig.cut.predicates import orient
from meshjig.cut.snap import Graph
from meshjig.cut.uv_mesh import Sheet, forward
from meshjig.errors import CutError
from meshjig.mesh.types import Bools, Floats, Ints

__all__ = ["Links", "corner_of_side", "follow"]


class Links(NamedTuple):
    """Pieces of segments inside faces, in the direction of their segment.

    Stops are numbered crossings first, then landings.
    """

    start: Ints  # (l,), the stop a link starts from
    end: Ints  # (l,), the stop it ends at
    face: Ints  # (l,)
    segment: Ints  # (l,)
    param: Floats  # (l, 2), start and end on the segment of the outlines, 0 to 1
    mirrored: Bools  # (l,), whether the face lies face down in the plane


def follow(sheet: Sheet, graph: Graph, crossings: Crossings, landings: Landings) -> Links:
    """Pair what happens to a segment in a face: it comes in or starts there, leaves or ends there.

    A face is convex, so that each segment does two of these things in it, or nothing.

    Raises
    ------
    CutError
        An outline ends inside the mesh.
    """
    nx = len(crossings.side)
    one, other = sheet.faces[crossings.side, 0], sheet.faces[crossings.side, 1]
    both = np.flatnonzero(other >= 0)
    at, incident = _incidences(graph, landings)
    stop = np.concatenate([np.arange(nx), both, nx + at])
    face = np.concatenate([one, other[both], landings.face[at]])
    segment = np.concatenate([crossings.segment, crossings.segment[both], incident])
    key = face * np.int64(len(graph.segments)) + segment
    order = np.argsort(key, kind="stable")
    key, stop, face, segment = (x[order] for x in (key, stop, face, segment))
    if len(key) % 2 or (key[::2] != key[1::2]).any():
        raise CutError("the outlines can't be followed over the mesh", hint="flatten it anew")
    first, second, face, segment = stop[::2], stop[1::2], face[::2], segment[::2]

    u, v, w = (sheet.U[sheet.F_uv[face, k]] for k in range(3))
    mirrored = orient(u, v, w) < 0
    swap = _starts(sheet, graph, crossings, landings, second, face, segment, mirrored)
    start, end = np.where(swap, second, first), np.where(swap, first, second)
    landed = np.zeros(len(landings.point))
    param = np.stack(
        [
            np.concatenate([crossings.along_segment, landed])[start],
            np.concatenate([crossings.along_segment, landed + 1])[end],
        ],
        1,
    )
    whole = graph.span[segment]
    param = whole[:, :1] + param * (whole[:, 1:] - whole[:, :1])
    return Links(start, end, face, segment, param, mirrored)


def corner_of_side(sheet: Sheet, face: Ints, side: Ints) -> Ints:
    """Give the corner of each face at which its half-edge along a side starts."""
    sides = sheet.side.reshape(-1, 3)
    return np.where(sides[face, 0] == side, 0, np.where(sides[face, 1] == side, 1, 2))


def _incidences(graph: Graph, landings: Landings) -> tuple[Ints, Ints]:
    """List (landing, segment) for all segments at all landed points."""
    ends = graph.segments.ravel()
    order = np.argsort(ends, kind="stable")
    degree = np.bincount(ends, minlength=len(graph.points))
    first = np.cumsum(degree) - degree
    count = degree[landings.point]
    if (count == 1).any():
        raise CutError("an outline ends inside the mesh", hint="close it, or let it end on another outline")
    at = np.repeat(np.arange(len(count)), count)
    k = np.arange(len(at)) - np.repeat(np.cumsum(count) - count, count)
    return at, order[first[landings.point[at]] + k] // 2


def _starts(
    sheet: Sheet,
    graph: Graph,
    crossings: Crossings,
    landings: Landings,
    stop: Ints,
    face: Ints,
    segment: Ints,
    mirrored: Bools,
) -> Bools:
    """Tell whether segments enter their face at a stop, or start there.

    A segment comes in over a half-edge whose tail it has on the left, or on the right where the
    face is mirrored. A face without area in the plane is read as if it were not mirrored: of its
    two crossed half-edges, one answers yes.
    """
    nx = len(crossings.side)
    enters = np.empty(len(stop), bool)
    landed = stop >= nx
    point = landings.point[stop[landed] - nx]
    enters[landed] = graph.segments[segment[landed], 0] == point
    x, f = stop[~landed], face[~landed]
    h = 3 * f + corner_of_side(sheet, f, crossings.side[x])
    tail_left = crossings.first_left[x] == forward(sheet.F_uv)[h]
    enters[~landed] = tail_left != mirrored[~landed]
    return enters
