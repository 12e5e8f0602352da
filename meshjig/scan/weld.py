"""Close the cracks that file formats leave: equal vertices, equal faces, faces without area."""

from __future__ import annotations

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints, connected
from meshjig.mesh.halfedges import edges
from meshjig.mesh.measure import area_vectors
from meshjig.scan.close_points import close_pairs

__all__ = ["drop_doubles", "flip_flat", "weld"]

_FLIP_ROUNDS = 20


def weld(V: Floats, F: Ints, tolerance: float) -> tuple[Floats, Ints, int]:
    """Merge vertices that lie in one place and belong together.

    Those are border vertices (STL triangles, texture seams) within tolerance of each other, and the ends
    of edges shorter than it. Two sheets that merely touch stay apart.

    Parameters
    ----------
    V : (n, 3) float64
    F : (m, 3) int64, which uses every vertex
    tolerance : float, a distance in the units of V

    Returns
    -------
    V : (n', 3) float64, in the order they came in
    F : (m, 3) int64
    n_merged : int, vertices that went
    """
    e = edges(F)
    length = np.linalg.norm(V[e.E[:, 0]] - V[e.E[:, 1]], axis=1)
    pairs = e.E[(length <= tolerance) & (e.E[:, 0] != e.E[:, 1])]
    on_border = np.zeros(len(V), bool)
    on_border[e.E[e.n_faces != 2]] = True
    border = np.flatnonzero(on_border)
    if len(border):
        pairs = np.concatenate([pairs, border[close_pairs(V[border], tolerance)]])
    if not len(pairs):
        return V, F, 0
    n, group = connected(len(V), *pairs.T)
    first = np.full(n, len(V))
    np.minimum.at(first, group, np.arange(len(V)))
    return V[first], group[F], len(V) - n


def drop_doubles(F: Ints) -> tuple[Ints, int, int]:
    """Drop faces with a repeated corner, and all but the first of faces with equal corners.

    Returns
    -------
    F : (m', 3) int64
    n_null : int
    n_duplicate : int
    """
    a, b, c = F.T
    null = (a == b) | (b == c) | (c == a)
    F = F[~null]
    if _all_differ(F):
        return F, int(null.sum()), 0
    corners = np.sort(F, axis=1)
    order = np.lexsort(corners.T)
    same = (corners[order[1:]] == corners[order[:-1]]).all(axis=1)
    keep = np.ones(len(F), bool)
    keep[order[1:][same]] = False  # lexsort is stable: the first of each run stays
    return F[keep], int(null.sum()), int(same.sum())


def _all_differ(F: Ints) -> bool:
    """Tell that no two faces have equal corners, for sure; it may fail to where that is so."""
    of_vertex = np.arange(int(F.max(initial=0)) + 1, dtype=np.uint64) + np.uint64(1)
    for odd in (0x9E3779B97F4A7C15, 0xC2B2AE3D27D4EB4F):
        of_vertex *= np.uint64(odd)
        of_vertex ^= of_vertex >> np.uint64(29)
    mixed = of_vertex[F[:, 0]] + of_vertex[F[:, 1]] + of_vertex[F[:, 2]]  # in whichever order they come
    mixed.sort()
    return not (mixed[1:] == mixed[:-1]).any()


def flip_flat(V: Floats, F: Ints, height: float) -> tuple[Ints, int]:
    """Get rid of faces flatter than height without opening a crack.

    A vertex that lies on the longest edge of its flat face takes the place of that edge: the edge is
    flipped into the neighbour, or the face dropped where there is no neighbour.

    Parameters
    ----------
    V : (n, 3) float64
    F : (m, 3) int64
    height : float, in the units of V

    Returns
    -------
    F : (m', 3) int64. Flat faces remain where no flip is possible.
    n_flat : int, flat faces found
    """
    found = int(_flat(V, F, height)[0].sum())
    if not found:
        return F, 0
    F = F.copy()
    for _ in range(_FLIP_ROUNDS):
        flat, longest = _flat(V, F, height)
        e = edges(F)
        h = 3 * np.flatnonzero(flat) + longest[flat]
        border = e.n_faces[e.edge_of_halfedge[h]] == 1
        dropped = h[border] // 3
        chosen = _independent(V, F, h[~border], e.twin, e.E, flat)
        if not len(chosen) and not len(dropped):
            break
        t = e.twin[chosen]
        b, c, a, d = _corner(F, chosen, 1), _corner(F, chosen, 2), _corner(F, chosen, 0), _corner(F, t, 2)
        F[chosen // 3], F[t // 3] = np.stack([c, a, d], 1), np.stack([b, c, d], 1)
        keep = np.ones(len(F), bool)
        keep[dropped] = False
        F = F[keep]
    return F, found


def _flat(V: Floats, F: Ints, height: float) -> tuple[Bools, Ints]:
    """Tell which faces are flat, and give each face's longest side."""
    sides = np.stack([np.linalg.norm(V[F[:, (k + 1) % 3]] - V[F[:, k]], axis=1) for k in range(3)], 1)
    longest = sides.argmax(axis=1)
    return np.linalg.norm(area_vectors(V, F), axis=1) <= height * sides.max(axis=1), longest


def _corner(F: Ints, h: Ints, k: int) -> Ints:
    """The corner k steps after the start of half-edges."""
    return F[h // 3, (h + k) % 3]


def _independent(V: Floats, F: Ints, h: Ints, twin: Ints, E: Ints, flat: Bools) -> Ints:
    """Give half-edges to flip at the same time: coherent, no face twice, no edge made that exists."""
    t = twin[h]
    fine = (t != h) & (_corner(F, h, 0) == _corner(F, t, 1))
    h, t = h[fine], t[fine]
    n = np.int64(len(V))
    c, d = _corner(F, h, 2), _corner(F, t, 2)
    key = np.minimum(c, d) * n + np.maximum(c, d)
    fine = (c != d) & ~np.isin(key, E[:, 0] * n + E[:, 1])
    # among flat neighbours the longest edge goes first, or two would swap for ever
    length = np.linalg.norm(V[_corner(F, h, 0)] - V[_corner(F, h, 1)], axis=1)
    order = np.flatnonzero(fine)[np.lexsort([flat[t[fine] // 3], -length[fine]])]
    h, t, key = h[order], t[order], key[order]
    rank = np.arange(len(h))
    best_face = np.full(len(F), len(h))
    np.minimum.at(best_face, h // 3, rank)
    np.minimum.at(best_face, t // 3, rank)
    _, first = np.unique(key, return_index=True)
    best_key = np.zeros(len(h), bool)
    best_key[first] = True
    return h[(best_face[h // 3] == rank) & (best_face[t // 3] == rank) & best_key]
