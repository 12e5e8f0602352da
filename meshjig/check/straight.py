"""Straight motions: whether a piece can go out along a direction past others that stay where they are."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.measure import unit
from meshjig.mesh.mesh import Mesh
from meshjig.mesh.rays import RayScene

__all__ = ["Met", "Trials", "across", "met_on_the_way"]

_PARALLEL = 1e-12  # relative area that two edges span below which they only touch along a line


class Met(NamedTuple):
    """What a piece runs into."""

    points: int  # corners and crossings of edges, of both sides, that would meet
    faces: Ints  # (k,), faces of what stays that are met or that hold what is met
    first: float  # mm on the way until the first does; inf where nothing is met


def across(way: Floats) -> Floats:
    """Give a rotation, as rows, that turns a direction upright."""
    z = way / np.linalg.norm(way)
    x = unit(np.cross(z, np.eye(3)[np.abs(z).argmin()]))
    return np.stack([x, np.cross(z, x), z])


def met_on_the_way(
    moving: Mesh, staying: Mesh, way: Floats, reach: float | None = None, first_only: bool = False
) -> Met:
    """Find what a solid meets when it moves straight along a direction.

    Seen along the way, what stays must nowhere lie before what moves: none of its corners before a face, none
    of its faces before a corner, and no edge before another. Two polyhedra that begin apart and pass these
    tests don't meet.

    Parameters
    ----------
    moving, staying : Mesh, closed, without common space
    way : (3,) float64
    reach : float, mm, optional
        How far the motion goes; until it is clear of all where it is not given.
    first_only : bool
        Whether to stop once anything is found.

    Returns
    -------
    Met
    """
    R = across(way)
    V, W = moving.V @ R.T, staying.V @ R.T
    low, high = V.min(axis=0), V.max(axis=0)
    limit = np.inf if reach is None else reach
    least, most = (_extremes(W, staying.F, f) for f in (np.minimum, np.maximum))
    above = (most[2] > low[2]) & (least[2] < high[2] + limit)
    beside = [(least[c] <= high[c]) & (most[c] >= low[c]) for c in (0, 1)]
    face = np.flatnonzero(above & beside[0] & beside[1])
    if not len(face):
        return Met(0, face, np.inf)
    G = staying.F[face]
    used = np.unique(G)
    up = np.array([0.0, 0.0, 1.0])
    far: list[Floats] = []
    of: list[Ints] = []

    hit = RayScene(W, G).hits(V, np.broadcast_to(up, V.shape))
    met = (hit["primID"] >= 0) & (hit["tfar"] < limit)
    far.append(hit["tfar"][met].astype(np.float64))
    of.append(face[hit["primID"][met]])
    if first_only and met.any():
        return _summed(far, of)
    inside = used[((W[used, :2] >= low[:2]) & (W[used, :2] <= high[:2])).all(axis=1) & (W[used, 2] > low[2])]
    if len(inside):
        hit = RayScene(V, moving.F).hits(W[inside], np.broadcast_to(-up, (len(inside), 3)))
        met = (hit["primID"] >= 0) & (hit["tfar"] < limit)
        far.append(hit["tfar"][met].astype(np.float64))
        of.append(_face_with(staying.F, face, inside[met]))
        if first_only and met.any():
            return _summed(far, of)
    E, T = _edges(moving.F), _edges(G)
    _, j, above = _crossings(V, E, W, T)
    met = (above > 0) & (above < limit)
    far.append(above[met])
    of.append(_face_with(staying.F, face, T[j[met], 0]))
    return _summed(far, of)


class Trials:
    """Many motions of one solid past others, of which most are seen not to work at once."""

    def __init__(self, moving: Mesh, staying: Mesh) -> None:
        self.moving, self.staying = moving, staying
        self._scenes = RayScene(*moving), RayScene(*staying)

    def is_free(self, way: Floats, shift: Floats) -> bool:
        """Tell whether the solid, moved by a shift, can go straight along a way until it is clear of all."""
        for scene, start, sign in (
            (self._scenes[1], self.moving.V + shift, 1),
            (self._scenes[0], self.staying.V - shift, -1),
        ):
            direction = np.broadcast_to(sign * way, start.shape)
            if scene.is_hidden(start, direction, np.full(len(start), np.inf)).any():
                return False
        moved = Mesh(self.moving.V + shift, self.moving.F)
        return not met_on_the_way(moved, self.staying, way, first_only=True).points


def _summed(far: list[Floats], of: list[Ints]) -> Met:
    gap = np.concatenate(far)
    return Met(len(gap), np.unique(np.concatenate(of)), float(gap.min(initial=np.inf)))


def _extremes(V: Floats, F: Ints, choose: Any) -> list[Floats]:
    """Give the least or the largest coordinates of every face, three (m,)."""
    return [choose(choose(x[F[:, 0]], x[F[:, 1]]), x[F[:, 2]]) for x in np.ascontiguousarray(V.T)]


def _edges(F: Ints) -> Ints:
    both = np.sort(np.concatenate([F[:, [0, 1]], F[:, [1, 2]], F[:, [2, 0]]]), axis=1)
    n = int(both.max(initial=0)) + 1
    key = np.unique(both[:, 0] * n + both[:, 1])
    return np.stack([key // n, key % n], 1)


def _face_with(F: Ints, some: Ints, vertices: Ints) -> Ints:
    """Give one of some faces at each vertex."""
    face_at = np.zeros(int(F.max(initial=0)) + 1, np.int64)
    face_at[F[some].ravel()] = np.repeat(some, 3)
    return np.asarray(face_at[vertices])


def _crossings(V: Floats, E: Ints, W: Floats, T: Ints) -> tuple[Ints, Ints, Floats]:
    """List edges that cross as seen from above, and by how much the second lies above the first."""
    import shapely

    low, high = V.min(axis=0), V.max(axis=0)
    c, d = W[T[:, 0]], W[T[:, 1]]
    near = np.maximum(c[:, 2], d[:, 2]) > low[2]
    for k in (0, 1):
        near &= (np.minimum(c[:, k], d[:, k]) <= high[k]) & (np.maximum(c[:, k], d[:, k]) >= low[k])
    t = np.flatnonzero(near)
    c, d = c[t], d[t]
    a, b = V[E[:, 0]], V[E[:, 1]]
    close = np.ones(len(a), bool)  # of the edges that move, those below and near to some that stay
    if len(t):
        first, last = np.minimum(c, d).min(axis=0), np.maximum(c, d).max(axis=0)
        for k in (0, 1):
            close &= (np.minimum(a[:, k], b[:, k]) <= last[k]) & (np.maximum(a[:, k], b[:, k]) >= first[k])
        close &= np.minimum(a[:, 2], b[:, 2]) < last[2]
    e = np.flatnonzero(close)
    tree = shapely.STRtree(_boxes(a[e], b[e]))
    j, i = tree.query(_boxes(c, d))
    i = e[i]
    j = t[j]
    a, b, c, d = V[E[i, 0]], V[E[i, 1]], W[T[j, 0]], W[T[j, 1]]
    keep = np.maximum(c[:, 2], d[:, 2]) > np.minimum(a[:, 2], b[:, 2])
    i, j, a, b, c, d = i[keep], j[keep], a[keep], b[keep], c[keep], d[keep]
    r, s, q = b - a, d - c, c - a
    det = r[:, 0] * s[:, 1] - r[:, 1] * s[:, 0]
    flat = np.abs(det) <= _PARALLEL * np.linalg.norm(r, axis=1) * np.linalg.norm(s, axis=1)
    det = np.where(flat, 1.0, det)
    u = (q[:, 0] * s[:, 1] - q[:, 1] * s[:, 0]) / det
    v = (q[:, 0] * r[:, 1] - q[:, 1] * r[:, 0]) / det
    met = ~flat & (u >= 0) & (u <= 1) & (v >= 0) & (v <= 1)
    above = (c[:, 2] + v * s[:, 2]) - (a[:, 2] + u * r[:, 2])
    return i[met], j[met], above[met]


def _boxes(a: Floats, b: Floats) -> Any:
    import shapely

    low, high = np.minimum(a, b), np.maximum(a, b)
    return shapely.box(low[:, 0], low[:, 1], high[:, 0], high[:, 1])
