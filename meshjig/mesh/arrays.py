"""Lists of different lengths in one array, and who is connected with whom."""

from typing import TypeVar

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

__all__ = [
    "Bools",
    "Floats",
    "Ints",
    "connected",
    "equal_pairs",
    "next_in_loop",
    "ragged",
    "ranks",
    "row_of",
    "starts",
]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]
Numbers = TypeVar("Numbers", NDArray[np.int64], NDArray[np.float64])


def starts(sizes: Numbers) -> Numbers:
    """Give where each of several lists, or stretches, begins when they stand one after the other, (k,)."""
    return np.cumsum(sizes) - sizes


def row_of(sizes: Ints) -> Ints:
    """Give the list that each entry is in, for lists of these sizes one after the other, (sum,)."""
    return np.repeat(np.arange(len(sizes)), sizes)


def ranks(sizes: Ints) -> Ints:
    """Count from 0 within each of several lists, for lists one after the other, (sum,)."""
    return np.arange(int(np.sum(sizes))) - np.repeat(starts(sizes), sizes)


def ragged(first: Ints, sizes: Ints) -> Ints:
    """Count up from a first number in each of several lists, (sum,).

    >>> ragged(np.array([5, 20]), np.array([3, 2])).tolist()
    [5, 6, 7, 20, 21]
    """
    return np.arange(int(np.sum(sizes))) + np.repeat(first - starts(sizes), sizes)


def connected(n: int, a: Ints, b: Ints) -> tuple[int, Ints]:
    """Label n things that links between them connect, directly or through others.

    Parameters
    ----------
    n : int
    a, b : (k,) int64, the ends of each link

    Returns
    -------
    count : int
    label : (n,) int64, 0 to count - 1, in the order of the first thing of each component
    """
    graph = coo_matrix((np.ones(len(a), np.int8), (a, b)), shape=(n, n))
    count, label = connected_components(graph, directed=False)
    return int(count), label.astype(np.int64)


def next_in_loop(sizes: Ints) -> Ints:
    """Give the place after each one in several closed lists, one after the other, (sum,).

    >>> next_in_loop(np.array([3, 2])).tolist()
    [1, 2, 0, 4, 3]
    """
    after = np.arange(1, int(np.sum(sizes)) + 1)
    some = sizes > 0
    first = starts(sizes)[some]
    after[first + sizes[some] - 1] = first
    return after


def equal_pairs(a: Ints, b: Ints) -> tuple[Ints, Ints]:
    """List all pairs (i, j) with a[i] equal to b[j], by i, then by j."""
    order = np.argsort(b, kind="stable")
    ordered = b[order]
    first = np.searchsorted(ordered, a)
    count = np.searchsorted(ordered, a, side="right") - first
    return row_of(count), order[ragged(first, count)]
