"""Close cuts of flattened faces: draw both sides together, and see whether the result is a good chart."""

import numpy as np
from numpy.typing import NDArray

from meshjig.charts.flatten.flatten import border_is_simple, flat_share, is_unflipped, unit_stretch
from meshjig.charts.flatten.separate_border import part
from meshjig.charts.flatten.slim import slim
from meshjig.charts.flatten.untangle import untangle
from meshjig.mesh.components import is_disc
from meshjig.mesh.types import Floats, Ints

__all__ = ["glue"]

Complexes = NDArray[np.complex128]

_ITERATIONS = 3
_ROUNDS = 6
_MAY_GAIN = 0.012  # how much SLIM may add to the share of a first guess


def glue(
    V: Floats, F: Ints, before: Ints, after: Ints, place: Complexes, least_share: float
) -> tuple[tuple[Floats, Ints] | None, float]:
    """Flatten faces anew after some of their cuts were closed, from how they lay before.

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
    uv = unit_stretch(X, after, part(X, after, uv, _ROUNDS))
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
