"""Edges between pieces made short enough for the walls ruled along them to be smooth."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.halfedges import edges
from meshjig.mesh.measure import unit

__all__ = ["LabelledShell", "bends", "bent", "split_bent_walls"]

_ROUNDS = 24
_TURN = np.cos(np.radians(25))


class LabelledShell(NamedTuple):
    """A surface that is divided into pieces, and the way to its inner sheet."""

    V: Floats  # (n, 3), mm
    F: Ints  # (m, 3)
    piece_of_face: Ints  # (m,)
    D: Floats  # (n, 3), mm


def split_bent_walls(V: Floats, F: Ints, piece_of_face: Ints, D: Floats, tolerance: float) -> LabelledShell:
    """Halve the edges between pieces along which a wall turns too much to be two triangles.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64
    piece_of_face : (m,) int64
    D : (n, 3) float64, mm
    tolerance : float, mm, between a wall's diagonal and the surface ruled along D

    Returns
    -------
    LabelledShell
        The same surface and the same sheet, with more vertices; the old ones come first.
    """
    rest, rest_piece = F[:0], piece_of_face[:0]
    for _ in range(_ROUNDS):
        e = edges(F)
        between = np.zeros(len(e.E), bool)
        between[e.edge_of_halfedge[np.repeat(piece_of_face, 3) != piece_of_face[e.twin // 3]]] = True
        i, j = e.E.T
        wanted = between & bent(V, V + D, i, j, tolerance)
        done = ~wanted[e.edge_of_halfedge].reshape(-1, 3).any(1)  # faces that won't change any more
        rest, rest_piece = np.concatenate([rest, F[done]]), np.concatenate([rest_piece, piece_of_face[done]])
        alone = _one_a_face(e.edge_of_halfedge.reshape(-1, 3), wanted)
        left = LabelledShell(V, F[~done], piece_of_face[~done], D)
        if done.all():
            F, piece_of_face = left.F, left.piece_of_face
            break
        V, F, piece_of_face, D = _halved(left, e.edge_of_halfedge[np.repeat(~done, 3)], e.E, alone)
    return LabelledShell(V, np.concatenate([rest, F]), np.concatenate([rest_piece, piece_of_face]), D)


def bent(X: Floats, Y: Floats, i: Ints, j: Ints, tolerance: float) -> Bools:
    """Mark quads that two triangles don't stand for, (k,).

    Their diagonal is farther than the tolerance from the ruled wall, or their ends point in directions that
    differ too much for an edge between them to run beside the sheet.
    """
    first, last = unit(Y[i] - X[i]), unit(Y[j] - X[j])
    return (bends(X, Y, i, j) > tolerance) | (np.einsum("ij,ij->i", first, last) < _TURN)


def bends(X: Floats, Y: Floats, i: Ints, j: Ints) -> Floats:
    """Give how far the diagonals of quads lie from the surface ruled between X and Y.

    Parameters
    ----------
    X, Y : (n, 3) float64, mm
    i, j : (k,) int64, where a quad starts and ends

    Returns
    -------
    (k,) float64, mm
    """
    normal = unit(np.cross(X[j] - X[i] + Y[j] - Y[i], Y[i] - X[i] + Y[j] - X[j]))
    return np.asarray(np.abs(np.einsum("ij,ij->i", Y[j] - X[j] - Y[i] + X[i], normal)) / 4)


def _one_a_face(edges_of_face: Ints, wanted: Bools) -> Bools:
    """Choose wanted edges so that no face has two of them, (e,)."""
    n = len(wanted)
    rank = np.where(wanted, np.arange(n), n)
    least = rank[edges_of_face].min(1)  # the first wanted edge of each face
    chosen = wanted.copy()
    later = rank[edges_of_face] > least[:, None]
    chosen[edges_of_face[later]] = False
    return chosen


def _halved(shell: LabelledShell, edge_of_halfedge: Ints, E: Ints, chosen: Bools) -> LabelledShell:
    """Put a vertex in the middle of each chosen edge, of which a face has one at most."""
    V, F, piece, D = shell
    new = np.cumsum(chosen) - 1 + len(V)
    a, b = E[chosen].T
    h = np.flatnonzero(chosen[edge_of_halfedge])
    f, k = h // 3, h % 3
    middle = new[edge_of_halfedge[h]]
    first, second = F[f].copy(), F[f].copy()
    first[np.arange(len(h)), (k + 1) % 3] = middle
    second[np.arange(len(h)), k] = middle
    F = F.copy()
    F[f] = first
    return LabelledShell(
        np.concatenate([V, (V[a] + V[b]) / 2]),
        np.concatenate([F, second]),
        np.concatenate([piece, piece[f]]),
        np.concatenate([D, (D[a] + D[b]) / 2]),
    )
