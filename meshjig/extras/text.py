"""Text as outlines that can be printed: one pen's width everywhere, room between strokes."""

from __future__ import annotations

from typing import Any

import numpy as np

from meshjig.errors import OptionError
from meshjig.extras.glyphs import GLYPHS, strokes

__all__ = ["reads_both_ways", "text_outline"]

_SPACE = 0.45  # of the height: the width of a blank
_LETTER_GAP = 1.0  # pen's widths left between two letters
_SMOOTH = 0.04  # pen's widths by which an outline may be simplified
_QUARTER = 3  # segments a quarter of a round end
_TURNED = str.maketrans("0689", "0986")


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
