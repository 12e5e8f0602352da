"""The surface and its flat image as one UV mesh: edges in space, sides in the plane.

Over a seam, two sides in the plane belong to one edge in space.
"""

from typing import NamedTuple

import numpy as np

from meshjig.mesh.halfedges import edges
from meshjig.mesh.types import Bools, Floats, Ints

__all__ = ["UvMesh", "corner_of_side", "following", "forward", "make_uv_mesh"]


class UvMesh(NamedTuple):
    """A mesh with its flat image on the grid.

    Edges run from the vertex with the lower number, and sides from the UV point with the lower
    number. Half-edge ``h = 3 f + k`` runs from corner k of face f to corner k + 1.
    """

    V: Floats  # (n, 3)
    F: Ints  # (m, 3)
    U: Ints  # (k, 2)
    F_uv: Ints  # (m, 3)
    chart: Ints  # (m,)
    E: Ints  # (e, 2), edges in space, into V
    edge: Ints  # (3 m,), the edge of a half-edge
    S: Ints  # (s, 2), sides in the plane, into U
    side: Ints  # (3 m,), the side of a half-edge
    faces: Ints  # (s, 2), the faces at a side; second -1 on the border of a chart
    side_edge: Ints  # (s,), the edge of a side
    side_agrees: Bools  # (s,), whether a side runs as its edge does


def following(F: Ints) -> Ints:
    """Give the vertex that each half-edge runs to, (3 m,)."""
    out = np.empty(F.size, np.int64)
    out[0::3], out[1::3], out[2::3] = F[:, 1], F[:, 2], F[:, 0]
    return out


def forward(F: Ints) -> Bools:
    """Tell which half-edges run from the lower to the higher number, (3 m,) bool."""
    return F.ravel() < following(F)


def corner_of_side(uv_mesh: UvMesh, face: Ints, side: Ints) -> Ints:
    """Give the corner of each face at which its half-edge along a side starts."""
    sides = uv_mesh.side.reshape(-1, 3)
    return np.where(sides[face, 0] == side, 0, np.where(sides[face, 1] == side, 1, 2))


def make_uv_mesh(V: Floats, F: Ints, U: Ints, F_uv: Ints, chart: Ints) -> UvMesh:
    """Pair half-edges in space, and in the plane where no seam runs between them.

    Parameters
    ----------
    V : (n, 3) float64
    F : (m, 3) int64
    U : (k, 2) int64
    F_uv : (m, 3) int64, corners into U
    chart : (m,) int64
    """
    E, edge, twin, _ = edges(F)
    tail, head = F_uv.ravel(), following(F_uv)
    h = np.arange(len(twin))
    lower = np.flatnonzero(twin > h)
    upper = twin[lower]
    joined = (tail[lower] == head[upper]) & (head[lower] == tail[upper])
    joined &= chart[lower // 3] == chart[upper // 3]
    lower, upper = lower[joined], upper[joined]
    first = np.ones(len(h), bool)
    first[upper] = False
    side = np.cumsum(first) - 1
    side[upper] = side[lower]
    h = h[first]
    faces = np.full((len(h), 2), -1)
    faces[:, 0] = h // 3
    faces[side[upper], 1] = upper // 3
    S = np.stack([np.minimum(tail[h], head[h]), np.maximum(tail[h], head[h])], 1)
    agrees = forward(F)[h] == (tail[h] < head[h])
    return UvMesh(V, F, U, F_uv, chart, E, edge, S, side, faces, edge[h], agrees)
