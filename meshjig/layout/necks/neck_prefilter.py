"""Which pieces could be narrow somewhere: a quick look along their borders."""

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints, connected, ranks, row_of
from meshjig.mesh.chains import summed_along
from meshjig.mesh.halfedges import Edges, next_halfedge
from meshjig.mesh.measure import sums

__all__ = ["could_have_necks"]

_STEP = 0.5  # widths between points of a border
_NEAR = 1.5  # widths between two points of a border where a piece may be narrow
_AROUND = 2.3  # widths of border between them at least: less of it holds no more than a square width


def could_have_necks(V: Floats, F: Ints, e: Edges, piece: Ints, width: float) -> Bools:
    """Tell which pieces have two places of their border near each other that are far apart along it.

    A piece that something hangs on by less than the width is always among them; so are those whose border
    is not one loop, and many others, such as those with a sharp corner.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64
    e : Edges, of F
    piece : (m,) int64, of every face, 0 and up
    width : float, mm

    Returns
    -------
    (p,) bool
    """
    from scipy.spatial import cKDTree

    narrow = np.zeros(int(piece.max(initial=-1)) + 1, bool)
    h = np.arange(len(e.twin))
    rim = np.flatnonzero((e.twin == h) | (piece[e.twin // 3] != np.repeat(piece, 3)))
    start, end, of = F.ravel()[rim], F.ravel()[next_halfedge(rim)], piece[rim // 3]
    following, pinched = _followers(of * len(V) + start, of * len(V) + end)
    narrow[of[pinched]] = True
    length = np.linalg.norm(V[end] - V[start], axis=1)
    loop, at, around = _places(following, length)
    narrow |= np.bincount(of[np.unique(loop, return_index=True)[1]], minlength=len(narrow)) > 1

    step = _STEP * width
    first = np.ceil(at / step)
    count = (np.ceil((at + length) / step) - first).astype(np.int64)
    row = row_of(count)
    place = (first[row] + ranks(count)) * step
    share = ((place - at[row]) / np.maximum(length[row], 1e-300))[:, None]
    points = V[start[row]] + share * (V[end[row]] - V[start[row]])
    points[:, 0] += of[row] * (2 * np.ptp(V[:, 0]) + 2 * _NEAR * width)  # every piece by itself
    a, b = cKDTree(points).query_pairs(_NEAR * width, output_type="ndarray").T
    apart = np.abs(place[a] - place[b])
    apart = np.minimum(apart, around[loop[row[a]]] - apart)
    narrow[of[row[a[apart > _AROUND * width]]]] = True
    return narrow


def _followers(start: Ints, end: Ints) -> tuple[Ints, Ints]:
    """Give what comes after each stretch, by names of where they start and end, (k,), and where two start."""
    order = np.argsort(start)
    ordered = start[order]
    return order[np.searchsorted(ordered, end)], order[1:][ordered[1:] == ordered[:-1]]


def _places(following: Ints, length: Floats) -> tuple[Ints, Floats, Floats]:
    """Order stretches along their loops.

    Returns
    -------
    loop : (k,) int64, of each stretch
    at : (k,) float64, mm along its loop where each starts
    around : (l,) float64, mm, the length of each loop
    """
    k, row = len(length), np.arange(len(length))
    n, loop = connected(k, row, following)
    around = sums(loop, length, n)
    begin = np.unique(loop, return_index=True)[1]
    last = np.isin(following, begin)
    left, after = summed_along(np.where(last, row, following), np.where(last, 0.0, length))
    return loop, around[loop] - left - length[after], around
