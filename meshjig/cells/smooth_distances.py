"""Smooth squared distances, so that lines along which two of them are equal are smooth."""

from typing import Any

import numpy as np

from meshjig.cells.surface import Surface
from meshjig.mesh.types import Floats, Ints

__all__ = ["softened"]

_KEPT = 5  # sources of a vertex that are smoothed: those of the cells that can meet there
_REACH = 0.1  # spacings over which it averages
_ROUNDS = (2, 12)
_ACROSS = 1e-3  # the weight of an edge from a crease to beside it


def softened(s: Surface, near: tuple[Ints, Floats], spacing: float) -> tuple[Ints, Floats]:
    """Average squared distances over a small part of the spacing.

    Shortest paths over edges waver with the triangles. In the plane, the average of a squared distance
    is the squared distance plus the same amount everywhere, so differences keep their place while the
    wavering goes.

    Parameters
    ----------
    s : Surface
    near : the sources near each vertex, (n, k), and their distances, mm; nearest first
    spacing : float, mm

    Returns
    -------
    source : (n, 5) int64, -1 where there are fewer
    distance : (n, 5) float64, mm; infinite there
    """
    from scipy.sparse import csr_matrix

    source = near[0][:, :_KEPT]
    known = source >= 0
    squared = near[1][:, :_KEPT][known] ** 2
    rows, columns = np.nonzero(known)[0], source[known]
    shape = (len(source), int(source.max(initial=0)) + 1)
    value, mask = (csr_matrix((x, (rows, columns)), shape) for x in (squared, np.ones(len(rows))))
    average = _averaging(s)
    edge = float(np.sqrt(4 / np.sqrt(3) * s.area.sum() / len(s.F)))  # of even triangles
    rounds = int(np.clip(round(2 * (_REACH * spacing / edge) ** 2), *_ROUNDS))
    weight = (average @ mask).multiply(mask)
    for _ in range(rounds):
        value = (average @ value).multiply(mask).multiply(weight.power(-1)).tocsr()
    distance = np.full(source.shape, np.inf)
    distance[known] = np.sqrt(np.maximum(np.asarray(value[rows, columns]).ravel(), 0.0))
    return source, distance


def _averaging(s: Surface) -> Any:
    """Give the matrix that averages a value over neighbours, but not over creases, (n, n)."""
    from scipy.sparse import diags, identity

    W = s.weight.copy()
    if s.steep.any():
        rows = np.repeat(np.arange(W.shape[0]), np.diff(W.indptr))
        W.data[s.steep[rows] != s.steep[W.indices]] = _ACROSS
    return ((identity(W.shape[0]) + diags(1 / np.asarray(W.sum(1)).ravel()) @ W) / 2).tocsr()
