"""Where the new vertices lie: in which face, and where in it."""

from typing import NamedTuple

import numpy as np

from meshjig.cut.edge_nodes import APART_MM, EdgeNodes
from meshjig.cut.inner_halfedges import Ring, Wiring
from meshjig.cut.predicates import orient
from meshjig.cut.snap import Graph
from meshjig.cut.trace import FaceSegments, PointHits
from meshjig.cut.uv_mesh import UvMesh, forward
from meshjig.mesh.types import Floats, Ints

__all__ = ["Places", "corner_frames", "half_edge_places", "hit_weights", "kept_off_edges"]

NEAREST = 0.02  # no barycentric coordinate is kept larger than this, however small the face


class Places(NamedTuple):
    """The start of every half-edge: its vertex, and where that lies in the face.

    Vertices are numbered: those of the UV mesh, then edge nodes, then hits.
    """

    vertex: Ints  # (h,)
    row: Ints  # (h,), the face as a place in the ring's faces
    bary: Floats  # (h, 3)
    first_hit: int
    n_vertices: int


def hit_weights(uv_mesh: UvMesh, graph: Graph, hits: PointHits) -> Floats:
    """Give barycentric coordinates of outline points in faces, kept off the faces' edges; (l, 3)."""
    face = hits.face
    u, v, w = (uv_mesh.U[uv_mesh.F_uv[face, k]] for k in range(3))
    p = graph.points[hits.point]
    weights = np.stack([orient(v, w, p), orient(w, u, p), orient(u, v, p)], 1)
    bary = weights / np.where(orient(u, v, w) == 0, 1, orient(u, v, w))[:, None]
    return kept_off_edges(bary, uv_mesh.V[uv_mesh.F[face]])


def kept_off_edges(bary: Floats, corners: Floats) -> Floats:
    """Move places (n, 3) in faces with given corners (n, 3, 3) a little away from the faces' edges."""
    opposite = np.linalg.norm(corners[:, [2, 0, 1]] - corners[:, [1, 2, 0]], axis=2)
    doubled = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    height = doubled[:, None] / np.maximum(opposite, 1e-30)
    bary = np.maximum(bary, np.minimum(APART_MM / np.maximum(height, 1e-30), NEAREST))
    return bary / bary.sum(axis=1, keepdims=True)


def half_edge_places(
    uv_mesh: UvMesh,
    ring: Ring,
    nodes: EdgeNodes,
    face_segments: FaceSegments,
    weights: Floats,
    wiring: Wiring,
) -> Places:
    """Place the starts of all half-edges: of the ring, of segments forth, of segments back.

    Parameters
    ----------
    weights : (l, 3) float64, from hit_weights
    """
    nr, nl, nx = len(ring.next), len(face_segments.face), len(nodes.of_crossing)
    tail = np.concatenate([face_segments.start, face_segments.end])
    vertex = np.empty(nr + 2 * nl, np.int64)
    row = np.concatenate([ring.face, ring.row[face_segments.face], ring.row[face_segments.face]])
    bary = np.zeros((len(vertex), 3))

    at_node = np.flatnonzero(ring.node >= 0)
    node, corner = ring.node[at_node], ring.corner[at_node]
    runs_up = forward(uv_mesh.F[ring.faces])[3 * ring.face[at_node] + corner]
    along = np.where(runs_up, nodes.along[node], 1 - nodes.along[node])
    vertex[:nr] = uv_mesh.F[ring.faces[ring.face], ring.corner]
    vertex[at_node] = len(uv_mesh.V) + node
    bary[np.arange(nr), ring.corner] = 1
    bary[at_node, corner] = 1 - along
    bary[at_node, (corner + 1) % 3] = along

    at_hit = np.flatnonzero(tail >= nx)
    vertex[nr + at_hit] = len(uv_mesh.V) + len(nodes.edge) + tail[at_hit] - nx
    bary[nr + at_hit] = weights[tail[at_hit] - nx]
    vertex[wiring.leaving], bary[wiring.leaving] = vertex[wiring.slot], bary[wiring.slot]
    first_hit = len(uv_mesh.V) + len(nodes.edge)
    return Places(vertex, row, bary, first_hit, first_hit + len(weights))


def corner_frames(uv_mesh: UvMesh, faces: Ints) -> Floats:
    """Lay faces flat without stretch, (t, 3, 2) mm; a face without area becomes equilateral."""
    a = uv_mesh.V[uv_mesh.F[faces, 0]]
    d, e = uv_mesh.V[uv_mesh.F[faces, 1]] - a, uv_mesh.V[uv_mesh.F[faces, 2]] - a
    length = np.linalg.norm(d, axis=1)
    x = np.einsum("ij,ij->i", d, e) / np.maximum(length, 1e-300)
    y = np.sqrt(np.maximum(np.einsum("ij,ij->i", e, e) - x * x, 0))
    flat = y * length <= 1e-9 * np.maximum(length**2, x * x + y * y)
    frames = np.zeros((len(faces), 3, 2))
    frames[:, 1, 0] = np.where(flat, 1, length)
    frames[:, 2, 0] = np.where(flat, 0.5, x)
    frames[:, 2, 1] = np.where(flat, np.sqrt(0.75), y)
    return frames
