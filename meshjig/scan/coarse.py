"""Coordinates so far from the origin that their file's numbers can't tell neighbouring vertices apart."""

from __future__ import annotations

import numpy as np

from meshjig.errors import InputError
from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.halfedges import edges
from meshjig.mesh.measure import edge_lengths

__all__ = ["refuse_coarse"]

_STEP = 0.1  # of the median edge: numbers that go up in larger steps make a grid of the surface
_FAR = 16.0  # extents from the origin, from which on it is the offset that costs the digits
_DIGITS = 6  # what text files hold, where few are written


def refuse_coarse(V: Floats, F: Ints, name: str) -> None:
    """Refuse a mesh whose vertices lie on the grid that its numbers leave.

    So are surveys in national coordinates in 32 bits, or with six digits: millions of metres from the origin
    their numbers go up in steps of half a metre.

    Parameters
    ----------
    V : (n, 3) float64
    F : (m, 3) int64
    name : str, of the mesh

    Raises
    ------
    InputError
        The sentence says how coarse the numbers are, and what to do.
    """
    is_used = np.zeros(len(V), bool)
    is_used[F] = True
    used = V[is_used]
    low, high = used.min(0), used.max(0)
    far = np.maximum(np.abs(low), np.abs(high))
    extent = float((high - low).max())
    if far.max() < _FAR * extent or extent == 0:
        return
    length = edge_lengths(V, edges(F).E)
    edge = float(np.median(length[length > 0]))
    worst = 0.0
    for steps, rounded, words in (
        (np.spacing(far.astype(np.float32)).astype(np.float64), _float32, "32-bit numbers"),
        (10.0 ** (np.floor(np.log10(np.maximum(far, 1e-300))) + 1 - _DIGITS), _six_digits, "six digits"),
    ):
        for axis in np.flatnonzero((steps > max(worst, _STEP * edge)) & (far >= _FAR * extent)):
            if (rounded(used[:, axis]) == used[:, axis]).all():
                worst = float(steps[axis])
                told = f"around {'xyz'[axis]} = {used[:, axis].mean():.7g} {words}"
    if worst:
        raise InputError(
            f"the numbers of {name} are too coarse: {told} go up in steps of {worst:.3g}, "
            f"and half of the edges are shorter than {edge:.3g}",
            hint="subtract an offset before the export, so that the model is near the origin, "
            "or export with more digits",
        )


def _float32(x: Floats) -> Floats:
    return x.astype(np.float32).astype(np.float64)


def _six_digits(x: Floats) -> Floats:
    size = 10.0 ** (np.floor(np.log10(np.maximum(np.abs(x), 1e-300))) + 1 - _DIGITS)
    rounded = np.round(x / size) * size
    return np.where(np.abs(rounded - x) <= 1e-9 * np.abs(x), x, rounded)
