"""Where a ring chart closes over a pole: the cap beyond it, and where the ring's tiles end on it."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.boundary_loops import closed_loops
from meshjig.mesh.halfedges import edge_keys, next_halfedge
from meshjig.mesh.measure import unit
from meshjig.mesh.types import Atlas, Outlines
from meshjig.tiling.domain import chart_borders

__all__ = ["CapBorder", "Pole", "cap_border", "find_poles"]

POINTED = 0.8  # radians of angle that are missing around a tip


@dataclass(frozen=True)
class Pole:
    """A cap chart whose whole border is one border of a ring chart, edge by edge in both planes."""

    cap: int  # the chart
    ring: int  # the periodic chart
    here: Floats  # (k, 2, 2), mm, border edges in the cap's plane, counterclockwise, ends in that order
    there: Floats  # (k, 2, 2), mm, the same edges in the ring's plane
    tip: Floats | None = None  # (2,), mm, where the cap comes to a point; None where it is round


class CapBorder(NamedTuple):
    """The ring's tiles along a cap's border, counterclockwise."""

    start: Floats  # (n, 2), mm, where each begins, in the cap's plane
    tile: Ints  # (n,), label of the ring's outlines


def find_poles(atlas: Atlas) -> list[Pole]:
    """List the caps of an atlas: charts without a hole that lie against one ring chart all around.

    Parameters
    ----------
    atlas : Atlas

    Returns
    -------
    list of Pole, in the order of the cap charts
    """
    if atlas.period is None or not atlas.period.any():
        return []
    F, corner = atlas.mesh.F.ravel(), atlas.F_uv.ravel()
    h = chart_borders(atlas.F_uv)
    after = next_halfedge(h)
    chart = atlas.chart_of_face[h // 3]
    other = _partners(edge_keys(np.stack([F[h], F[after]], 1), len(atlas.mesh.V)))
    poles = []
    for cap in np.flatnonzero(atlas.period == 0).tolist():
        mine = np.flatnonzero(chart == cap)
        beyond = chart[other[mine]]
        if (other[mine] < 0).any() or np.ptp(beyond) > 0 or atlas.period[beyond[0]] == 0:
            continue
        start, end = corner[h[mine]], corner[after[mine]]
        loops = closed_loops(start, end)
        if len(loops) > 1 or len(np.unique(start)) < len(start):
            continue
        mine = mine[loops[0]]
        twin = other[mine]
        here = atlas.uv[np.stack([corner[h[mine]], corner[after[mine]]], 1)]
        there = atlas.uv[np.stack([corner[after[twin]], corner[h[twin]]], 1)]
        poles.append(Pole(cap, int(beyond[0]), here, there, _tip(atlas, cap)))
    return poles


def cap_border(pole: Pole, outlines: Outlines, least: float) -> CapBorder:
    """Find which of a ring's tiles end on a cap, and where.

    Parameters
    ----------
    pole : Pole
    outlines : Outlines, of the ring chart
    least : float, mm of the cap's border; a tile that ends on less leaves it to the shorter of its neighbours

    Returns
    -------
    CapBorder
        Without rows where no cut of the ring comes to the cap's border.
    """
    edge, t, tile = _crossings(pole.there, outlines)
    a, b = pole.here[edge, 0], pole.here[edge, 1]
    start = a + t[:, None] * (b - a)
    length = np.linalg.norm(pole.here[:, 1] - pole.here[:, 0], axis=1)
    at = np.cumsum(length)[edge] - (1 - t) * length[edge]
    kept = _long_enough(at, tile, float(length.sum()), least)
    return CapBorder(start[kept[:, 0]], tile[kept[:, 1]])


def _partners(key: Ints) -> Ints:
    """The other row with the same key, (k,), -1 where there is none."""
    order = np.argsort(key, kind="stable")
    twice = np.flatnonzero(key[order][1:] == key[order][:-1])
    other = np.full(len(key), -1)
    other[order[twice]], other[order[twice + 1]] = order[twice + 1], order[twice]
    return other


def _tip(atlas: Atlas, cap: int) -> Floats | None:
    """The place of the vertex inside a cap around which most of the angle is missing."""
    faces = np.flatnonzero(atlas.chart_of_face == cap)
    X, rows = atlas.mesh.V[atlas.mesh.F[faces]], atlas.F_uv[faces]
    ahead = unit(np.roll(X, -1, 1) - X)
    angle = np.arccos(np.clip(-(ahead * np.roll(ahead, 1, 1)).sum(2), -1, 1))
    missing = 2 * np.pi - np.bincount(rows.ravel(), angle.ravel(), len(atlas.uv))
    missing[rows.ravel()[chart_borders(rows)]] = 0.0
    inside = np.unique(rows)
    tip = inside[missing[inside].argmax()]
    return atlas.uv[tip] if missing[tip] >= POINTED else None


def _crossings(border: Floats, outlines: Outlines) -> tuple[Ints, Floats, Ints]:
    """Where cuts cross edges (k, 2, 2), in order: edge, place 0 to 1 along it, and the tile after."""
    import shapely

    ends = outlines.points[outlines.segments]
    lines = shapely.linestrings(ends)
    edge, s = shapely.STRtree(lines).query(shapely.linestrings(border))
    A, B, p, q = border[edge, 0], border[edge, 1], ends[s, 0], ends[s, 1]
    left_a, left_b = _turn(p, q, A), _turn(p, q, B)
    hit = ((left_a > 0) != (left_b > 0)) & ((_turn(A, B, p) > 0) != (_turn(A, B, q) > 0))
    edge, s, left_a, left_b = edge[hit], s[hit], left_a[hit], left_b[hit]
    t = left_a / (left_a - left_b)
    tile = np.where(left_b > 0, outlines.left[s], outlines.right[s])
    order = np.lexsort((t, edge))
    return edge[order].astype(np.int64), t[order], tile[order]


def _turn(a: Floats, b: Floats, c: Floats) -> Floats:
    d, e = b - a, c - a
    return d[:, 0] * e[:, 1] - d[:, 1] * e[:, 0]


def _long_enough(at: Floats, tile: Ints, around: float, least: float) -> Ints:
    """Drop short runs along a loop: give the crossing, and the crossing named for its tile, of the rest."""
    runs = [(k, k) for k in range(len(at))]
    while len(runs) > 1:
        begin = at[[k for k, _ in runs]]
        length = np.roll(begin, -1) - begin
        length[-1] += around
        name = tile[[k for _, k in runs]]
        like_before = np.flatnonzero(name == np.roll(name, 1))
        if len(like_before):
            del runs[int(like_before[0])]
            continue
        k = int(length.argmin())
        if length[k] >= least or len(runs) == 2:
            break
        after = (k + 1) % len(runs)
        if length[after] < length[k - 1]:  # the one after begins earlier
            runs[after] = (runs[k][0], runs[after][1])
        del runs[k]
    return np.array(runs, np.int64).reshape(-1, 2)
