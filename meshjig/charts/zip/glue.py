"""How the two sides of a cut fit together, and whether closing it makes a good chart."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from meshjig.charts.distortion import border_is_simple, flat_share, is_unflipped, unit_stretch
from meshjig.charts.flatten.isometry import slim
from meshjig.charts.flatten.untangle import separate_border, untangle
from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.components import is_disc

__all__ = ["Fit", "fits", "glue"]

Complexes = NDArray[np.complex128]

_SHARES = (1.0, 0.75, 0.5, 0.35, 0.25, 0.15)  # of the whole, that a stretch may be
_MISFIT_COST = 10.0  # a misfit of a tenth of its length leaves a stretch a third of its worth
_ITERATIONS = 3  # of SLIM
_ROUNDS = 6  # of drawing borders apart
_MAY_GAIN = 0.012  # how much SLIM may add to the share of a first guess


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


def glue(
    V: Floats, F: Ints, before: Ints, after: Ints, place: Complexes, least_share: float
) -> tuple[tuple[Floats, Ints] | None, float]:
    """Flatten faces again after some of their cuts were closed, from how they lay before.

    The two sides of a closed cut meet in their middle and drag the rest along: a harmonic
    displacement. It comes so near the best map that it tells most bad charts by itself.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (k, 3) int64
    before, after : (k, 3) int64, corners of the faces with the cuts open and closed, from 0
    place : (k, 3) complex128, mm, where the corners lie
    least_share : float, of the area that must lie within FLAT_LIMITS

    Returns
    -------
    made : (uv (n', 2) float64, mm, corners (k, 3) int64 into uv), or None where it is no good chart: a disc
        without mirrored faces and with a simple border
    effort : float, about how many faces SLIM flattens in the same time
    """
    if not is_disc(after):
        return None, 0.2 * len(F)
    X = np.empty((int(after.max()) + 1, 3))
    X[after] = V[F]
    uv = untangle(X, after, _drawn_together(V, F, before, after, place))
    if not is_unflipped(uv, after):
        return None, 0.5 * len(F)
    uv = unit_stretch(X, after, uv)
    share = flat_share(X, after, uv)
    if share < least_share - _MAY_GAIN:
        return None, 0.3 * len(F)
    if share >= least_share and border_is_simple(uv, after):
        return (uv, after), 0.3 * len(F)
    uv = unit_stretch(X, after, slim(X, after, uv, _ITERATIONS))
    if flat_share(X, after, uv) < least_share:
        return None, 1.0 * len(F)
    uv = unit_stretch(X, after, separate_border(X, after, uv, _ROUNDS))
    good = is_unflipped(uv, after) and flat_share(X, after, uv) >= least_share and border_is_simple(uv, after)
    return ((uv, after) if good else None), 1.2 * len(F)


def _drawn_together(V: Floats, F: Ints, before: Ints, after: Ints, place: Complexes) -> Floats:
    """Move both sides of the closed cuts to their middle, and everything else along."""
    import igl
    from scipy.sparse.linalg import splu

    n, k = int(after.max()) + 1, int(before.max()) + 1
    X, z, target = np.empty((k, 3)), np.empty(k, np.complex128), np.empty(k, np.int64)
    X[before], z[before], target[before] = V[F], place, after
    sides = np.bincount(target, minlength=n)
    middle = (np.bincount(target, z.real, n) + 1j * np.bincount(target, z.imag, n)) / sides
    held = sides[target] > 1
    move = middle[target[held]] - z[held]
    z[held] += move
    if not held.all():
        L = igl.cotmatrix(X, before).tocsr()[~held]
        solver = splu(L[:, ~held].tocsc(), permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True})
        drag = solver.solve(-(L[:, held] @ np.stack([move.real, move.imag], 1)))
        z[~held] += drag[:, 0] + 1j * drag[:, 1]
    uv = np.empty((n, 2))
    uv[target] = np.stack([z.real, z.imag], 1)
    return uv
