"""A mesh seen face by face: which faces meet, over what edge, at what angle."""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from meshjig.mesh.halfedges import edges
from meshjig.mesh.measure import area_vectors, edge_lengths, unit

__all__ = ["Dual", "dual"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


class Dual(NamedTuple):
    """The dual graph; rows of the first group are inner edges, rows of the second are faces."""

    first: Ints  # (e,), face on one side
    second: Ints  # (e,), face on the other
    ends: Ints  # (e, 2), vertices of the edge
    length: Floats  # (e,), mm
    span: Floats  # (e,), mm from centre to centre over the middle of the edge
    bend: Floats  # (e,), cosine between the normals
    halfedge: Ints  # (e,), of the edge, in first
    twin: Ints  # (e,), of the edge, in second

    centre: Floats  # (m, 3)
    normal: Floats  # (m, 3)
    area: Floats  # (m,)

    def graph(self, weight: Floats) -> Any:
        """Give the faces' symmetric adjacency matrix with a weight an edge."""
        from scipy.sparse import csr_matrix

        rows, cols = np.append(self.first, self.second), np.append(self.second, self.first)
        m = len(self.area)
        return csr_matrix((np.append(weight, weight), (rows, cols)), shape=(m, m))


def dual(V: Floats, F: Ints) -> Dual:
    """Build the dual graph of a mesh.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, manifold

    Returns
    -------
    Dual
    """
    e = edges(F)
    h = np.flatnonzero(e.twin > np.arange(len(e.twin)))
    first, second = h // 3, e.twin[h] // 3
    ends = e.E[e.edge_of_halfedge[h]]
    normal = area_vectors(V, F)
    area = np.linalg.norm(normal, axis=1) / 2
    normal = unit(normal)
    centre, middle = V[F].mean(1), V[ends].mean(1)
    length = edge_lengths(V, ends)
    span = np.linalg.norm(centre[first] - middle, axis=1) + np.linalg.norm(centre[second] - middle, axis=1)
    bend = np.clip(np.einsum("ij,ij->i", normal[first], normal[second]), -1, 1)
    return Dual(first, second, ends, length, span, bend, h, e.twin[h], centre, normal, area)
