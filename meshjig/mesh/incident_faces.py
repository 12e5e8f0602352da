"""The part of a mesh around some of its vertices."""

import numpy as np

from meshjig.mesh.types import Ints

__all__ = ["around"]


def around(F: Ints, vertices: Ints, n: int) -> Ints:
    """Give the faces (m, 3) that have one of some vertices, of n in all; (k,) int64, in order."""
    near = np.zeros(n, bool)
    near[vertices] = True
    return np.flatnonzero(near[F[:, 0]] | near[F[:, 1]] | near[F[:, 2]])
