"""The rectangular knob: a square-shouldered dovetail."""

from itertools import pairwise

import numpy as np

from meshjig.tiling.template import Template

__all__ = ["rectangular"]

_CORNERS = np.array([(0, 0), (0.435, 0), (0.375, 0.2), (0.625, 0.2), (0.565, 0), (1, 0)], dtype=np.float64)


def rectangular(n: int) -> Template:
    """Draw one edge of a tile from (0, 0) to (1, 0) with a dovetail to its left.

    Parameters
    ----------
    n : int, points a side; the edge has 5 n segments

    Returns
    -------
    Template
        Neck 0.13, head 0.25, height 0.20 of the edge.
    """
    t = np.linspace(0, 1, n, endpoint=False)[:, None]
    sides = [a + (b - a) * t for a, b in pairwise(_CORNERS)]
    return Template(np.vstack([*sides, _CORNERS[-1:]]))
