"""Edges that interlock, for the symmetry that a tiling asks of them."""

from collections.abc import Callable

import numpy as np

from meshjig.mesh.arrays import Floats
from meshjig.tiling.template import Template, classic, enlarged, leaning, moved_knob

__all__ = ["EDGE_SHAPES", "neck_width", "with_symmetry"]

_POINTS = 8  # a part of a knob
_ALIKE = 0.02  # of an edge, within which a curve counts as symmetric
_HALF = 2.2  # as large as a knob may be on half an edge


def _straight(_: float) -> Floats:
    return np.array([(0.0, 0.0), (1.0, 0.0)])


def _knob(size: float) -> Floats:
    return enlarged(classic(_POINTS), size).points


def _leaning_knob(size: float) -> Floats:
    return enlarged(leaning(_POINTS), size).points


def _knob_and_socket(size: float) -> Floats:
    """Draw a knob on the first half, and the same turned by a half turn about the middle."""
    half = _half_knob(size) / 2
    return np.vstack([half, (1, 0) - half[-2::-1]])


def _half_knob(size: float) -> Floats:
    return moved_knob(classic(_POINTS).points, min(2 * size, _HALF), 0.55)


def neck_width(letter: str, size: float) -> float:
    """Measure the narrowest neck of an edge from (0, 0) to (1, 0); no neck is as wide as any.

    Parameters
    ----------
    letter : str, a key of `EDGE_SHAPES`
    size : float, its argument
    """
    if letter == "I":
        return np.inf
    if letter == "S":
        return Template(_half_knob(size)).neck_width / 2
    return Template(EDGE_SHAPES[letter](size)).neck_width


EDGE_SHAPES: dict[str, Callable[[float], Floats]] = {
    "J": _leaning_knob,  # free
    "U": _knob,  # a mirror image of itself
    "S": _knob_and_socket,  # turned by a half turn, itself
    "I": _straight,  # both
}
"""A curve from (0, 0) to (1, 0), (n, 2), by the letter of its symmetry; its argument scales the knobs."""


def with_symmetry(curve: Floats, letter: str) -> Floats:
    """Give an edge the symmetry that a tiling asks of it; one that has it stays as it is.

    Parameters
    ----------
    curve : (n, 2) float64, from (0, 0) to (1, 0)
    letter : str, a key of `EDGE_SHAPES`

    Returns
    -------
    (k, 2) float64, from (0, 0) to (1, 0)
        Otherwise the curve on either half: mirrored, or turned by a half turn; or straight.
    """
    import shapely

    if letter == "J":
        return curve
    if letter == "I":
        return _straight(1.0)
    back = (1, 0) + curve[::-1] * ((-1, 1) if letter == "U" else (-1, -1))
    if shapely.hausdorff_distance(shapely.LineString(curve), shapely.LineString(back)) < _ALIKE:
        return curve
    half = curve / 2
    return np.vstack([half, (1, 0) + half[-2::-1] * ((-1, 1) if letter == "U" else (-1, -1))])
