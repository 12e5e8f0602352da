"""One edge of a tile: a curve with a knob, and the knobs that there are."""

from functools import cached_property
from itertools import pairwise

import numpy as np

from meshjig.mesh.arrays import Floats, Ints

__all__ = ["Template", "along", "classic", "enlarged", "leaning", "moved_knob", "rectangular"]

_REACH = 0.2  # half of the part of an edge that is moved as a whole
_CLASSIC = np.array(
    [
        [(0.0, 0.0), (0.20, 0.00), (0.42, -0.05), (0.435, 0.02)],
        [(0.435, 0.02), (0.445, 0.065), (0.375, 0.085), (0.375, 0.175)],
        [(0.375, 0.175), (0.375, 0.305), (0.625, 0.305), (0.625, 0.175)],
        [(0.625, 0.175), (0.625, 0.085), (0.555, 0.065), (0.565, 0.02)],
        [(0.565, 0.02), (0.58, -0.05), (0.80, 0.00), (1.0, 0.0)],
    ]
)
_LEANING = np.array(
    [
        [(0.0, 0.0), (0.18, 0.00), (0.345, -0.06), (0.395, -0.01)],
        [(0.395, -0.01), (0.43, 0.035), (0.375, 0.085), (0.405, 0.17)],
        [(0.405, 0.17), (0.45, 0.335), (0.75, 0.28), (0.69, 0.12)],
        [(0.69, 0.12), (0.66, 0.055), (0.54, 0.075), (0.54, 0.015)],
        [(0.54, 0.015), (0.54, -0.05), (0.79, 0.00), (1.0, 0.0)],
    ]
)
_DOVETAIL = np.array([(0, 0), (0.435, 0), (0.375, 0.2), (0.625, 0.2), (0.565, 0), (1, 0)], dtype=np.float64)


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
        """The points higher than a level on the knob's left side and on its right."""
        high = np.flatnonzero(self.points[:, 1] > above)
        top = np.flatnonzero(self.points[:, 1] >= self.height - 1e-9)
        return high[high <= top[0]], high[high >= top[-1]]


def classic(n: int) -> Template:
    """Draw an edge with a smooth round knob: neck 0.13, head 0.25, height 0.27 of the edge.

    Parameters
    ----------
    n : int, points a cubic; the edge has 5 n segments
    """
    return Template(_bezier_chain(_CLASSIC, n))


def rectangular(n: int) -> Template:
    """Draw an edge with a square-shouldered dovetail: neck 0.13, head 0.25, height 0.20 of the edge.

    Parameters
    ----------
    n : int, points a side; the edge has 5 n segments
    """
    t = np.linspace(0, 1, n, endpoint=False)[:, None]
    sides = [a + (b - a) * t for a, b in pairwise(_DOVETAIL)]
    return Template(np.vstack([*sides, _DOVETAIL[-1:]]))


def leaning(n: int) -> Template:
    """Draw an edge with a knob that leans forward.

    Parameters
    ----------
    n : int, points a cubic; the edge has 5 n segments
    """
    return Template(_bezier_chain(_LEANING, n))


def enlarged(template: Template, factor: float) -> Template:
    """Scale the knob of an edge about the edge's middle; what lies beside it gives way.

    Parameters
    ----------
    template : Template
    factor : float, below 2.5

    Returns
    -------
    Template
    """
    return Template(moved_knob(template.points, factor, 0.5))


def moved_knob(points: Floats, factor: float, middle: float) -> Floats:
    """Scale the middle part of an edge and move it along; what lies beside it gives way.

    Parameters
    ----------
    points : (n, 2) float64, from (0, 0) to (1, 0)
    factor : float
    middle : float, where the middle of the edge goes; at least factor / 5 from both ends

    Returns
    -------
    (n, 2) float64
    """
    low, high = 0.5 - _REACH, 0.5 + _REACH
    new_low, new_high = middle - _REACH * factor, middle + _REACH * factor
    x = np.interp(points[:, 0], [0.0, low, high, 1.0], [0.0, new_low, new_high, 1.0])
    return np.stack([x, points[:, 1] * factor], 1)


def along(shape: Floats, ends: Floats) -> Floats:
    """Place unit curves (n, 2) or (e, n, 2), from (0, 0) to (1, 0), onto edges (e, 2, 2)."""
    a, d = ends[:, None, 0], (ends[:, 1] - ends[:, 0])[:, None]
    normal = np.stack([-d[..., 1], d[..., 0]], -1)
    placed: Floats = a + shape[..., :1] * d + shape[..., 1:] * normal
    return placed


def _bezier_chain(cubics: Floats, n: int) -> Floats:
    """Draw cubics (k, 4, 2), each of which begins where the one before it ends, with n segments a cubic."""
    t = np.linspace(0, 1, n, endpoint=False)[:, None]
    a, b, c, d = cubics.transpose(1, 0, 2)[:, :, None]
    drawn = (1 - t) ** 3 * a + 3 * t * (1 - t) ** 2 * b + 3 * t**2 * (1 - t) * c + t**3 * d
    return np.vstack([*drawn, cubics[-1, -1:]])
