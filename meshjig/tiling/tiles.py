"""Tile the charts of an atlas: a grid a chart, with a knob on every edge that has room for one."""

from collections.abc import Callable
from typing import Any

import numpy as np

from meshjig.tiling.classic import classic
from meshjig.tiling.domain import chart_polygons
from meshjig.tiling.grid import Grid, place_grid
from meshjig.tiling.rectangular import rectangular
from meshjig.tiling.template import Template
from meshjig.types import Atlas, Bools, Floats, Ints, Knobs, Outlines

__all__ = ["FAMILIES", "tile_charts"]

FAMILIES: dict[str, Callable[[int], Template]] = {"classic": classic, "rectangular": rectangular}

POINT_DISTANCE = 0.6  # mm along a tile's edge
BESIDE = 1.0  # mm that cuts go on beyond a chart, less than the distance between charts
# side, place along the edge, scale: what is tried in turn until the knob lies inside the chart
_TRIES = [(s, p, k) for k in (1.0, 0.8) for p in (0.0, 0.12, -0.12) for s in (1, -1) if (k, p) != (1.0, 0.12)]


def tile_charts(
    atlas: Atlas,
    size: float,
    *,
    family: str = "classic",
    shift: tuple[float, float] = (0.5, 0.5),
    min_neck: float = 0.0,
    seed: int = 0,
) -> tuple[Outlines, Knobs]:
    """Cover every chart with square tiles that interlock.

    An edge gets its knob where the whole knob lies inside the chart: a knob never leaves an open
    border, nor is it cut in two by a seam. It changes its side, place and scale to fit, but shrinks
    to no thinner neck than the least; where none fits, the edge is plain.

    Parameters
    ----------
    atlas : Atlas
    size : float, edge of a tile, mm
    family : str, a key of FAMILIES
    shift : two floats, see `place_grid`
    min_neck : float, mm
    seed : int

    Returns
    -------
    outlines : Outlines, labels are tiles
    knobs : Knobs
    """
    template = FAMILIES[family](int(np.clip(np.ceil(1.7 * size / POINT_DISTANCE / 5), 4, 80)))
    rng = np.random.default_rng(seed)
    parts = []
    first_tile = 0
    for polygon in chart_polygons(atlas):
        grid = place_grid(polygon, size, shift)
        parts.append(_tile_chart(polygon, grid, template, min_neck, rng, first_tile))
        first_tile += grid.shape[0] * grid.shape[1]
    return _join(parts)


def _tile_chart(
    polygon: Any, grid: Grid, template: Template, min_neck: float, rng: np.random.Generator, first_tile: int
) -> tuple[Outlines, Knobs]:
    import shapely

    ends, left, right = grid.inner_edges()
    nodes = grid.nodes().reshape(-1, 2)
    near = shapely.buffer(polygon, BESIDE)
    shapely.prepare(near)
    chosen, curves = _choose_knobs(polygon, nodes[ends], template, min_neck / grid.size, rng)
    kept = shapely.intersects(near, shapely.linestrings(curves))
    ends, left, right, chosen, curves = ends[kept], left[kept], right[kept], chosen[kept], curves[kept]

    n_edges, n = len(curves), curves.shape[1]
    used, ends = np.unique(ends, return_inverse=True)
    ends = ends.reshape(-1, 2)
    inner = len(used) + np.arange(n_edges * (n - 2)).reshape(n_edges, n - 2)
    ids = np.concatenate([ends[:, :1], inner, ends[:, 1:]], 1)
    points = np.vstack([nodes[used], curves[:, 1:-1].reshape(-1, 2)])
    segments = np.stack([ids[:, :-1].ravel(), ids[:, 1:].ravel()], 1)
    knobbed = np.flatnonzero(chosen)
    span = knobbed[:, None] * (n - 1) + np.array(template.neck)
    beside = shapely.contains_xy(near, points)[segments].any(1)  # the rest could reach other charts
    kept_before = np.concatenate([[0], np.cumsum(beside)])
    labels = (np.repeat(tile + first_tile, n - 1)[beside] for tile in (left, right))
    outlines = Outlines(points, segments[beside], *labels)
    return outlines, Knobs(ids[knobbed][:, template.neck], ids[knobbed][:, template.head], kept_before[span])


