"""A duck of one surface: ovals along a bent line from the tip of the tail to the tip of the bill."""

import numpy as np
import trimesh

from models.patches import flipped, joined, mean_girth, meshed, spread, tube, turns, wheel
from models.rings import rounded

__all__ = ["duck"]

# place along (x) and height (y) of the middle, half width, half height, and how the oval leans (degrees)
_OVALS = np.array(
    [
        (-78, 52, 0.0, 0.0, 25), (-72, 50, 9, 4, 25), (-60, 44, 24, 13, 18), (-44, 38, 37, 26, 10),
        (-22, 34, 45, 33, 1), (2, 34, 45, 34, -12), (20, 40, 39, 32, -33), (31, 53, 29, 27, -56),
        (35, 68, 21, 20, -78), (36, 84, 20, 20, -88), (43, 103, 24, 22.5, -45), (62, 111, 22, 21, -2),
        (74, 109, 15, 13, 12), (82, 106, 12, 7, 10), (92, 104, 10, 3.8, 6), (99, 103, 5, 1.9, 4),
        (102, 102.8, 0.0, 0.0, 4),
    ],
    float,
)  # fmt: skip

_CAP = 90.0  # mm around, below which an end is a cap


def duck(around: int = 160, along: int = 170) -> trimesh.Trimesh:
    """Loft the ovals, 150 mm from tail to bill or so; closed, with a singular tip at either end; y is up."""
    smooth = rounded(_OVALS, 5)
    weight = np.sqrt(
        (np.diff(smooth[:, :2], axis=0) ** 2).sum(1) + (np.diff(smooth[:, 2:4], axis=0) ** 2).sum(1)
    )
    arc = np.append(0.0, np.cumsum(weight))
    at = np.linspace(0, arc[-1], along)
    x, y, wide, high, lean = (np.interp(at, arc, column) for column in smooth.T)
    angle = -2 * np.pi * np.arange(around) / around
    across = np.cos(angle) * wide[1:-1, None]
    up = np.sin(angle) * high[1:-1, None]
    tilt = np.radians(lean)[1:-1, None]
    rings = np.stack([x[1:-1, None] + up * np.sin(tilt), y[1:-1, None] + up * np.cos(tilt), across], -1)
    girth = np.linalg.norm(rings - np.roll(rings, -1, 1), axis=2).sum(1)
    whole = np.flatnonzero(girth > _CAP)
    first, last = int(whole[0]), int(whole[-1])
    tail = wheel(rings[: first + 1], np.array([x[0], y[0], 0]), angle)
    bill = wheel(rings[: last - 1 : -1], np.array([x[-1], y[-1], 0]), angle)
    body = rings[first : last + 1]
    way = np.append(0.0, np.cumsum(np.linalg.norm(np.diff(body, axis=0), axis=2).mean(1)))
    mean = mean_girth(body, way)
    return meshed(joined([flipped(tail), tube(body, mean * turns(body), spread(body, way, mean)), bill]))
