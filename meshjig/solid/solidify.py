"""From a labelled surface to solids: outer sheet, inner sheet, and walls ruled between them."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.components import fans
from meshjig.mesh.halfedges import edges
from meshjig.mesh.measure import area_vectors, unit
from meshjig.solid.separate_float32 import separate_fans, separate_inner

__all__ = ["INNER", "LEAST_MM", "OUTER", "WALL", "Solid", "SolidCounts", "solidify"]

OUTER, INNER, WALL = 0, 1, 2
LEAST_MM = 0.05  # mm, the thinnest a piece may get anywhere
_HALVINGS = 6


class Solid(NamedTuple):
    """A closed piece: outer faces first, then inner faces in the same order, then walls."""

    V: Floats  # (n, 3), mm; outer vertices first, then inner vertices in the same order
    F: Ints  # (m, 3), oriented outward
    kind: Ints  # (m,), OUTER, INNER or WALL


class SolidCounts(NamedTuple):
    """What had to be changed."""

    raised: int  # vertices whose D was too short
    pinches: int  # vertices moved because a piece touched itself there
    nudged: int  # inner vertices moved because they fell together
    shrunk: int  # pieces made thinner to keep a positive volume


class _Faces(NamedTuple):
    corners: Ints  # (m, 3), into the outer vertices of all pieces and then the inner ones
    kind: Ints  # (m,)
    piece: Ints  # (m,)


def solidify(V: Floats, F: Ints, piece_of_face: Ints, D: Floats) -> tuple[list[Solid], SolidCounts]:
    """Give every piece of a surface its thickness, all pieces at once.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, manifold, oriented outward
    piece_of_face : (m,) int64; faces below 0 are dropped
    D : (n, 3) float64, mm, from the outer to the inner sheet; also the direction of walls

    Returns
    -------
    solids : list of Solid, by piece number; a number without faces has an empty one
    counts : SolidCounts

    Notes
    -----
    Each solid is closed and consistently oriented, and connected when its faces are connected over edges;
    vertices that differ still differ as float32, as files store them. A vertex at which a piece only touches
    itself is split and the sides are moved apart by some micrometres. Walls shared by two pieces are split
    along the same diagonal.
    """
    n_pieces = int(piece_of_face.max(initial=-1)) + 1
    kept = np.flatnonzero(piece_of_face >= 0)
    kept = kept[np.argsort(piece_of_face[kept], kind="stable")]
    label = piece_of_face[kept]
    G, source, owner = _vertices_of_pieces(F[kept], label, len(V))
    X, pinches = separate_fans(V[source], G, owner)
    step, raised = _at_least(D[source], X, G)
    border = _border(G)
    walls_of = label[border[:, 2]]
    Y, nudged = separate_inner(X, X + step, G, owner)
    corners = np.concatenate([G, G[:, ::-1] + len(X), _walls(X, Y, border[:, :2], source)])
    kind = np.repeat([OUTER, INNER, WALL], [len(G), len(G), 2 * len(border)])
    faces = _Faces(corners, kind, np.concatenate([label, label, walls_of, walls_of]))
    Y, shrunk = _with_volume(X, Y, faces, owner, n_pieces)
    solids = _apart(X, Y, faces, owner, n_pieces)
    return solids, SolidCounts(raised, pinches, nudged, shrunk)


def _vertices_of_pieces(F: Ints, label: Ints, n: int) -> tuple[Ints, Ints, Ints]:
    """Give each fan of each piece its own vertex; faces, the old vertex and the piece, sorted by piece."""
    key, inverse = np.unique(label[:, None] * np.int64(n) + F, return_inverse=True)
    G, origin = fans(inverse.reshape(F.shape).astype(np.int64))
    order = np.argsort(origin, kind="stable")
    rank = np.empty(len(order), np.int64)
    rank[order] = np.arange(len(order))
    key = key[origin[order]]
    return rank[G], key % n, key // n


def _at_least(D: Floats, X: Floats, G: Ints) -> tuple[Floats, int]:
    length = np.linalg.norm(D, axis=1)
    short = length < LEAST_MM
    if not short.any():
        return D, 0
    normal = np.zeros_like(X)
    N = area_vectors(X, G)
    for k in range(3):
        np.add.at(normal, G[:, k], N)
    way = np.where(length[:, None] > 1e-9, unit(D), -unit(normal))
    return np.where(short[:, None], LEAST_MM * way, D), int(short.sum())


def _border(G: Ints) -> Ints:
    """List border half-edges as (from, to, face)."""
    twin = edges(G).twin
    h = np.flatnonzero(twin == np.arange(len(twin)))
    return np.stack([G.ravel()[h], G[:, [1, 2, 0]].ravel()[h], h // 3], 1)


def _walls(X: Floats, Y: Floats, border: Ints, source: Ints) -> Ints:
    """Rule a quad along every border edge, (2 b, 3), split along the shorter diagonal.

    Both pieces at an edge choose alike: lengths are compared from the end with the lower source vertex.
    """
    a, b = border.T
    forward = source[a] < source[b]
    low, high = np.where(forward, a, b), np.where(forward, b, a)
    from_low = ((X[low] - Y[high]) ** 2).sum(1) <= ((X[high] - Y[low]) ** 2).sum(1)
    from_b = (from_low != forward)[:, None]  # the diagonal starts at b's outer vertex
    k = len(X)
    first = np.where(from_b, np.stack([b, a, a + k], 1), np.stack([b, a, b + k], 1))
    second = np.where(from_b, np.stack([b, a + k, b + k], 1), np.stack([a, a + k, b + k], 1))
    return np.concatenate([first, second])


def _with_volume(X: Floats, Y: Floats, faces: _Faces, owner: Ints, n_pieces: int) -> tuple[Floats, int]:
    """Halve the thickness of pieces whose inner sheet has turned them inside out."""
    shrunk = np.zeros(n_pieces, bool)
    has_faces = np.bincount(faces.piece, minlength=n_pieces) > 0
    for _ in range(_HALVINGS):
        bad = has_faces & (_volumes(np.concatenate([X, Y]), faces.corners, faces.piece, n_pieces) <= 0)
        if not bad.any():
            break
        shrunk |= bad
        Y = np.where(bad[owner][:, None], (X + Y) / 2, Y)
    return Y, int(shrunk.sum())


def _volumes(V: Floats, F: Ints, piece: Ints, n_pieces: int) -> Floats:
    a, b, c = V[F[:, 0]], V[F[:, 1]], V[F[:, 2]]
    cones = np.einsum("ij,ij->i", a, np.cross(b, c)) / 6
    return np.bincount(piece, cones, n_pieces).astype(np.float64)


def _apart(X: Floats, Y: Floats, faces: _Faces, owner: Ints, n_pieces: int) -> list[Solid]:
    order = np.argsort(faces.piece, kind="stable")
    corners, kind, piece = (x[order] for x in faces)
    face_at = np.searchsorted(piece, np.arange(n_pieces + 1))
    vertex_at = np.searchsorted(owner, np.arange(n_pieces + 1))
    inner = corners >= len(X)
    local = np.where(inner, corners - len(X), corners)
    start, count = vertex_at[:-1][piece], np.diff(vertex_at)[piece]
    local = local - start[:, None] + inner * count[:, None]
    solids = []
    for i in range(n_pieces):
        v, f = slice(*vertex_at[i : i + 2]), slice(*face_at[i : i + 2])
        solids.append(Solid(np.concatenate([X[v], Y[v]]), local[f], kind[f]))
    return solids
