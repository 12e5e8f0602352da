"""Shorter edges on the same surface, and in the plane of its charts alike."""

from __future__ import annotations

from dataclasses import replace
from typing import TypeVar

import numpy as np

from meshjig.mesh.halfedges import edges
from meshjig.mesh.measure import edge_lengths
from meshjig.mesh.types import Atlas, Bools, Floats, Ints, Mesh

__all__ = ["refine", "refine_atlas", "refine_long_edges"]

_ROUNDS = 64
AnyAtlas = TypeVar("AnyAtlas", bound=Atlas)


def refine_long_edges(V: Floats, F: Ints, length: float) -> tuple[Floats, Ints]:
    """Split edges at their middle until none is longer than length.

    Both faces of an edge are split with it, so the mesh conforms all the time; the surface stays the same.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64
    length : float, mm

    Returns
    -------
    V : (n', 3) float64, the given vertices first
    F : (m', 3) int64
    """
    mesh, _ = refine(Mesh(V, F), length)
    return mesh.V, mesh.F


def refine(mesh: Mesh, length: float, *, shorter: bool = True) -> tuple[Mesh, Ints]:
    """Split edges as `refine_long_edges` does, and tell which face of the mesh each face lies in.

    Parameters
    ----------
    mesh : Mesh
    length : float, mm
    shorter : bool
        Whether the quad that is left of a face with two long edges is halved by its shorter diagonal.

    Returns
    -------
    mesh : Mesh, the given one where no edge is longer
    parent : (m',) int64
    """
    V, F = mesh
    parent = np.arange(len(F))
    for _ in range(_ROUNDS):
        e = edges(F)
        long = edge_lengths(V, e.E) > length
        if not long.any():
            break
        middle, W = _middles(V, e.E, e.edge_of_halfedge, long)
        of, corner = _pattern(W, F, middle, shorter)
        V, F, parent = W, _split(F, middle, of, corner), parent[of]
    return (mesh if F is mesh.F else Mesh(V, F)), parent


def refine_atlas(atlas: AnyAtlas, length: float) -> AnyAtlas:
    """Split the edges of an atlas' mesh as `refine_long_edges` does, and its charts with them.

    Parameters
    ----------
    atlas : Atlas
    length : float, mm, on the surface

    Returns
    -------
    Atlas
        The same map: every new point of the plane lies where the atlas had it. Facts are kept.
    """
    V, F, uv, G = atlas.mesh.V, atlas.mesh.F, atlas.uv, atlas.F_uv
    chart = atlas.chart_of_face
    for _ in range(_ROUNDS):
        e = edges(F)
        long = edge_lengths(V, e.E) > length
        if not long.any():
            break
        plane = edges(G)
        also = np.zeros(len(plane.E), bool)
        also[plane.edge_of_halfedge] = long[e.edge_of_halfedge]
        middle, W = _middles(V, e.E, e.edge_of_halfedge, long)
        in_plane, uv = _middles(uv, plane.E, plane.edge_of_halfedge, also)
        parent, corner = _pattern(W, F, middle)
        V, F, G = W, _split(F, middle, parent, corner), _split(G, in_plane, parent, corner)
        chart = chart[parent]
    return replace(atlas, mesh=Mesh(V, F), uv=uv, F_uv=G, chart_of_face=chart)


def _middles(X: Floats, E: Ints, edge_of_halfedge: Ints, split: Bools) -> tuple[Ints, Floats]:
    """Put a point in the middle of some edges: its number for every side of faces, else -1; all points."""
    middle = np.full(len(E), -1)
    middle[split] = len(X) + np.arange(split.sum())
    return middle[edge_of_halfedge].reshape(-1, 3), np.concatenate([X, X[E[split]].mean(axis=1)])


def _split(F: Ints, middle: Ints, parent: Ints, corner: Ints) -> Ints:
    return np.take_along_axis(np.concatenate([F, middle], 1)[parent], corner, 1)


def _pattern(V: Floats, F: Ints, middle: Ints, shorter: bool = True) -> tuple[Ints, Ints]:
    """Choose how faces fall into 1 to 4 by the middles of their sides, -1 where a side has none.

    Returns
    -------
    parent : (m',) int64, of every new face
    corner : (m', 3) int64, its corners: 0 to 2 are those of the parent, 3 to 5 the middles of its sides
    """
    has = middle >= 0
    n_split = has.sum(axis=1)
    # turn each face so that the one split side, or the one whole side, comes first
    turn = np.where(n_split == 1, has.argmax(axis=1), np.where(n_split == 2, (~has).argmax(axis=1), 0))
    corners = (np.arange(3) + turn[:, None]) % 3
    a, b, c = corners.T
    ab, bc, ca = 3 + corners.T
    one, two, three = (n_split == k for k in (1, 2, 3))
    # two sides split: a corner goes, and the rest, a quad, is halved by a diagonal, mostly the shorter
    A, B = (V[np.take_along_axis(F, corners, 1)[:, k]] for k in (0, 1))
    BC, CA = (V[np.take_along_axis(middle, corners, 1)[:, k]] for k in (1, 2))
    short = (np.linalg.norm(A - BC, axis=1) <= np.linalg.norm(B - CA, axis=1)) | (not shorter)
    first, second = two & short, two & ~short
    parts = [
        (n_split == 0, (a, b, c)),
        (one, (a, ab, c)),
        (one, (ab, b, c)),
        (two, (c, ca, bc)),
        (first, (a, b, bc)),
        (first, (a, bc, ca)),
        (second, (a, b, ca)),
        (second, (b, bc, ca)),
        (three, (a, ab, ca)),
        (three, (ab, b, bc)),
        (three, (ca, bc, c)),
        (three, (ab, bc, ca)),
    ]
    parent = np.concatenate([np.flatnonzero(mask) for mask, _ in parts])
    return parent, np.concatenate([np.stack(part, 1)[mask] for mask, part in parts])
