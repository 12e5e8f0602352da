"""Exact answers about points and lines on the integer grid.

Every outline is shifted by (eps, eps^2) for an infinitely small eps: then no outline point lies on
a mesh edge, no mesh vertex on an outline, and every question has one of two answers.

References
----------
Edelsbrunner and Mücke, "Simulation of Simplicity", 1990.
"""

import numpy as np

from meshjig.mesh.arrays import starts
from meshjig.mesh.types import Bools, Ints

__all__ = ["angular_order", "orient", "point_left_of_edge", "vertex_left_of_segment"]


def orient(a: Ints, b: Ints, c: Ints) -> Ints:
    """Give twice the signed area of triangles abc, (n,); exact for coordinates below 2^30."""
    ab, ac = b - a, c - a
    return ab[..., 0] * ac[..., 1] - ab[..., 1] * ac[..., 0]


def point_left_of_edge(turn: Ints, p: Ints, q: Ints) -> Bools:
    """Tell whether shifted outline points lie left of mesh edges pq.

    Parameters
    ----------
    turn : (n,) int64, orient(p, q, point)
    p, q : (n, 2) int64; equal ends answer True
    """
    left = turn > 0
    zero = np.flatnonzero(turn == 0)
    if len(zero):
        d = q[zero] - p[zero]
        left[zero] = (d[:, 1] < 0) | ((d[:, 1] == 0) & (d[:, 0] >= 0))
    return left


def vertex_left_of_segment(turn: Ints, a: Ints, b: Ints) -> Bools:
    """Tell whether mesh vertices lie left of shifted outline segments ab.

    Parameters
    ----------
    turn : (n,) int64, orient(a, b, vertex)
    a, b : (n, 2) int64, different
    """
    left = turn > 0
    zero = np.flatnonzero(turn == 0)
    if len(zero):
        d = b[zero] - a[zero]
        left[zero] = (d[:, 1] > 0) | ((d[:, 1] == 0) & (d[:, 0] <= 0))
    return left


def angular_order(node: Ints, d: Ints) -> Ints:
    """Sort directions by node and, about each node, counter-clockwise from the +x axis.

    Parameters
    ----------
    node : (n,) int64
    d : (n, 2) int64, not zero

    Returns
    -------
    (n,) int64, the sorting permutation
    """
    order = np.argsort(node, kind="stable")
    count = np.bincount(node)
    start = starts(count)
    for degree in np.unique(count[count > 2]):  # two directions are in order either way
        rows = start[count == degree][:, None] + np.arange(degree)
        members = order[rows]
        x, y = d[members, 0], d[members, 1]
        lower = (y < 0) | ((y == 0) & (x < 0))
        cross = x[:, :, None] * y[:, None, :] - y[:, :, None] * x[:, None, :]
        index = np.arange(degree)
        after = (cross < 0) | ((cross == 0) & (index[None, :, None] > index[None, None, :]))
        half = lower[:, :, None] != lower[:, None, :]
        rank = np.where(half, lower[:, :, None], after).sum(2)
        order[np.take_along_axis(rows, rank, 1)] = members
    return order
