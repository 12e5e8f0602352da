"""How much of a chart is stretched within limits, and whether any of it is beyond use."""

import numpy as np
from numpy.typing import NDArray

from meshjig.charts.flatten.flatten import FLAT_LIMITS

__all__ = ["fair_share", "within_limits"]

Floats = NDArray[np.float64]

_USABLE = (0.6, 1.7)  # stretch at which a tile is still a tile
_UNUSABLE = 0.005  # of the area may be beyond


def within_limits(area: Floats, stretch: Floats) -> float:
    """Give the share of area (m,) whose stretch (m, 2) is within FLAT_LIMITS both ways."""
    return _share(area, stretch, *FLAT_LIMITS)


def fair_share(area: Floats, stretch: Floats) -> float:
    """Give the share within FLAT_LIMITS, or 0 where some of the chart is stretched beyond use."""
    if _share(area, stretch, *_USABLE) < 1 - _UNUSABLE:
        return 0.0
    return within_limits(area, stretch)


def _share(area: Floats, stretch: Floats, least: float, most: float) -> float:
    good = (stretch[:, 1] >= least) & (stretch[:, 0] <= most)
    return float(area[good].sum() / max(area.sum(), 1e-300))
