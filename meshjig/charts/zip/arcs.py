"""Stretches along which two curves in the plane are nearly one, when one of them is moved."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from meshjig.mesh.types import Floats, Ints

__all__ = ["Fit", "fits"]

Complexes = NDArray[np.complex128]

_SHARES = (1.0, 0.75, 0.5, 0.35, 0.25, 0.15)  # of the whole, that a stretch may be
_MISFIT_COST = 10.0  # a misfit of a tenth of its length leaves a stretch a third of its worth


class Fit(NamedTuple):
    """A stretch, and the rigid motion z -> turn z + shift that brings the second curve onto the first."""

    begin: int
    end: int
    turn: complex
    shift: complex
    worth: float  # mm


def fits(first: Complexes, second: Complexes, length: Floats, least: float) -> list[Fit]:
    """Fit stretches of two curves to each other.

    The longer a stretch and the better it fits, the more it is worth: what does not fit must be
    bent, and bending stretches.

    Parameters
    ----------
    first, second : (k,) complex128, mm, points of the curves that belong together, in order
    length : (k,) float64, mm, how much of the curve a point stands for
    least : float, mm, length of the shortest stretch

    Returns
    -------
    list of Fit
    """
    begin, end = _windows(length, least)
    if not len(begin):
        return []

    def means(x: Complexes | Floats) -> Complexes:
        sums = np.append(0, np.cumsum(length * x))
        return (sums[end] - sums[begin]) / weight

    at = np.append(0, np.cumsum(length))
    weight = at[end] - at[begin]
    a, b = means(first), means(second)
    cross = means(first * second.conj()) - a * b.conj()
    spread = means(abs(first) ** 2 + abs(second) ** 2).real - abs(a) ** 2 - abs(b) ** 2
    misfit = np.sqrt(np.maximum(spread - 2 * abs(cross), 0))
    turn = np.where(abs(cross) > 0, cross / np.maximum(abs(cross), 1e-300), 1)
    worth = weight * np.exp(-_MISFIT_COST * misfit / weight)
    rows = zip(begin, end, turn, a - turn * b, worth, strict=True)
    return [Fit(int(i), int(j), complex(t), complex(s), float(w)) for i, j, t, s, w in rows]


def _windows(length: Floats, least: float) -> tuple[Ints, Ints]:
    """List where stretches begin and end, each overlapping the next by half."""
    at = np.append(0, np.cumsum(length))
    begin, end = [np.zeros(0, np.int64)], [np.zeros(0, np.int64)]
    for share in _SHARES:
        if share * at[-1] < least:
            break
        offset = np.linspace(0, 1 - share, max(round(2 / share) - 1, 1)) - 1e-9
        begin.append(np.searchsorted(at, offset * at[-1]))
        end.append(np.searchsorted(at, (offset + share) * at[-1]))
    i, j = np.concatenate(begin), np.concatenate(end)
    return i[j > i + 1], j[j > i + 1]
