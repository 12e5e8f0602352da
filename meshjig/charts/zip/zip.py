"""Glue charts along their seams, as far as the result stays good: fewer charts, shorter seams."""

import heapq

import numpy as np

from meshjig.charts.chart import Chart
from meshjig.charts.zip.seams import Arc, Seams
from meshjig.mesh.arrays import Floats, Ints

__all__ = ["zip_charts"]

_LEAST_SHARES = (0.985, 0.98)  # of a glued chart's area, within FLAT_LIMITS
_OVERLAP_COST = 30.0  # an overlap of 1/30 squared of the area leaves an arc a third of its worth
_OVERLAP = 0.01  # of the area: more can't be drawn apart
_DECAY = 0.6  # what other arcs between two charts are worth after one of them failed
_EFFORT = 20_000  # faces flattened, for each of them
_EFFORT_OF_OVERLAP, _EFFORT_OF_TRYING = 10, 250  # faces
_GAPS = (0.05, 0.1, 0.2, 0.4)  # opening of a slit over its length, up to which it may close


def zip_charts(
    V: Floats,
    F: Ints,
    charts: list[Chart],
    least_shares: tuple[float, ...] = _LEAST_SHARES,
    effort: float = _EFFORT,
) -> list[Chart]:
    """Glue charts two by two along a stretch of their seam, then close slits from their tips.

    Two charts that share several stretches are glued along one, and keep the others as cuts inside.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, manifold, one component
    charts : list of Chart, good ones, which cover all faces, without cuts inside
    least_shares : tuple of float
        Of the area that must lie within FLAT_LIMITS; the next is for what the one before left apart.
    effort : float, about how many faces may be flattened meanwhile, for each of them

    Returns
    -------
    list of Chart
        Discs without mirrored faces and with simple borders.

    Notes
    -----
    Arcs are tried in the order of what they are worth: long ones first, whose sides fit, and along
    which the charts don't come to lie on each other. That order decides what comes out.
    """
    seams = Seams(V, F, charts)
    for least_share in least_shares:
        if len(seams.numbers()) > 1:
            _join(seams, least_share, effort)
    for number in seams.numbers():
        if number >= len(charts):  # others have no cuts inside
            _close_slits(seams, number, least_shares[0])
    return seams.charts()


def _join(seams: Seams, least_share: float, effort: float) -> None:
    """Glue charts two by two, along the arc that is worth most, until none makes a good chart."""
    arcs: list[Arc] = []
    queue: list[tuple[float, int, float, bool]] = []  # an arc ranks by how it fits; then by the overlap too
    failures: dict[tuple[int, int], int] = {}

    def add(found: list[Arc]) -> None:
        for arc in found:
            heapq.heappush(queue, (-arc.fit.worth, len(arcs), arc.fit.worth, False))
            arcs.append(arc)

    add(seams.arcs())
    alive = set(seams.numbers())
    while queue and effort > 0:
        rank, n, worth, compared = heapq.heappop(queue)
        arc = arcs[n]
        pair = arc.first, arc.second
        now = worth * _DECAY ** failures.get(pair, 0)
        if not alive.issuperset(pair):
            continue
        if now < -rank:
            heapq.heappush(queue, (-now, n, worth, compared))
        elif not compared:
            overlap = seams.overlap(arc)
            effort -= _EFFORT_OF_OVERLAP
            if overlap < _OVERLAP:
                worth *= float(np.exp(-_OVERLAP_COST * np.sqrt(overlap)))
                heapq.heappush(queue, (-worth, n, worth, True))
        else:
            number, spent = seams.close(arc.rows, least_share, arc)
            effort -= spent + _EFFORT_OF_TRYING
            if number is None:
                failures[pair] = failures.get(pair, 0) + 1
            else:
                alive = set(seams.numbers())
                add(seams.arcs(number))


def _close_slits(seams: Seams, number: int, least_share: float) -> None:
    """Close the slits of a chart from their tips, farther and farther, while the chart stays good."""
    for gap in _GAPS:
        rows = seams.tips(number, gap)
        if not len(rows):
            continue
        closed, _ = seams.close(rows, least_share)
        if closed is None:
            return
        number = closed
