"""A figure: the control points of its edges, and the lines drawn inside."""

from dataclasses import dataclass

import numpy as np

from meshjig.mesh.types import Floats
from meshjig.tiling.families.art.heesch import PAIRS, Complex, snapped_corners

__all__ = ["Figure", "outline_edges", "spline"]

_SPACING = 0.02  # of a tile's edge, between points of a curve

Points = tuple[tuple[float, float], ...]


@dataclass(frozen=True)
class Figure:
    """A tile as it is drawn; its area need not be 1.

    Points are x and y. Edges that follow from others by symmetry aren't given.
    """

    symmetry: str  # a key of PAIRS
    corners: Points  # counterclockwise; edge k starts at corner k
    edges: tuple[Points, ...]  # of each pair's first edge, the control points between its corners
    lines: tuple[Points, ...] = ()  # control points of strokes inside
    dots: tuple[tuple[float, float, float], ...] = ()  # x, y and radius of circles inside
    turn: float = 0.0  # degrees by which the whole tiling is turned in the end


def outline_edges(figure: Figure) -> tuple[Complex, list[Complex]]:
    """Draw the edges of a figure around it.

    Parameters
    ----------
    figure : Figure

    Returns
    -------
    corners : (c,) complex128, moved to where the symmetry is exact
    edges : list of (n,) complex128, counterclockwise, each from corner to corner
    """
    drawn = _complex(figure.corners)
    corners = snapped_corners(figure.symmetry, drawn)
    following = np.roll(corners, -1)
    edges: dict[int, Complex] = {}
    for pair, inner in zip(PAIRS[figure.symmetry], figure.edges, strict=True):
        k = pair.first
        old_start, old_stop = drawn[k], drawn[(k + 1) % len(drawn)]
        share = (_complex(inner) - old_start) / (old_stop - old_start)
        controls = np.r_[corners[k], corners[k] + share * (following[k] - corners[k]), following[k]]
        motion = pair.motion(corners)
        if pair.first == pair.second:
            controls = (controls + motion(controls)[::-1]) / 2
        edges[k] = spline(controls)
        if pair.first != pair.second:
            other = motion(edges[k])
            edges[pair.second] = other if pair.mirrored else other[::-1]
    return corners, [edges[k] for k in range(len(corners))]


def spline(controls: Complex) -> Complex:
    """Draw a smooth curve through points (k,), with evenly spaced points on it."""
    from scipy.interpolate import CubicSpline

    if len(controls) < 3:
        along = np.arange(len(controls), dtype=np.float64)
        fine = np.interp(np.linspace(0, along[-1], 50), along, controls)
    else:
        along = np.r_[0.0, np.sqrt(np.abs(np.diff(controls))).cumsum()]
        fine = CubicSpline(along, controls, bc_type="natural")(np.linspace(0, along[-1], 40 * len(along)))
    length = np.r_[0.0, np.abs(np.diff(fine)).cumsum()]
    n = max(int(np.ceil(length[-1] / _SPACING)), 2)
    even: Complex = np.interp(np.linspace(0, length[-1], n + 1), length, fine)
    even[[0, -1]] = controls[[0, -1]]
    return even


def _complex(points: Points) -> Complex:
    pairs: Floats = np.array(points, np.float64).reshape(-1, 2)
    return np.asarray(pairs @ (1, 1j))
