"""One edge of a tile: a curve with a knob, and where its neck and its head are."""

from functools import cached_property

import numpy as np

from meshjig.mesh.types import Floats, Ints

__all__ = ["Template"]


class Template:
    """A curve from (0, 0) to (1, 0) with one knob to its left.

    Parameters
    ----------
    points : (n, 2) float64, unit edge lengths
    """

    def __init__(self, points: Floats) -> None:
        self.points = points

    @cached_property
    def head(self) -> tuple[int, int]:
        """The points on either side of the head, where it is widest."""
        left, right = self._sides(0.25 * self.height)
        level = np.abs(self.points[left, None, 1] - self.points[None, right, 1]).argmin(1)
        k = int(np.argmax(self.points[right[level], 0] - self.points[left, 0]))
        return int(left[k]), int(right[level[k]])

    @cached_property
    def neck(self) -> tuple[int, int]:
        """The points on either side of the neck, where the knob is narrowest below its head."""
        left, right = np.arange(1, self.head[0]), np.arange(self.head[1] + 1, len(self.points) - 1)
        width = np.linalg.norm(self.points[left, None] - self.points[None, right], axis=2)
        i, j = np.unravel_index(int(width.argmin()), width.shape)
        return int(left[i]), int(right[j])

    @property
    def neck_width(self) -> float:
        """Width of the neck for an edge of length 1."""
        a, b = self.points[list(self.neck)]
        return float(np.linalg.norm(b - a))

    @property
    def height(self) -> float:
        """Height of the knob for an edge of length 1."""
        return float(self.points[:, 1].max())

    @property
    def reach(self) -> float:
        """How far the knob reaches along the edge from its middle, for an edge of length 1."""
        return float(np.abs(self.points[self.neck[0] : self.neck[1] + 1, 0] - 0.5).max())

    def _sides(self, above: float) -> tuple[Ints, Ints]:
        """Give the points higher than a level on the knob's left side and on its right."""
        high = np.flatnonzero(self.points[:, 1] > above)
        top = np.flatnonzero(self.points[:, 1] >= self.height - 1e-9)
        return high[high <= top[0]], high[high >= top[-1]]
