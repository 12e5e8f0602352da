"""Text as outlines that can be printed: one pen's width everywhere, room between strokes."""

from __future__ import annotations

from typing import Any

import numpy as np

from meshjig.errors import OptionError
from meshjig.mesh.arrays import Floats

__all__ = ["GLYPHS", "reads_both_ways", "strokes", "text_outline"]

_SPACE = 0.45  # of the height: the width of a blank
_LETTER_GAP = 1.0  # pen's widths left between two letters
_SMOOTH = 0.04  # pen's widths by which an outline may be simplified
_QUARTER = 3  # segments a quarter of a round end
_TURNED = str.maketrans("0689", "0986")
_ROUNDS = 2  # of corner cutting; 4 points a control point
_UNIT = 10.0  # height of a capital in the table
# Control points of quadratic B-splines: a doubled point is a corner, equal ends close a stroke. x to the
# right, y up, the baseline at 0.
GLYPHS: dict[str, tuple[str, ...]] = {
    "0": ("0,0 6,0 6,5 6,10 0,10 0,5 0,0",),
    "1": ("1,7.8 3.2,10 3.2,10 3.2,0", "1,0 5.4,0"),
    "2": ("0,7.2 0,10 6,10 6,6.2 0,0 0,0 6,0",),
    "3": ("0.4,8.4 0.8,10 5.8,10 5.8,5.4 2.2,5.4", "2.2,5.4 6.3,5.4 6.3,0 0.4,0 0,1.8"),
    "4": ("4.4,0 4.4,10 4.4,10 0,3 0,3 6,3",),
    "5": ("5.4,10 0.9,10 0.9,10 0.5,5.4 0.5,5.4 2,6.5 6.1,6.8 6.1,0 0.6,0 0,1.6",),
    "6": ("0,0 6,0 6,6.2 0,6.2 0,0", "0,3.1 0,9 5,10"),
    "7": ("0,10 6,10 6,10 2,0",),
    "8": ("0.4,5.3 5.6,5.3 5.6,10 0.4,10 0.4,5.3", "0,0 6,0 6,5.4 0,5.4 0,0"),
    "9": ("6,10 0,10 0,3.8 6,3.8 6,10", "6,6.9 6,1 1,0"),
    "A": ("0,0 3,10 3,10 6,0", "1,3.3 5,3.3"),
    "B": ("0,0 0,10 0,10 5.4,10 5.4,5.4 0,5.4", "0,5.4 6.2,5.4 6.2,0 0,0"),
    "C": ("6,8 5,10 0,10 0,5 0,0 5,0 6,2",),
    "D": ("0,0 0,10 0,10 6,10 6,5 6,0 0,0 0,0",),
    "E": ("5.4,10 0,10 0,10 0,0 0,0 5.4,0", "0,5.3 4.4,5.3"),
    "F": ("5.4,10 0,10 0,10 0,0", "0,5.3 4.4,5.3"),
    "G": ("6,8 5,10 0,10 0,5 0,0 6,0 6,4.6 6,4.6 3.6,4.6",),
    "H": ("0,0 0,10", "6,0 6,10", "0,5.3 6,5.3"),
    "I": ("1,10 5,10", "3,10 3,0", "1,0 5,0"),
    "J": ("5,10 5,0 0,0 0,2.6",),
    "K": ("0,0 0,10", "5.6,10 0,4.4", "2,6.2 6,0"),
    "L": ("0,10 0,0 0,0 5.4,0",),
    "M": ("0,0 0,10 0,10 3.4,4 3.4,4 6.8,10 6.8,10 6.8,0",),
    "N": ("0,0 0,10 0,10 6,0 6,0 6,10",),
    "O": ("0,0 7,0 7,5 7,10 0,10 0,5 0,0",),
    "P": ("0,0 0,10 0,10 6,10 6,4.6 0,4.6",),
    "Q": ("0,0 7,0 7,5 7,10 0,10 0,5 0,0", "4,3 7,0"),
    "R": ("0,0 0,10 0,10 6,10 6,4.8 0,4.8", "2.6,4.8 6,0"),
    "S": ("5.6,8.2 5,10 0,10 0,5.2 6,5.4 6,0 0.6,0 0,1.8",),
    "T": ("0,10 6.4,10", "3.2,10 3.2,0"),
    "U": ("0,10 0,0 6,0 6,10",),
    "V": ("0,10 3,0 3,0 6,10",),
    "W": ("0,10 1.8,0 1.8,0 4,7 4,7 6.2,0 6.2,0 8,10",),
    "X": ("0,0 6,10", "0,10 6,0"),
    "Y": ("0,10 3.2,5 3.2,5 6.4,10", "3.2,5 3.2,0"),
    "Z": ("0,10 6,10 6,10 0,0 0,0 6,0",),
    ".": ("0,0 0.01,0",),
    "-": ("0,4.6 3.6,4.6",),
    " ": (),
}


