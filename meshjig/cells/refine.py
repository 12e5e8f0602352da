"""Shorter edges, with an account of the face that every new face lies in."""

import numpy as np

from meshjig.mesh.halfedges import edges
from meshjig.mesh.measure import barycentric, face_areas
from meshjig.mesh.types import Floats, Ints

__all__ = ["places", "refine"]

_ROUNDS = 64


def refine(V: Floats, F: Ints, length: float) -> tuple[Floats, Ints, Ints]:
    """Halve edges until none is longer than length; the surface stays the same.

    Both faces of an edge are split with it, so the mesh conforms.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64
    length : float, mm

    Returns
    -------
    V : (n', 3) float64, the given vertices first
    F : (m', 3) int64
    parent : (m',) int64, the given face that a face lies in
    """
    parent = np.arange(len(F))
    for _ in range(_ROUNDS):
        e = edges(F)
        long = np.linalg.norm(V[e.E[:, 1]] - V[e.E[:, 0]], axis=1) > length
        if not long.any():
            break
        middle = np.full(len(e.E), -1)
        middle[long] = len(V) + np.arange(long.sum())
        V = np.concatenate([V, V[e.E[long]].mean(axis=1)])
        F, of = _halved(F, middle[e.edge_of_halfedge].reshape(-1, 3))
        parent = parent[of]
    return V, F, parent


def places(V: Floats, F: Ints, W: Floats, G: Ints, parent: Ints) -> tuple[Ints, Floats]:
    """Find the place on a mesh of every vertex of its refinement.

    Parameters
    ----------
    V, F : the mesh
    W, G : its refinement, which keeps the numbers of the mesh's vertices
    parent : (len(G),) int64, the face of F that a face of G lies in

    Returns
    -------
    face : (len(W),) int64
    bary : (len(W), 3) float64, at least 0; exact for the vertices of the mesh
    """
    face = np.empty(len(W), np.int64)
    order = np.argsort(face_areas(V, F)[parent], kind="stable")  # of the faces around it, the largest
    face[G[order].ravel()] = np.repeat(parent[order], 3)
    bary = np.maximum(barycentric(V, F, face, W), 0.0)
    bary[: len(V)] = F[face[: len(V)]] == np.arange(len(V))[:, None]
    return face, bary / bary.sum(1, keepdims=True)


def _halved(F: Ints, middle: Ints) -> tuple[Ints, Ints]:
    """Split faces by the middles of their sides, -1 where a side has none; and give their parents."""
    has = middle >= 0
    n_split = has.sum(axis=1)
    # turn each face so that the one split side, or the one whole side, comes first
    turn = np.where(n_split == 1, has.argmax(axis=1), np.where(n_split == 2, (~has).argmax(axis=1), 0))
    corners = (np.arange(3) + turn[:, None]) % 3
    a, b, c = np.take_along_axis(F, corners, 1).T
    ab, bc, ca = np.take_along_axis(middle, corners, 1).T
    parts = [
        (0, (a, b, c)),
        (1, (a, ab, c)),
        (1, (ab, b, c)),
        (2, (c, ca, bc)),
        (2, (a, b, bc)),
        (2, (a, bc, ca)),
        (3, (a, ab, ca)),
        (3, (ab, b, bc)),
        (3, (ca, bc, c)),
        (3, (ab, bc, ca)),
    ]
    faces = [np.stack(part, 1)[n_split == k] for k, part in parts]
    return np.concatenate(faces), np.concatenate([np.flatnonzero(n_split == k) for k, _ in parts])
