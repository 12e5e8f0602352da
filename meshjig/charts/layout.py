"""Lay charts side by side in one plane."""

import numpy as np
from numpy.typing import NDArray

__all__ = ["lie_along", "shelves"]

Floats = NDArray[np.float64]


def lie_along(uv: Floats) -> Floats:
    """Turn a chart so that its smallest box lies along u, longer side first, and starts at the origin.

    Parameters
    ----------
    uv : (n, 2) float64, mm

    Returns
    -------
    uv : (n, 2) float64, mm, from (0, 0) on; turned, never mirrored
    """
    import shapely

    box = shapely.minimum_rotated_rectangle(shapely.multipoints(uv))
    corners = shapely.get_coordinates(box)
    if len(corners) >= 4:
        sides = np.diff(corners[:3], axis=0)
        x, y = sides[np.linalg.norm(sides, axis=1).argmax()]
        c, s = np.array([x, y]) / max(float(np.hypot(x, y)), 1e-300)
        uv = uv @ np.array([[c, -s], [s, c]])
    moved: Floats = uv - uv.min(0)
    return moved


def shelves(size: Floats, margin: float = 5.0) -> Floats:
    """Place boxes on shelves that make up about a square, with a margin between them.

    Parameters
    ----------
    size : (k, 2) float64, mm, width and height
    margin : float, mm

    Returns
    -------
    corner : (k, 2) float64, mm, the lower left corner of each box
    """
    padded = size + margin
    widths = np.sqrt(padded.prod(1).sum()) * np.linspace(1.0, 1.6, 13)
    layouts = [_shelve(padded, max(float(w), float(padded[:, 0].max()))) for w in widths]
    extents = [float((corner + padded).max()) for corner in layouts]
    return layouts[int(np.argmin(extents))]


def _shelve(size: Floats, width: float) -> Floats:
    """Fill shelves of a width from left to right, the highest boxes first."""
    corner = np.zeros_like(size)
    x = y = height = 0.0
    for k in np.argsort(-size[:, 1], kind="stable"):
        w, h = size[k]
        if x > 0 and x + w > width:
            x, y, height = 0.0, y + height, 0.0
        corner[k] = x, y
        x, height = x + w, max(height, h)
    return corner
