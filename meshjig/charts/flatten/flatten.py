"""Flatten one chart: the method that was asked for, held to a promise that no face is mirrored."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

from meshjig.charts.distortion import border_is_simple, flat_share, is_unflipped, unit_stretch
from meshjig.charts.flatten.embeddings import lscm, tutte
from meshjig.charts.flatten.isometry import arap, slim
from meshjig.charts.flatten.untangle import separate_border
from meshjig.errors import ChartError
from meshjig.mesh.arrays import Floats, Ints

__all__ = ["Method", "flatten"]

Method = Literal["lscm", "arap", "slim"]

_ENOUGH = 0.985  # share of the area within FLAT_LIMITS
_MUCH = 0.1  # of that share
_ATTEMPTS = (("slim", 20), ("arap", 20), ("slim", 6), ("arap", 4), ("slim", 3))  # with their iterations
_ATTEMPTS_IF_HEAVY = (("arap", 20), ("slim", 4))
_HEAVY = 12_000  # faces from which SLIM is too slow for the full number


def flatten(V: Floats, F: Ints, method: Method = "slim") -> Floats:
    """Flatten a chart without mirrored faces, at a mean stretch of 1.

    LSCM comes first; where it mirrors faces, Tutte's embedding takes its place and SLIM follows,
    whatever the method. LSCM or ARAP that folds or overlaps is left for SLIM. A chart may grow into
    itself as it nears isometry: then its borders are drawn apart; where that leaves too much of the
    area outside FLAT_LIMITS, other attempts follow, and the best is taken.

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
        Every attempt mirrored a face.
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
    """The flattening with most area within FLAT_LIMITS, of those whose border is simple.

    Where there is none, or each is much worse than one that overlaps, the chart can't be had whole:
    that one is given, for the caller to see. None where there were no attempts.
    """
    simple, overlapping = _Best(), _Best()
    for attempt in attempts:
        uv = unit_stretch(V, F, attempt)
        if not border_is_simple(uv, F):
            overlapping.offer(uv, flat_share(V, F, uv))
            uv = separate_border(V, F, uv)
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
    """Flattenings without mirrored faces, the one most worth having first."""
    for method, iterations in _ATTEMPTS if len(F) < _HEAVY else _ATTEMPTS_IF_HEAVY:
        uv = slim(V, F, start, iterations) if method == "slim" else arap(V, F, start, iterations)
        if is_unflipped(uv, F):
            yield uv
    if is_unflipped(start, F):
        yield start


def _start(V: Floats, F: Ints) -> tuple[Floats, bool]:
    """A start without mirrored faces where there is one, and whether it is conformal."""
    try:
        uv = lscm(V, F)
        if is_unflipped(uv, F):
            return uv, True
    except ChartError:
        pass
    return tutte(V, F), False
