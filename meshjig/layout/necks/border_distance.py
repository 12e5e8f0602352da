"""How far the edges of a mesh are from the borders of its pieces."""

from typing import Any, NamedTuple

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints, ranks, row_of
from meshjig.mesh.halfedges import Edges
from meshjig.mesh.measure import vertex_normals

__all__ = ["ALONG", "BorderPoints", "between", "border_points", "distances_along"]

FINE = 0.1  # widths between points of a border
SEEN = 2.0  # widths up to which distances from borders are known
ALONG = np.linspace(0, 1, 9)  # of an edge, where its distance from the borders is looked at


class BorderPoints(NamedTuple):
    """Points along the borders of all pieces, to be near to or not."""

    V: Floats  # (n, 3), the mesh's vertices
    N: Floats  # (n, 3), their normals
    tree: Any
    normals: Floats  # (k, 3), of the points
    width: float  # mm, that is to be told apart from less
    reach: float  # mm

    def distance(self, P: Floats, N: Floats) -> Floats:
        """Give the distance of points (k, 3) with normals (k, 3); the reach, where it is more.

        A border on the other side of a thin sheet is not near.
        """
        far, at = self.tree.query(P, distance_upper_bound=self.reach)
        found = np.flatnonzero(np.isfinite(far))
        behind = np.einsum("ij,ij->i", N[found], self.normals[at[found]]) < 0
        far[found[behind]] = self.reach
        return np.minimum(far, self.reach)


def border_points(V: Floats, F: Ints, e: Edges, piece: Ints, width: float) -> BorderPoints:
    """Put points along the borders of all pieces.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64
    e : Edges, of F
    piece : (m,) int64, of every face
    width : float, mm, that is to be told apart from less: how fine the points lie, and how far they are seen
    """
    from scipy.spatial import cKDTree

    a, b = e.E[np.unique(e.edge_of_halfedge[_on_border(e, piece)])].T
    n = np.ceil(np.linalg.norm(V[a] - V[b], axis=1) / (FINE * width)).astype(np.int64) + 1
    row = row_of(n)
    t = ranks(n) / np.maximum(n[row] - 1, 1)
    N = vertex_normals(V, F)
    points, normals = (between(X, np.stack([a[row], b[row]], 1), t) for X in (V, N))
    return BorderPoints(V, N, cKDTree(points), normals, width, SEEN * width)


def distances_along(ends: Ints, near: BorderPoints) -> Floats:
    """Give the distance of edges (k, 2) from the borders all along them, (k, 9), mm.

    An edge so short or so far from the borders that it can't come near has those of its ends.
    """
    V = near.V
    at_end = near.distance(V, near.N)[ends]
    length = np.linalg.norm(V[ends[:, 0]] - V[ends[:, 1]], axis=1)
    far = at_end[:, :1] + ALONG * (at_end[:, 1:] - at_end[:, :1])
    doubt = np.flatnonzero(at_end.sum(1) < length + near.width)
    inner, t = len(ALONG) - 2, np.tile(ALONG[1:-1], len(doubt))
    along = np.repeat(ends[doubt], inner, axis=0)
    far[doubt, 1:-1] = near.distance(between(V, along, t), between(near.N, along, t)).reshape(-1, inner)
    return far


def between(X: Floats, ends: Ints, t: Floats) -> Floats:
    """Give the values between those of two rows (k, 2), 0 to 1 on the way."""
    a, b = X[ends[:, 0]], X[ends[:, 1]]
    mixed: Floats = a + t[:, None] * (b - a)
    return mixed


def _on_border(e: Edges, piece: Ints) -> Bools:
    """Tell which half-edges have another piece, or nothing, on their other side."""
    return (piece[e.twin // 3] != np.repeat(piece, 3)) | (e.twin == np.arange(len(e.twin)))
