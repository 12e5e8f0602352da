"""Triangles that are all but lines: their planes mean nothing, and rounding turns them over."""

import numpy as np
from numpy.typing import NDArray

from meshjig.measure import area_vectors
from meshjig.topology import edge_keys, edges

__all__ = ["without_needles"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

_ROUNDS = 12


def without_needles(V: Floats, F: Ints, least: float) -> Ints:
    """Flip the longest side of triangles that are lower than a limit over it.

    The corner opposite lies all but on that side, so that the shape stays what it is. A flip that would
    make an edge twice, or triangles no higher, is left out.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, closed
    least : float, mm

    Returns
    -------
    F : (m, 3) int64, closed
    """
    for _ in range(_ROUNDS):
        height, longest = _heights(V, F)
        low = np.flatnonzero(height < least)
        if not len(low):
            break
        low = low[np.argsort(height[low], kind="stable")]
        e = edges(F)
        a, b, c = (F[low, (longest[low] + k) % 3] for k in range(3))
        across = e.twin[3 * low + longest[low]]
        other, d = across // 3, F[across // 3, (across + 2) % 3]
        faces, pair = np.stack([low, other], 1), np.stack([[a, d, c], [d, b, c]]).transpose(2, 0, 1)
        better = _heights(V, pair.reshape(-1, 3))[0].reshape(-1, 2).min(1) > height[faces].min(1)
        made = edge_keys(np.stack([c, d], 1), len(V))
        fit = better & (c != d) & ~np.isin(made, edge_keys(e.E, len(V)))
        chosen = np.flatnonzero(fit)[_first_of_their_faces(faces[fit], made[fit], len(F))]
        if not len(chosen):
            break
        F = F.copy()
        F[faces[chosen]] = pair[chosen]
    return F


def _heights(V: Floats, F: Ints) -> tuple[Floats, Ints]:
    """Give the height of triangles over their longest side, mm, and where that side starts."""
    side = np.linalg.norm(V[np.roll(F, -1, axis=1)] - V[F], axis=2)
    longest = side.argmax(1)
    top = np.maximum(side[np.arange(len(F)), longest], 1e-300)
    return np.linalg.norm(area_vectors(V, F), axis=1) / top, longest


def _first_of_their_faces(faces: Ints, made: Ints, n: int) -> Ints:
    """Pick rows, the first first, that share no face and no new edge with one before them."""
    rank = np.arange(len(faces))
    first = np.full(n, len(faces))
    np.minimum.at(first, faces.ravel(), np.repeat(rank, 2))
    new = np.zeros(len(faces), bool)
    new[np.unique(made, return_index=True)[1]] = True
    return np.flatnonzero((first[faces] == rank[:, None]).all(1) & new)