def text_outline(text: str, height: float, stroke: float) -> Any:
    """Write a line of text with a round pen.

    A text that reads as another one when turned upside down, such as 6 or 89, is underlined.

    Parameters
    ----------
    text : str
        Digits, letters, blanks, full stops and hyphens; small letters are written as capitals.
    height : float, mm, of a capital from edge to edge
    stroke : float, mm, width of the pen; less than a third of the height

    Returns
    -------
    shapely.Polygon or MultiPolygon, mm
        The middle of its bounding box is at 0, 0; without area for a text of blanks.

    Raises
    ------
    OptionError
        A character that can't be written, or a pen that is too broad.
    """
    import shapely

    if not 0 < 3 * stroke < height:
        raise OptionError(
            f"strokes of {stroke:g} mm can't be told apart in text {height:g} mm high",
            hint="take text more than three strokes high",
        )
    lines, x = [], 0.0
    for character in text.upper():
        if character not in GLYPHS:
            raise OptionError(
                f"{character!r} can't be engraved", hint="use digits, letters, blanks, full stops and hyphens"
            )
        own = [(height - stroke) * line for line in strokes(character)]
        if not own:
            x += _SPACE * height
            continue
        across = np.concatenate(own)[:, 0]
        lines += [line + np.array([x - across.min(), 0.0]) for line in own]
        x += np.ptp(across) + (1 + _LETTER_GAP) * stroke
    if lines and reads_both_ways(text):
        lines.append(np.array([[0.0, -2 * stroke], [x - (1 + _LETTER_GAP) * stroke, -2 * stroke]]))
    drawn = shapely.MultiLineString(lines)
    shape = drawn.buffer(stroke / 2, quad_segs=_QUARTER).simplify(_SMOOTH * stroke)
    if shape.is_empty:
        return shape
    low_x, low_y, high_x, high_y = shape.bounds
    return shapely.transform(shape, lambda xy: xy - [(low_x + high_x) / 2, (low_y + high_y) / 2])


def reads_both_ways(text: str) -> bool:
    """Tell whether text turned upside down reads as some other text."""
    return set(text) <= set("0689") and text.translate(_TURNED)[::-1] != text


def strokes(character: str) -> list[Floats]:
    """Give the lines along which a pen writes a character of the table.

    Parameters
    ----------
    character : str, one of GLYPHS

    Returns
    -------
    list of (n, 2) float64
        A capital is 1 high; the baseline is y = 0.

    References
    ----------
    Chaikin, "An algorithm for high-speed curve generation", 1974.
    """
    return [_curve(stroke) / _UNIT for stroke in GLYPHS[character]]


def _curve(stroke: str) -> Floats:
    """Cut the corners of a control polygon until it is its B-spline; ends of an open one stay."""
    points = np.array([pair.split(",") for pair in stroke.split()], np.float64)
    closed = bool((points[0] == points[-1]).all())
    for _ in range(_ROUNDS):
        a, b = points[:-1], points[1:]
        cut = np.stack([0.75 * a + 0.25 * b, 0.25 * a + 0.75 * b], 1).reshape(-1, 2)
        points = np.concatenate([cut, cut[:1]] if closed else [points[:1], cut[1:-1], points[-1:]])
    return points
