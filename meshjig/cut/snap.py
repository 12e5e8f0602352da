"""Bring a chart plane and its outlines onto one integer grid."""

from collections import Counter
from typing import NamedTuple

import numpy as np

from meshjig.cut.noding import noded
from meshjig.errors import CutError
from meshjig.mesh.types import Bools, Floats, Ints, Outlines

__all__ = ["FINEST", "Graph", "snap"]

FINEST = 18  # the grid is never finer than 2^-18 mm
LIMIT = 2**30  # orient() is exact below
STEP = 32  # outlines keep to every 32nd line of the grid, 1.2e-4 mm apart: nothing printable is that small


class Graph(NamedTuple):
    """Outlines on the grid: segments of some length that meet at shared points only."""

    points: Ints  # (n, 2)
    segments: Ints  # (k, 2)
    left: Ints  # (k,)
    right: Ints  # (k,)
    source: Ints  # (k,), the segment of the outlines that each is a part of
    span: Floats  # (k, 2), which part of it: start and end, 0 to 1
    point: Ints  # (p,), where the points of the outlines went

    def take(self, kept: Bools) -> "Graph":
        """Give the graph with some of its segments only."""
        return self._replace(
            segments=self.segments[kept],
            left=self.left[kept],
            right=self.right[kept],
            source=self.source[kept],
            span=self.span[kept],
        )


def snap(uv: Floats, outlines: Outlines) -> tuple[Ints, Graph]:
    """Round UV and outlines to a grid of 2^-18 mm, or coarser for more than a metre.

    Outlines keep to a coarser grid, on which they are noded: what comes to lie on each other there
    becomes one, so that no feature of theirs is smaller.

    Parameters
    ----------
    uv : (n, 2) float64, mm
    outlines : Outlines

    Returns
    -------
    U : (n, 2) int64
    graph : Graph

    Raises
    ------
    CutError
        A coordinate is not finite.
    """
    everything = np.concatenate([uv, outlines.points])
    if not np.isfinite(everything).all():
        raise CutError("a chart or an outline has coordinates that are no numbers", hint="flatten it again")
    low = everything.min(axis=0, initial=np.inf)
    extent = float((everything.max(axis=0, initial=-np.inf) - low).max())
    exponent = FINEST if extent <= 0 else min(FINEST, int(np.floor(np.log2((LIMIT - 2 * STEP) / extent))))
    scale = 2.0**exponent
    # the origin is a grid line, so that where all charts lie does not change how they are rounded
    origin = np.floor(low * scale / STEP) * STEP
    U = (np.rint(uv * scale) - origin).astype(np.int64)
    P = (np.rint(outlines.points * scale) - origin).astype(np.int64)
    return U, _graph(P, outlines)


def _graph(P: Ints, outlines: Outlines) -> Graph:
    """Merge what coincides on the outlines' own grid."""
    points, S, source, number = noded(P, outlines.segments, STEP)
    points = points * STEP
    span = _span(points, S, points[number[outlines.segments[source]]])
    graph = _single(Graph(points, S, outlines.left[source], outlines.right[source], source, span, number))
    loose_before = np.bincount(outlines.segments.ravel(), minlength=len(P)) == 1
    return graph.take(~_spurs(graph, number[loose_before]))


def _span(points: Ints, S: Ints, whole: Ints) -> Floats:
    """Give where the ends of segments S lie along the whole segments (k, 2, 2) they come from."""
    a, d = whole[:, 0], whole[:, 1] - whole[:, 0]
    length2 = np.einsum("ij,ij->i", d, d)
    return np.stack([np.einsum("ij,ij->i", points[S[:, k]] - a, d) / length2 for k in (0, 1)], 1)


def _single(graph: Graph) -> Graph:
    """Replace segments that lie on each other by one with the outermost labels, or by none."""
    S, n = graph.segments, np.int64(len(graph.points))
    turned = S[:, 0] > S[:, 1]
    key = S.min(axis=1, initial=n) * n + S.max(axis=1, initial=-1)
    order = np.argsort(key, kind="stable")
    begins = np.flatnonzero(np.append(True, key[order][1:] != key[order][:-1])[: len(key)])
    counts = np.diff(np.append(begins, len(key)))
    left, right = graph.left.copy(), graph.right.copy()
    keep = np.ones(len(S), bool)
    for b, c in zip(begins[counts > 1], counts[counts > 1], strict=True):
        group = order[b : b + c]
        keep[group[1:]] = False
        on_left = Counter(np.where(turned, right, left)[group].tolist())
        on_right = Counter(np.where(turned, left, right)[group].tolist())
        # a label on both sides lies between two of them, in no area
        outer_left, outer_right = list(on_left - on_right), list(on_right - on_left)
        if not outer_left or not outer_right:
            keep[group[0]] = False
            continue
        g = group[0]
        left[g], right[g] = outer_left[0], outer_right[0]
        if turned[g]:
            left[g], right[g] = right[g], left[g]
    return graph._replace(left=left, right=right).take(keep)


def _spurs(graph: Graph, loose_before: Ints) -> Bools:
    """Mark segments that merging has left dangling, (k,)."""
    n = len(graph.points)
    closed = np.ones(n, bool)
    closed[loose_before] = False
    spur = np.zeros(len(graph.segments), bool)
    while True:
        degree = np.bincount(graph.segments[~spur].ravel(), minlength=n)
        more = ((degree == 1) & closed)[graph.segments].any(axis=1) & ~spur
        if not more.any():
            return spur
        spur |= more
