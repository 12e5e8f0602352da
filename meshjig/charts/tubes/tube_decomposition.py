"""Which slices of a tube make up a ring or a cap: as few as flatten well."""

from itertools import pairwise
from typing import Literal, NamedTuple

import numpy as np

from meshjig.charts.distortion import FLAT_LIMITS
from meshjig.charts.tubes.harmonic_function import Girths
from meshjig.mesh.arrays import Bools, Floats

__all__ = ["Band", "Kind", "decompose_tube"]


_LEAST_SHARE = 0.9  # of a chart's area that must be within FLAT_LIMITS, as foreseen
_FINE = 16  # steps of log stretch within FLAT_LIMITS
_SLACK = 0.97  # of the limits' width: what girths alone foresee is a little too good
_REST = (3.0, 8.0)  # charts that an end without shape costs, and more for its share of the area
_SEAM = 0.3  # charts that a seam costs as long as the root of the area
_WORST = 10.0  # charts that an area costs which is all out of limits
_UNEVEN = 5.0  # charts that it costs when all girths are as far as limits allow from their mean
_DOME = 4 / 3  # on a dome, distance from the tip over girth grows that much faster than roundness
_WIDEST = 1.9  # times its least girth a ring's largest may be, or a cap's girth that of a flat disc
_SPOILT = 0.03  # of a cap may be wider still: girths near its tip are not told well
_SHORTEST = 0.08  # of its girth: a ring is no shorter


Kind = Literal["ring", "cap", "rest"]  # a rest is an end that is neither a tube nor a single cap


class Band(NamedTuple):
    """Slices start to stop - 1 as one chart."""

    kind: Kind
    start: int
    stop: int


def decompose_tube(slices: Girths, tips: tuple[bool, bool], refused: list[Band]) -> list[Band]:
    """Divide a tube into the fewest rings and caps whose stretch stays within limits.

    A ring flattens well where its girth changes little; a cap where its girth grows like a
    circle's with the distance from its tip. Among equals, short seams and little stretch win.

    Parameters
    ----------
    slices : Girths
    tips : whether the tube is closed at its first and at its last end
    refused : bands that did not flatten as foreseen; nor will others of their kind that hold most of one

    Returns
    -------
    list of Band, from the first end to the last; empty where there is no such division
    """
    n = len(slices.area)
    rings = _cost(slices, _ring_shares(slices)) + _spread_cost(slices)
    rings[_lengths(slices.run) < _SHORTEST * _mean_girths(slices)] = np.inf
    rings[_spreads(slices.girth) > _WIDEST] = np.inf
    caps = _cost(slices, _cap_shares(slices))
    turned = Girths(slices.level[::-1], slices.area[::-1], slices.girth[::-1])
    caps[:, n] = _cost(turned, _cap_shares(turned))[0][::-1]
    for band in refused:
        (rings if band.kind == "ring" else caps)[_alike(slices.area, band)] = np.inf
    rests = _cost(slices, np.ones((n + 1, n + 1))) - 1
    rests += _REST[0] + _REST[1] * _lengths(slices.area) / slices.area.sum()
    ends = np.minimum(caps, rests)
    first = ends[0].copy() if tips[0] else np.where(np.arange(n + 1) == 0, 0.0, np.inf)
    last = ends[:, n].copy() if tips[1] else np.where(np.arange(n + 1) == n, 0.0, np.inf)
    cuts = _cheapest(first, rings, last)
    if not cuts:
        return []
    bands = [Band("ring", start, stop) for start, stop in pairwise(cuts)]
    if tips[0]:
        bands.insert(0, Band("cap" if caps[0, cuts[0]] <= rests[0, cuts[0]] else "rest", 0, cuts[0]))
    if tips[1]:
        bands.append(Band("cap" if caps[cuts[-1], n] <= rests[cuts[-1], n] else "rest", cuts[-1], n))
    return bands


def _cheapest(first: Floats, rings: Floats, last: Floats) -> list[int]:
    """Where the first end, at least one ring, and the last end meet; nothing where all cost inf."""
    n = len(first) - 1
    best, came = np.full(n + 1, np.inf), np.full(n + 1, -1)
    for stop in range(1, n + 1):
        through = np.minimum(first, best) + rings[:, stop]
        came[stop] = np.argmin(through)
        best[stop] = through[came[stop]]
    at = int(np.argmin(best + last))
    if not np.isfinite(best[at] + last[at]):
        return []
    cuts = [at, int(came[at])]
    while best[cuts[-1]] < first[cuts[-1]]:
        cuts.append(int(came[cuts[-1]]))
    return cuts[::-1]


