"""One edge of a tile: a curve with a knob, and where its neck and its head are."""

from functools import cached_property

import numpy as np

from meshjig.types import Floats

__all__ = ["Template"]


class Template:
    """A curve from (0, 0) to (1, 0) with one knob to its left, symmetric about x = 1/2.

    Parameters
    ----------
    points : (n, 2) float64, unit edge lengths
    """

    def __init__(self, points: Floats) -> None:
        self.points = points

    @cached_property
    def head(self) -> tuple[int, int]:
        """The points on either side of the head, where it is widest."""
        left = self._left_of_knob()
        return self._pair(left[np.argmin(self.points[left, 0])])

    @cached_property
    def neck(self) -> tuple[int, int]:
        """The points on either side of the neck, where the knob is narrowest below its head."""
        below = np.arange(1, self.head[0])
        return self._pair(below[np.argmax(self.points[below, 0])])

    @property
    def neck_width(self) -> float:
        """Width of the neck for an edge of length 1."""
        return float(np.ptp(self.points[list(self.neck), 0]))

    @property
    def height(self) -> float:
        """Height of the knob for an edge of length 1."""
        return float(self.points[:, 1].max())

    def _left_of_knob(self) -> np.ndarray:
        top = int(np.argmax(self.points[:, 1]))
        rising = np.flatnonzero(self.points[: top + 1, 1] > 0.25 * self.height)
        return rising[self.points[rising, 0] <= 0.5]

    def _pair(self, left: np.intp) -> tuple[int, int]:
        return int(left), len(self.points) - 1 - int(left)
