"""Split regions of a mesh until each is as it should be."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from meshjig.charts.segment.dual_graph import dual
from meshjig.charts.segment.patches import patches
from meshjig.mesh.components import components
from meshjig.mesh.halfedges import compact

__all__ = ["split"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


def split(V: Floats, F: Ints, label: Ints, is_good: Callable[[Ints], bool], seed: int) -> Ints:
    """Take apart what does not hang together, and halve what is not good.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, manifold
    label : (m,) int64
    is_good : callable, tells whether faces (k,) hang together and may stay so; not asked about single ones
    seed : int

    Returns
    -------
    label : (m,) int64, 0 to k - 1
    """
    out = np.empty(len(F), np.int64)
    todo = [np.flatnonzero(label == k) for k in np.unique(label)]
    n = 0
    while todo:
        faces = todo.pop()
        if len(faces) == 1 or is_good(faces):
            out[faces] = n
            n += 1
            continue
        n_parts, part = components(F[faces])
        if n_parts == 1:
            G, kept = compact(F[faces])
            part = patches(dual(V[kept], G), 2, seed, rounds=4)
        todo += [faces[part == p] for p in range(int(part.max()) + 1)]
    return out
