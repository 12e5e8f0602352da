"""The half-edges inside cut faces: around each face, and both ways along each face segment."""

from typing import NamedTuple

import numpy as np

from meshjig.cut.edge_nodes import EdgeNodes
from meshjig.cut.predicates import angular_order
from meshjig.cut.snap import Graph
from meshjig.cut.trace import FaceSegments, Trace
from meshjig.cut.uv_mesh import UvMesh, corner_of_side, forward
from meshjig.mesh.arrays import next_in_loop, ranks, row_of, starts
from meshjig.mesh.types import Ints

__all__ = ["Ring", "Wiring", "make_ring", "wire"]


class Ring(NamedTuple):
    """The borders of cut faces as half-edges, counter-clockwise, face after face."""

    faces: Ints  # (t,), the faces that are cut, or have a new vertex on an edge
    row: Ints  # (m,), the place of a face in faces, -1 where it is untouched
    face: Ints  # (r,), the face of each half-edge, as a place in faces
    corner: Ints  # (r,), the corner of the face before, or at, its start
    node: Ints  # (r,), the edge node it starts at, -1 for a corner
    interval: Ints  # (r,), the part of an edge that it runs along, numbered over all edges
    start: Ints  # (t, 3), the half-edge that starts at each corner
    next: Ints  # (r,)


class Wiring(NamedTuple):
    """Ring half-edges, then face segments forth, then back: who follows whom."""

    next: Ints  # (r + 2 l,)
    leaving: Ints  # (c,), half-edges of face segments that leave an edge node
    slot: Ints  # (c,), the ring half-edge that starts at the same node


def make_ring(uv_mesh: UvMesh, nodes: EdgeNodes, linked: Ints) -> Ring:
    """List the half-edges around all faces that have nodes on their edges, or segments (linked: faces)."""
    per_side = nodes.number[uv_mesh.edge]
    touched = per_side.reshape(-1, 3).sum(axis=1) > 0
    touched[linked] = True
    faces = np.flatnonzero(touched)
    row = np.full(len(uv_mesh.F), -1)
    row[faces] = np.arange(len(faces))

    h = (3 * faces[:, None] + np.arange(3)).ravel()
    size = per_side[h] + 1
    owner, rank = row_of(size), ranks(size)
    edge, runs_up = uv_mesh.edge[h[owner]], forward(uv_mesh.F[faces])[owner]
    count = nodes.number[edge]
    node = np.where(rank == 0, -1, nodes.first[edge] + np.where(runs_up, rank - 1, count - rank))
    interval = nodes.first[edge] + edge + np.where(runs_up, rank, count - rank)

    follows = next_in_loop(size.reshape(-1, 3).sum(1))
    return Ring(faces, row, owner // 3, owner % 3, node, interval, starts(size).reshape(-1, 3), follows)


def wire(uv_mesh: UvMesh, graph: Graph, nodes: EdgeNodes, ring: Ring, seen: Trace) -> Wiring:
    """Say which half-edge follows which, so that every part of a face is one cycle."""
    crossings, hits, face_segments = seen
    nx, nr, nl = len(crossings.side), len(ring.next), len(face_segments.face)
    tail = np.concatenate([face_segments.start, face_segments.end])
    face = np.concatenate([face_segments.face, face_segments.face])
    half = nr + np.arange(2 * nl)
    back = np.concatenate([half[nl:], half[:nl]])
    follows = np.concatenate([ring.next, back])

    at_edge = tail < nx
    x = tail[at_edge]
    slot = _slots(uv_mesh, nodes, ring, face[at_edge], crossings.side[x], nodes.of_crossing[x])
    leaving, arriving = half[at_edge], back[at_edge]
    before = np.empty(nr, np.int64)
    before[ring.next] = np.arange(nr)
    follows[before[slot]] = leaving
    follows[arriving] = slot

    inside = ~at_edge
    stop = tail[inside] - nx
    follows[_turns(graph, face_segments, hits.point[stop], stop, half[inside] - nr, nr)] = half[inside]
    return Wiring(follows, leaving, slot)


def _slots(uv_mesh: UvMesh, nodes: EdgeNodes, ring: Ring, face: Ints, side: Ints, node: Ints) -> Ints:
    """Give the ring half-edges of faces that start at nodes on their sides."""
    corner = corner_of_side(uv_mesh, face, side)
    edge = uv_mesh.side_edge[side]
    rank = node - nodes.first[edge]
    runs_up = forward(uv_mesh.F[face]).reshape(-1, 3)[np.arange(len(face)), corner]
    rank = np.where(runs_up, rank + 1, nodes.number[edge] - rank)
    return ring.start[ring.row[face], corner] + rank


def _turns(
    graph: Graph, face_segments: FaceSegments, point: Ints, stop: Ints, half: Ints, n_ring: int
) -> Ints:
    """Give, for half-edges that leave point hits, those after which they come.

    About a point hit, faces lie on the left of half-edges: who arrives leaves by the next direction
    clockwise, or counter-clockwise in a mirrored face.
    """
    if not len(half):
        return half
    nl = len(face_segments.face)
    which, is_back = half % nl, half >= nl
    ends = graph.segments[face_segments.segment[which]]
    far = np.where(ends[:, 0] == point, ends[:, 1], ends[:, 0])
    order = angular_order(stop, graph.points[far] - graph.points[point])
    successor = next_in_loop(np.bincount(stop))
    predecessor = np.empty_like(successor)
    predecessor[successor] = np.arange(len(successor))
    # half-edge i is followed, when one comes in along direction j, iff i is before j clockwise
    other = np.where(face_segments.mirrored[which[order]], predecessor, successor)
    incoming = np.empty(len(order), np.int64)
    incoming[order] = order[other]
    arrived = np.where(is_back, half - nl, half + nl)
    return n_ring + arrived[incoming]
