"""Keep vertices that differ from falling together when a file rounds them to float32."""

from __future__ import annotations

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.halfedges import edges
from meshjig.mesh.measure import unit

__all__ = ["separate_fans", "separate_inner"]

_APART = 1e-4  # mm; float32 resolves 1.5e-5 mm at 150 mm
_PINCH = 4e-3  # mm, how far the sides of a pinch move into the piece
_ROUNDS = 8


def separate_fans(X: Floats, F: Ints, owner: Ints) -> tuple[Floats, int]:
    """Move vertices of one piece that stand in one place into the fans they belong to.

    Such are the copies of a pinch vertex, and what a repair has split before.

    Parameters
    ----------
    X : (n, 3) float64, mm
    F : (m, 3) int64, every vertex one fan
    owner : (n,) int64, the piece

    Returns
    -------
    X : (n, 3) float64
    moved : int
    """
    again = _repeats(X, owner)
    if not again.any():
        return X, 0
    copy = again | _repeats(X[::-1], owner[::-1])[::-1]
    corner = np.flatnonzero(copy[F.ravel()])
    v = F.ravel()[corner]
    inward = X[F[corner // 3]].mean(1) - X[v]
    total = np.zeros_like(X)
    np.add.at(total, v, inward)
    reach = np.full(len(X), np.inf)
    np.minimum.at(reach, v, np.linalg.norm(inward, axis=1))
    move = np.minimum(_PINCH, 0.2 * reach[copy])[:, None] * unit(total[copy])
    X = X.copy()
    X[copy] += move
    return X, int(copy.sum())


def separate_inner(X: Floats, Y: Floats, F: Ints, owner: Ints) -> tuple[Floats, int]:
    """Move inner vertices that fall together with another vertex of their piece.

    Ends of a collapsed edge move apart along the outer edge; other coincidences are resolved by
    drawing one of the vertices towards its outer vertex.

    Parameters
    ----------
    X, Y : (n, 3) float64, mm, outer and inner vertices
    F : (m, 3) int64
    owner : (n,) int64, the piece

    Returns
    -------
    Y : (n, 3) float64
    moved : int
    """
    E = edges(F).E
    moved = np.zeros(len(X), bool)
    Y = Y.copy()
    for _ in range(_ROUNDS):
        short = np.linalg.norm(Y[E[:, 1]] - Y[E[:, 0]], axis=1) < _APART
        if not short.any():
            break
        a, b = E[short].T
        way = 0.75 * _APART * unit(X[b] - X[a])
        np.add.at(Y, a, -way)
        np.add.at(Y, b, way)
        moved[a] = moved[b] = True
    for k in range(_ROUNDS):
        twice = _repeats(np.concatenate([X, Y]), np.concatenate([owner, owner]))[len(X) :]
        if not twice.any():
            break
        Y[twice] += (k + 1) * _APART * unit(X[twice] - Y[twice])
        moved |= twice
    return Y, int(moved.sum())


def _repeats(points: Floats, owner: Ints) -> Bools:
    """Mark points that equal an earlier one of their piece in float32."""
    single = points.astype(np.float32) + np.float32(0)  # no negative zero
    bits = single.view(np.uint32).astype(np.uint64)
    mix = bits[:, 0] * np.uint64(0x9E3779B97F4A7C15)
    mix ^= bits[:, 1] * np.uint64(0xC2B2AE3D27D4EB4F) + (mix >> np.uint64(29))
    mix ^= bits[:, 2] * np.uint64(0x165667B19E3779F9) + (mix >> np.uint64(31))
    mix ^= owner.astype(np.uint64) * np.uint64(0x27D4EB2F165667C5)
    order = np.argsort(mix, kind="stable")
    same = mix[order[1:]] == mix[order[:-1]]
    again = np.zeros(len(points), bool)
    again[order[1:]] = same & (single[order[1:]] == single[order[:-1]]).all(1)
    return again
