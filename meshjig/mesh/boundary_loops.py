"""The rim of a chart, in order."""

import numpy as np

from meshjig.mesh.arrays import Ints
from meshjig.mesh.halfedges import border_halfedges, next_halfedge

__all__ = ["border_loop", "longest_loop"]


def border_loop(F: Ints) -> Ints:
    """Give the longest border loop of a mesh, its faces on the left.

    Parameters
    ----------
    F : (m, 3) int64, manifold; a vertex lies on one border at most

    Returns
    -------
    (b,) int64, vertices in order, the first not repeated; empty on a closed mesh
    """
    rim = border_halfedges(F)
    return longest_loop(F.ravel()[rim], F.ravel()[next_halfedge(rim)])


def longest_loop(start: Ints, end: Ints) -> Ints:
    """Follow edges from start (k,) to end (k,), and give the vertices of the longest loop, (b,)."""
    follows = dict(zip(start.tolist(), end.tolist(), strict=True))
    longest: list[int] = []
    while follows:
        at, after = follows.popitem()
        loop = [at]
        while after in follows:
            loop.append(after)
            after = follows.pop(after)
        longest = max(longest, loop, key=len)
    return np.array(longest, np.int64)
