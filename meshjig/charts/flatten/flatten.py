"""Flatten one chart: the method that was asked for, held to a promise that no face is mirrored."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from meshjig.charts.flatten.arap import arap
from meshjig.charts.flatten.lscm import lscm
from meshjig.charts.flatten.separate_border import part
from meshjig.charts.flatten.slim import slim
from meshjig.charts.flatten.tutte import tutte
from meshjig.errors import ChartError
from meshjig.mesh.boundary_loops import border_loop
from meshjig.mesh.measure import face_areas, singular_values

__all__ = [
    "FLAT_LIMITS",
    "Method",
    "border_is_simple",
    "flat_share",
    "flatten",
    "is_unflipped",
    "ring_is_simple",
    "unit_stretch",
]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Method = Literal["lscm", "arap", "slim"]

FLAT_LIMITS = (0.8, 1.25)  # stretch that a person does not notice on a jigsaw tile
_ENOUGH = 0.985  # share of the area within FLAT_LIMITS
_MUCH = 0.1  # of that share
_ATTEMPTS = (("slim", 20), ("arap", 20), ("slim", 6), ("arap", 4), ("slim", 3))  # with their iterations
_ATTEMPTS_IF_HEAVY = (("arap", 20), ("slim", 4))
_HEAVY = 12_000  # faces from which SLIM is too slow for the full number
_LEAST_AREA = 1e-14  # of the square of the chart's extent


def flatten(V: Floats, F: Ints, method: Method = "slim") -> Floats:
    """Flatten a chart without mirrored faces, at a mean stretch of 1.

    LSCM comes first; where it mirrors faces, Tutte's embedding takes its place and SLIM follows,
    whatever the method. LSCM or ARAP that folds or overlaps gives way to SLIM. A chart may grow into
    itself as it nears isometry: then its borders are drawn apart; where that leaves too much of the
    area outside FLAT_LIMITS, other ways are tried, and the best is taken.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, one disc that uses every vertex
    method : str

    Returns
    -------
    uv : (n, 2) float64, mm. The area-weighted geometric mean of the stretch is 1. The border may
        still meet itself: see border_is_simple.

    Raises
    ------
    ChartError
        Every way of flattening mirrored a face.
    """
    start, conformal = _start(V, F)
    first: list[Floats] = []
    if conformal and method == "lscm":
        first = [start]
    elif conformal and method == "arap":
        first = [arap(V, F, start)]
    for uv in first:
        if is_unflipped(uv, F) and border_is_simple(uv, F):
            return unit_stretch(V, F, uv)
    best = _best_of(V, F, _attempts(V, F, start))
    if best is None:
        raise ChartError("a chart can't be flattened without folds", hint="repair its degenerate faces")
    return best


def _best_of(V: Floats, F: Ints, attempts: Iterator[Floats]) -> Floats | None:
    """Give the flattening with most area within FLAT_LIMITS, of those whose border is simple.

    Where there is none, or each is much worse than one that overlaps, the chart can't be had whole:
    that one is given, for the caller to see. None where there were no attempts.
    """
    simple, overlapping = _Best(), _Best()
    for attempt in attempts:
        uv = unit_stretch(V, F, attempt)
        if not border_is_simple(uv, F):
            overlapping.offer(uv, flat_share(V, F, uv))
            uv = part(V, F, uv)
            if not (is_unflipped(uv, F) and border_is_simple(uv, F)):
                continue
            uv = unit_stretch(V, F, uv)
        simple.offer(uv, flat_share(V, F, uv))
        if simple.share >= _ENOUGH:
            break
    return overlapping.uv if overlapping.share > simple.share + _MUCH else simple.uv


@dataclass
class _Best:
    uv: Floats | None = None
    share: float = -1.0

    def offer(self, uv: Floats, share: float) -> None:
        if share > self.share:
            self.uv, self.share = uv, share


def _attempts(V: Floats, F: Ints, start: Floats) -> Iterator[Floats]:
    """Give flattenings without mirrored faces, the one most worth having first."""
    light = len(F) < _HEAVY
    for method, iterations in _ATTEMPTS if light else _ATTEMPTS_IF_HEAVY:
        uv = slim(V, F, start, iterations) if method == "slim" else arap(V, F, start, iterations)
        if is_unflipped(uv, F):
            yield uv
    if is_unflipped(start, F):
        yield start


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
    """Give the share of the area whose stretch is within FLAT_LIMITS both ways."""
    s = singular_values(V, F, uv)
    area = face_areas(V, F)
    good = (s[:, 1] >= FLAT_LIMITS[0]) & (s[:, 0] <= FLAT_LIMITS[1])
    return float(area[good].sum() / max(area.sum(), 1e-300))


def border_is_simple(uv: Floats, F: Ints) -> bool:
    """Tell whether a disc's border runs through the plane without meeting itself.

    With no face mirrored, this makes the map one to one.
    """
    return ring_is_simple(uv[border_loop(F)])


def ring_is_simple(ring: Floats) -> bool:
    """Tell whether a closed line through points (n, 2) of the plane does not meet itself."""
    import shapely

    return bool(shapely.LinearRing(ring).is_simple)


def _start(V: Floats, F: Ints) -> tuple[Floats, bool]:
    """Give a start without mirrored faces where there is one, and whether it is conformal."""
    try:
        uv = lscm(V, F)
        if is_unflipped(uv, F):
            return uv, True
    except ChartError:
        pass
    return tutte(V, F), False
