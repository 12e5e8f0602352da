"""Put the curves of a net together to the planar graph that is cut, chart by chart."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints, ragged, ranks, row_of, starts
from meshjig.mesh.types import Knobs, Outlines
from meshjig.tiling.drawing import Drawing, EdgeCurves
from meshjig.tiling.net import first_alike

__all__ = ["BESIDE", "chart_graph", "joined"]

BESIDE = 1.0  # mm that cuts go on beyond a chart, less than the distance between charts


def chart_graph(polygon: Any, drawing: Drawing) -> tuple[Outlines, Knobs]:
    """Keep what is cut of a chart's tiling: what lies inside, and a little beyond the border.

    On a periodic chart segments are listed for every copy that is near the chart. The first of those
    that are one is inside the chart, where any is, and the first ones of an edge follow each other
    as they do along the edge, although they may be parts of different copies.

    Parameters
    ----------
    polygon : shapely.Polygon, the chart
    drawing : Drawing

    Returns
    -------
    outlines : Outlines, with same_point and same_segment
    knobs : Knobs, each once, by first points and first segments
    """
    import shapely

    net, curves = drawing.net, drawing.curves
    near = shapely.buffer(polygon, BESIDE)
    shapely.prepare(polygon)
    shapely.prepare(near)
    row = np.full(len(net.ends), -1)
    row[drawing.edges] = np.arange(len(drawing.edges))
    copies = _copies_near(near, drawing, row)
    drawn, shift = row[net.first_edge[copies]], net.turns[copies] * drawing.period

    # every point of every copy: what it is, whichever copy, and where
    count = curves.count[drawn]
    begin, rank, of_copy = starts(count), ranks(count), row_of(count)
    source = ragged(curves.start[drawn], count)
    xy = curves.points[source] + np.stack([shift[of_copy], np.zeros(len(source))], 1)
    identity = len(net.nodes) + source
    key = identity * len(net.ends) + copies[of_copy]
    for at, end in ((begin, 0), (begin + count - 1, 1)):
        node = net.ends[copies, end]
        xy[at] = drawing.nodes[node]
        identity[at] = net.first_node[node]
        key[at] = node - len(net.nodes)  # below all others
    _, first, point = np.unique(key, return_index=True, return_inverse=True)
    xy, identity = xy[first], identity[first]
    order = np.lexsort((~shapely.contains_xy(polygon, xy), identity))
    place = np.empty(len(order), np.int64)
    place[order] = np.arange(len(order))
    xy, identity, point = xy[order], identity[order], place[point]

    kept = np.flatnonzero(rank < count[of_copy] - 1)
    beside = shapely.contains_xy(near, xy)
    kept = kept[beside[point[kept]] | beside[point[kept + 1]]]  # the rest could reach other charts
    segments = np.stack([point[kept], point[kept + 1]], 1)
    outside = ~shapely.contains_xy(polygon, xy[segments].mean(1))
    copy = copies[of_copy[kept]]
    in_turn = np.lexsort((copy, outside, source[kept]))
    is_copy = np.append(False, np.diff(source[kept][in_turn]) == 0)[: len(kept)]
    in_turn = np.concatenate([in_turn[~is_copy], in_turn[is_copy]])  # the first ones follow each other
    segments, copy, of_segment = segments[in_turn], copy[in_turn], source[kept][in_turn]

    used = np.zeros(len(xy), bool)
    used[segments.ravel()] = True
    number = np.cumsum(used) - 1
    same_point = first_alike(identity[used])
    outlines = Outlines(
        xy[used],
        number[segments],
        net.left[copy],
        net.right[copy],
        same_point,
        first_alike(of_segment),
    )
    return outlines, _knobs(drawing, identity[used], of_segment)


def joined(
    parts: Sequence[tuple[Outlines, Knobs]], n_tiles: Sequence[int], n_edges: Sequence[int]
) -> tuple[Outlines, Knobs]:
    """Put the charts' graphs into one, with a label of its own for every tile.

    Parameters
    ----------
    parts : sequence of (Outlines, Knobs)
    n_tiles : sequence of int, the labels that each part may use
    n_edges : sequence of int, the edges that each part was drawn of
    """
    n_points, n_segments, n_labels, n_before = (
        starts(np.array(counts, np.int64))
        for counts in (
            [len(o.points) for o, _ in parts],
            [len(o.segments) for o, _ in parts],
            n_tiles,
            n_edges,
        )
    )
    same_point = _shifted([o.same_point for o, _ in parts], n_points)
    same_segment = _shifted([o.same_segment for o, _ in parts], n_segments)
    alone = bool((same_segment == np.arange(len(same_segment))).all())
    outlines = Outlines(
        np.concatenate([o.points for o, _ in parts]),
        _shifted([o.segments for o, _ in parts], n_points),
        _shifted([o.left for o, _ in parts], n_labels),
        _shifted([o.right for o, _ in parts], n_labels),
        None if alone else same_point,
        None if alone else same_segment,
    )
    knobs = Knobs(
        _shifted([k.neck for _, k in parts], n_points),
        _shifted([k.head for _, k in parts], n_points),
        _shifted([k.span for _, k in parts], n_segments),
        _shifted([k.edge for _, k in parts], n_before),
    )
    return outlines, knobs


def _copies_near(near: Any, drawing: Drawing, row: Ints) -> Ints:
    """List the net's edges that come near the chart, of those that divide two tiles."""
    import shapely

    net = drawing.net
    copies = np.flatnonzero((net.left != net.right) & (row[net.first_edge] >= 0))
    box = _boxes(drawing.curves)[row[net.first_edge[copies]]]
    box[:, [0, 2]] += net.turns[copies, None] * drawing.period
    touches: Bools = shapely.intersects(near, shapely.box(*box.T))
    return copies[touches]


def _boxes(curves: EdgeCurves) -> Floats:
    low, high = (f.reduceat(curves.points, curves.start[:-1], axis=0) for f in (np.minimum, np.maximum))
    return np.hstack([low, high])


def _knobs(drawing: Drawing, identity: Ints, of_segment: Ints) -> Knobs:
    """Find the knobs' points and segments among those of the graph."""
    begin = drawing.curves.start[:-1][drawing.knobbed]
    if drawing.template is None or not len(begin):
        none = np.zeros((0, 2), np.int64)
        return Knobs(none, none, none, none[:, 0])
    n_nodes = len(drawing.net.nodes)
    neck, head = (begin[:, None] + np.array(pair) for pair in (drawing.template.neck, drawing.template.head))
    first = of_segment[: len(np.unique(of_segment))]  # in order: the copies come after them
    span = np.searchsorted(first, neck)
    point = [np.searchsorted(identity, n_nodes + pair) for pair in (neck, head)]
    return Knobs(point[0], point[1], span, np.flatnonzero(drawing.knobbed))


def _shifted(arrays: Sequence[Ints | None], by: Ints) -> Ints:
    moved = [array + n for array, n in zip(arrays, by.tolist(), strict=True) if array is not None]
    return np.concatenate(moved).astype(np.int64)
