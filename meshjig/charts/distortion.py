"""How true to size a flattened chart is, and whether its map is one to one."""

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.boundary_loops import border_loop
from meshjig.mesh.measure import face_areas, singular_values

__all__ = [
    "FLAT_LIMITS",
    "border_is_simple",
    "flat_share",
    "is_unflipped",
    "ring_is_simple",
    "share_within_limits",
    "unit_stretch",
    "usable_share",
    "within_limits",
]

FLAT_LIMITS = (0.8, 1.25)  # stretch that a person does not notice on a jigsaw tile
_USABLE = (0.6, 1.7)  # stretch at which a tile is still a tile
_UNUSABLE = 0.005  # of the area may be beyond
_LEAST_AREA = 1e-14  # of the square of the chart's extent


def within_limits(stretch: Floats, limits: tuple[float, float] = FLAT_LIMITS) -> Bools:
    """Tell which faces are stretched (m, 2) within limits both ways, (m,)."""
    good: Bools = (stretch[:, 1] >= limits[0]) & (stretch[:, 0] <= limits[1])
    return good


def share_within_limits(area: Floats, stretch: Floats, limits: tuple[float, float] = FLAT_LIMITS) -> float:
    """The share of area (m,) whose stretch (m, 2) is within limits both ways."""
    return float(area[within_limits(stretch, limits)].sum() / max(area.sum(), 1e-300))


def usable_share(area: Floats, stretch: Floats) -> float:
    """The share within FLAT_LIMITS, or 0 where some of the chart is stretched beyond use."""
    usable = share_within_limits(area, stretch, _USABLE) >= 1 - _UNUSABLE
    return share_within_limits(area, stretch) if usable else 0.0


def is_unflipped(uv: Floats, F: Ints) -> bool:
    """Tell whether every face keeps its orientation, and area enough to keep it when turned and moved."""
    if not np.isfinite(uv).all():
        return False
    return bool(face_areas(uv, F).min(initial=np.inf) > _LEAST_AREA * np.ptp(uv, axis=0).max(initial=0) ** 2)


def unit_stretch(V: Floats, F: Ints, uv: Floats) -> Floats:
    """Scale a chart so that the geometric mean of its stretch, weighted by area, is 1."""
    area = face_areas(V, F)
    grown = np.abs(face_areas(uv, F)) / np.maximum(area, 1e-300)
    log = np.log(np.maximum(grown, 1e-12))
    scaled: Floats = uv / np.exp((area * log).sum() / max(area.sum(), 1e-300) / 2)
    return scaled


def flat_share(V: Floats, F: Ints, uv: Floats) -> float:
    """The share of the area whose stretch is within FLAT_LIMITS both ways."""
    return share_within_limits(face_areas(V, F), singular_values(V, F, uv))


def border_is_simple(uv: Floats, F: Ints) -> bool:
    """Tell whether a disc's border runs through the plane without meeting itself.

    With no face mirrored, this makes the map one to one.
    """
    return ring_is_simple(uv[border_loop(F)])


def ring_is_simple(ring: Floats) -> bool:
    """Tell whether a closed line through points (n, 2) of the plane does not meet itself."""
    import shapely

    return bool(shapely.LinearRing(ring).is_simple)
