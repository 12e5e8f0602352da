"""Find what may meet, by a uniform grid of cells over the plane."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from meshjig.mesh.arrays import equal_pairs, ranks, row_of
from meshjig.mesh.types import Bools, Ints

__all__ = ["Boxes", "Cells", "box_pairs", "boxes", "make_cells", "near"]

SMALL = 500_000  # boxes may always cover this many cells
MOST = 12  # and this many each, else the cells are made larger


class Boxes(NamedTuple):
    """The cells that items cover: from low to high, both included."""

    low: Ints  # (n, 2)
    high: Ints  # (n, 2)

    def take(self, items: Ints) -> "Boxes":
        """Give the boxes of some items."""
        return Boxes(self.low[items], self.high[items])


class Cells(NamedTuple):
    """Square cells over the plane, and how many of them an outline may touch."""

    size: int  # in grid steps
    shape: tuple[int, int]
    covered: NDArray[np.int32]  # (ny + 1, nx + 1), covered cells below and left of every corner


def boxes(cells_or_size: int, *corners: Ints) -> Boxes:
    """Give the boxes around corners (n, 2), one array for each corner of the items."""
    low = high = corners[0] // cells_or_size
    for other in corners[1:]:
        c = other // cells_or_size
        low, high = np.minimum(low, c), np.maximum(high, c)
    return Boxes(low, high)


def make_cells(U: Ints, S: Ints, a: Ints, b: Ints) -> tuple[Cells, Boxes]:
    """Choose cells of half a typical mesh edge, and mark those near segments ab.

    Parameters
    ----------
    U : (k, 2) int64
    S : (s, 2) int64, sides of the mesh in U
    a, b : (n, 2) int64, ends of segments

    Returns
    -------
    cells : Cells
    around : Boxes, of the segments
    """
    some = S[:: max(1, len(S) // 20000)]
    typical = float(np.abs(U[some[:, 0]] - U[some[:, 1]]).max(axis=1).mean())
    top = np.maximum(U.max(axis=0), np.maximum(a, b).max(axis=0, initial=0))
    size = int(max(typical / 2, top.max() / 4000, 1))
    while True:
        around = boxes(size, a, b)
        if _area(around).sum() < SMALL + MOST * len(a):
            break
        size *= 2
    nx, ny = (int(n) for n in top // size + 1)
    mark = np.zeros(nx * ny, np.int32)
    mark[_spread(around, nx)[1]] = 1
    covered = np.zeros((ny + 1, nx + 1), np.int32)
    covered[1:, 1:] = mark.reshape(ny, nx).cumsum(axis=0).cumsum(axis=1)
    return Cells(size, (nx, ny), covered), around


def near(cells: Cells, around: Boxes) -> Bools:
    """Tell which boxes touch a marked cell, (n,)."""
    stride = cells.shape[0] + 1
    flat = cells.covered.ravel()
    left, right = around.low[:, 0], around.high[:, 0] + 1
    below, above = around.low[:, 1] * stride, (around.high[:, 1] + 1) * stride
    return (flat[above + right] - flat[above + left] - flat[below + right] + flat[below + left]) > 0


def box_pairs(A: Boxes, B: Boxes) -> tuple[Ints, Ints]:
    """List all pairs of boxes that share a cell, each once.

    Returns
    -------
    a, b : (p,) int64, numbers of boxes
    """
    while _area(A).sum() + _area(B).sum() > SMALL + MOST * (len(A.low) + len(B.low)):
        A, B = _coarser(A), _coarser(B)
    nx = int(max(A.high[:, 0].max(initial=0), B.high[:, 0].max(initial=0))) + 1
    a, cell_a = _spread(A, nx)
    b, cell_b = _spread(B, nx)
    i, j = equal_pairs(cell_a, cell_b)
    a, b, cell = a[i], b[j], cell_a[i]
    # a pair is listed in the cell at the low corner of what both cover
    corner = np.maximum(A.low[a, 0], B.low[b, 0]) + np.maximum(A.low[a, 1], B.low[b, 1]) * nx
    once = corner == cell
    return a[once], b[once]


def _coarser(around: Boxes) -> Boxes:
    return Boxes(around.low >> 1, around.high >> 1)


def _area(around: Boxes) -> Ints:
    return np.prod(around.high - around.low + 1, axis=1)


def _spread(around: Boxes, nx: int) -> tuple[Ints, Ints]:
    """List (item, cell) for all cells of all boxes."""
    width = around.high[:, 0] - around.low[:, 0] + 1
    count = _area(around)
    item, k = row_of(count), ranks(count)
    row = k // width[item]
    corner = around.low[:, 0] + around.low[:, 1] * nx
    return item, corner[item] + k - row * width[item] + row * nx
