"""What lies in the way of a piece that goes out along a direction."""

from __future__ import annotations

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.halfedges import edges
from meshjig.mesh.measure import area_vectors, unit
from meshjig.mesh.rays import RayScene

__all__ = ["Sight"]

_POINTS = 200  # of a piece, from which rays start
_INSIDE = 0.15  # mm, of its border, that the outermost of these are
_ABOVE = 0.02  # mm, above the sheet
_OVER = 1.5  # mm that walls may lean over the border of their piece
_NEXT = 4.0  # mm from where a ray starts: nearer borders are the piece's own
_ON = 1e-3  # mm, from one hit to where the ray goes on
_HITS = 12  # of a ray, through pieces that are off already


class Sight:
    """Rays from the outer sheets of pieces to those of others."""

    def __init__(self, V: Floats, F: Ints, piece: Ints, n_pieces: int) -> None:
        self._scene, self._piece = RayScene(V, F), piece
        self._reach = float(np.linalg.norm(np.ptp(V, axis=0)))
        middle, normal = V[F].mean(axis=1), unit(area_vectors(V, F))
        order = np.argsort(piece, kind="stable")
        start = np.searchsorted(piece[order], np.arange(n_pieces + 1))
        corner = V[F]
        inward = middle[:, None] - corner
        far = np.linalg.norm(inward, axis=2, keepdims=True)
        corner = corner + np.minimum(_INSIDE / np.maximum(far, 1e-12), 1) * inward
        between = _at_border(F, piece)
        self._beside = _beside(V, F, piece, between)
        self._points: list[Floats] = []
        for k in range(n_pieces):
            own = order[start[k] : start[k + 1]]
            f = _some(own, _POINTS)
            rim = _some(own[between[own].any(axis=1)], _POINTS)
            side = between[rim].argmax(axis=1)
            points = np.concatenate([middle[f], corner[rim, side]])
            self._points.append(points + _ABOVE * normal[np.concatenate([f, rim])])

    def blockers(self, k: int, way: Floats, left: Bools) -> set[int]:
        """Name the pieces among those left that piece k would run into."""
        origin = self._points[k]
        reach, gone, found = np.full(len(origin), self._reach), np.zeros(len(origin)), set()
        for _ in range(_HITS):
            if not len(origin):
                break
            direction = np.broadcast_to(way, origin.shape)
            hit = self._scene.hits(origin, direction)
            met = (hit["primID"] >= 0) & (hit["tfar"] < reach)
            face, far = hit["primID"][met], hit["tfar"][met] + _ON
            gone = gone[met] + far
            there = np.concatenate([self._piece[face], self._beside[face[gone > _NEXT]]])
            found.update(np.unique(there[there != k]).tolist())
            origin, reach = origin[met] + far[:, None] * way, reach[met] - far
        return {q for q in found if q >= 0 and left[q]}


def _at_border(F: Ints, piece: Ints) -> Bools:
    """Mark corners of faces from which a border between pieces leads on, (m, 3)."""
    twin = edges(F).twin
    return np.asarray((np.repeat(piece, 3) != piece[twin // 3]).reshape(-1, 3))


def _beside(V: Floats, F: Ints, piece: Ints, between: Bools) -> Ints:
    """Give the piece across the border that is near a face, -1 where none is, (m,)."""
    from scipy.spatial import cKDTree

    f, k = np.nonzero(between)
    if not len(f):
        return np.full(len(F), -1)
    other = piece[edges(F).twin[3 * f + k] // 3]
    at = (V[F[f, k]] + V[F[f, (k + 1) % 3]]) / 2
    own, beside = piece[f], np.full(len(F), -1)
    far, nearest = cKDTree(at).query(V[F].mean(axis=1), distance_upper_bound=_OVER)
    some = np.flatnonzero(np.isfinite(far))
    edge = nearest[some]
    beside[some] = np.where(own[edge] == piece[some], other[edge], own[edge])
    return beside


def _some(of: Ints, most: int) -> Ints:
    return of[np.linspace(0, len(of) - 1, min(most, len(of))).astype(int)]
