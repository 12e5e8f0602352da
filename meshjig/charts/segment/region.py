"""Parts of one mesh, looked at again and again: is it a disc, and what is its rim."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from meshjig.mesh.halfedges import edges, next_halfedge

__all__ = ["Region", "Regions", "single_loop"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


class Region(NamedTuple):
    """A disc cut out of a mesh."""

    F: Ints  # (m, 3), into kept
    kept: Ints  # (n,), the mesh's vertices
    loop: Ints  # (b,), into kept: the rim in order, faces on the left


class Regions:
    """Answers what discs faces of one mesh make, at the cost of these faces only.

    Parameters
    ----------
    F : (m, 3) int64, manifold
    """

    def __init__(self, F: Ints) -> None:
        self._F = F
        self._across = edges(F).twin // 3
        h = np.arange(3 * len(F))
        self._across[edges(F).twin == h] = -1
        self._end = F.ravel()[next_halfedge(h)]
        self._inside = np.zeros(len(F) + 1, bool)  # the last stands for what is beyond a border
        self._used = np.zeros(int(F.max(initial=-1)) + 1, bool)
        self._number = np.empty(len(self._used), np.int64)

    def disc(self, faces: Ints) -> Region | None:
        """Give faces (k,) as a disc; None where they are none."""
        self._inside[faces] = True
        h = (3 * faces[:, None] + np.arange(3)).ravel()
        rim = h[~self._inside[self._across[h]]]
        self._inside[faces] = False
        start, end = self._F.ravel()[rim], self._end[rim]
        corners = self._F[faces]
        self._used[corners.ravel()] = True
        kept = np.flatnonzero(self._used)
        self._used[kept] = False
        n_edges = (len(h) + len(rim)) // 2
        if len(kept) - n_edges + len(faces) != 1:
            return None
        self._number[kept] = np.arange(len(kept))
        loop = single_loop(self._number[start], self._number[end])
        return None if loop is None else Region(self._number[corners], kept, loop)


def single_loop(start: Ints, end: Ints) -> Ints | None:
    """Order the edges of a rim; None where they make no single loop without pinches."""
    follows = dict(zip(start.tolist(), end.tolist(), strict=True))
    if len(follows) != len(start) or not follows:
        return None
    first = at = next(iter(follows))
    loop = [first]
    while (at := follows[at]) != first:
        loop.append(at)
        if len(loop) > len(start):
            return None
    return np.array(loop, np.int64) if len(loop) == len(start) else None