def _cost(slices: Girths, share: Floats) -> Floats:
    """What every band from slice i to before slice j costs, (n + 1, n + 1)."""
    n = len(slices.area)
    total = slices.area.sum()
    area = _lengths(slices.area)
    girth = np.append(slices.girth, 0.0)
    seam = np.minimum(girth, np.append(0.0, slices.girth)) * _SEAM / np.sqrt(total)
    seam[[0, n]] = 0.0
    cost = 1 + _WORST * (1 - share) * area / total + (seam[:, None] + seam[None, :]) / 2
    return np.where((share >= _LEAST_SHARE) & (area > 0), cost, np.inf)


def _spread_cost(slices: Girths) -> Floats:
    """What it costs a ring, within limits too, that its girths differ, (n + 1, n + 1)."""
    log, area = np.log(slices.girth), _lengths(slices.area)
    mean = _lengths(slices.area * log) / np.where(area > 0, area, 1.0)
    square = np.maximum(_lengths(slices.area * log**2) - mean**2 * area, 0.0)
    cost: Floats = _UNEVEN * square / slices.area.sum() / np.log(FLAT_LIMITS[1] / FLAT_LIMITS[0]) ** 2
    return cost


def _ring_shares(slices: Girths) -> Floats:
    """Foresee the share of the area within limits for every ring, (n + 1, n + 1)."""
    return _best_shares(slices.area, np.log(slices.girth))


def _cap_shares(slices: Girths) -> Floats:
    """Foresee the share for every cap that begins at the first slice, (n + 1, n + 1); only row 0 is one."""
    below = np.cumsum(slices.area) - slices.area / 2
    dome = _DOME * np.log(4 * np.pi * below / slices.girth**2) / 2  # 0 on a flat disc
    good = np.abs(dome) <= np.log(FLAT_LIMITS[1] / FLAT_LIMITS[0]) * _SLACK
    share = np.cumsum(slices.area * good) / np.cumsum(slices.area)
    spoilt = np.cumsum(slices.area * (dome > np.log(_WIDEST))) / np.cumsum(slices.area)
    share[spoilt > _SPOILT] = 0.0
    shares = np.zeros((len(dome) + 1, len(dome) + 1))
    shares[0, 1:] = share
    return shares


def _best_shares(area: Floats, log: Floats) -> Floats:
    """The largest share of the area of each interval whose logs lie within limits of each other."""
    width = np.log(FLAT_LIMITS[1] / FLAT_LIMITS[0]) * _SLACK
    cell = np.floor((log - log.min()) * _FINE / width).astype(np.int64)
    cell = np.minimum(cell, 20 * _FINE)
    histogram = np.zeros((len(area) + 1, int(cell.max()) + _FINE + 1))
    histogram[np.arange(len(area)) + 1, cell + _FINE] = area
    up_to = histogram.cumsum(0).cumsum(1)
    within = up_to[:, _FINE:] - up_to[:, :-_FINE]  # by highest cell
    total = up_to[:, -1]
    share = np.zeros((len(area) + 1, len(area) + 1))
    for start in range(len(area)):
        inside = (within[start + 1 :] - within[start]).max(1)
        share[start, start + 1 :] = inside / np.maximum(total[start + 1 :] - total[start], 1e-300)
    return share


def _lengths(step: Floats) -> Floats:
    """The sum of steps i to j - 1 for all i, j, (n + 1, n + 1); negative below the diagonal."""
    along = np.append(0.0, np.cumsum(step))
    return along[None, :] - along[:, None]


def _spreads(girth: Floats) -> Floats:
    """The largest over the least girth of slices i to j - 1, (n + 1, n + 1); 1 where there are none."""
    spread = np.ones((len(girth) + 1, len(girth) + 1))
    for start in range(len(girth)):
        tail = girth[start:]
        spread[start, start + 1 :] = np.maximum.accumulate(tail) / np.minimum.accumulate(tail)
    return spread


def _mean_girths(slices: Girths) -> Floats:
    length = _lengths(slices.run)
    mean: Floats = np.where(length > 0, _lengths(slices.area) / np.where(length > 0, length, 1.0), 0.0)
    return mean


def _alike(area: Floats, band: Band, share: float = 0.8) -> Bools:
    """Mark the bands (i, j) that hold most of a given one, (n + 1, n + 1)."""
    along = np.append(0.0, np.cumsum(area))
    low, high = along[band.start], along[band.stop]
    held = np.minimum(along[None, :], high) - np.maximum(along[:, None], low)
    like: Bools = held >= share * (high - low)
    return like