def _choose_knobs(
    polygon: Any, ends: Floats, template: Template, min_neck: float, rng: np.random.Generator
) -> tuple[Bools, Floats]:
    """Give the edges that carry a knob, (e,) bool, and every edge's curve, (e, n, 2)."""
    import shapely

    size = float(np.linalg.norm(ends[0, 1] - ends[0, 0]))
    inside = shapely.buffer(polygon, -0.05 * size)
    shapely.prepare(inside)
    first_side = rng.choice([-1.0, 1.0], len(ends))
    jitter = rng.uniform(-0.04, 0.04, len(ends))
    straight = np.stack([np.linspace(0, 1, len(template.points)), np.zeros(len(template.points))], 1)
    curves = _place(straight, ends)
    chosen = np.zeros(len(ends), bool)
    knob = slice(template.neck[0], template.neck[1] + 1)
    for side, place, scale in _TRIES:
        if scale < 1 and scale * template.neck_width < min_neck:
            continue
        todo = np.flatnonzero(~chosen)
        shape = _shaped(template.points, side * first_side[todo], place + jitter[todo], scale)
        tried = _place(shape, ends[todo])
        fits = shapely.contains_properly(inside, shapely.linestrings(tried[:, knob]))
        curves[todo[fits]] = tried[fits]
        chosen[todo[fits]] = True
    return chosen, curves


def _shaped(points: Floats, side: Floats, place: Floats, scale: float) -> Floats:
    """Move, scale and mirror a template's knob while its ends stay, (e, n, 2)."""
    x, y = points[:, 0] - 0.5, points[:, 1] * scale
    reach = 0.2  # half width of the part that is moved as a whole
    inner = np.abs(x) <= reach
    end = np.where(x < 0, -0.5, 0.5)
    outer = (x - end) / (np.sign(x) * reach - end + (x == 0))
    moved = np.where(
        inner,
        x * scale + place[:, None],
        end + outer * (np.sign(x) * reach * scale + place[:, None] - end),
    )
    return np.stack([moved + 0.5, side[:, None] * y], -1)


def _place(shape: Floats, ends: Floats) -> Floats:
    """Carry unit curves (n, 2) or (e, n, 2) onto edges (e, 2, 2)."""
    a, d = ends[:, None, 0], (ends[:, 1] - ends[:, 0])[:, None]
    normal = np.stack([-d[..., 1], d[..., 0]], -1)
    return a + shape[..., :1] * d + shape[..., 1:] * normal


def _join(parts: list[tuple[Outlines, Knobs]]) -> tuple[Outlines, Knobs]:
    """Put the charts' graphs into one."""
    n_points = np.cumsum([0] + [len(o.points) for o, _ in parts])
    n_segments = np.cumsum([0] + [len(o.segments) for o, _ in parts])
    outlines = Outlines(
        np.vstack([o.points for o, _ in parts]),
        _stack([o.segments + p for (o, _), p in zip(parts, n_points, strict=False)]),
        np.concatenate([o.left for o, _ in parts]),
        np.concatenate([o.right for o, _ in parts]),
    )
    knobs = Knobs(
        _stack([k.neck + p for (_, k), p in zip(parts, n_points, strict=False)]),
        _stack([k.head + p for (_, k), p in zip(parts, n_points, strict=False)]),
        _stack([k.span + s for (_, k), s in zip(parts, n_segments, strict=False)]),
    )
    return outlines, knobs


def _stack(arrays: list[Ints]) -> Ints:
    return np.vstack(arrays).astype(np.int64)
