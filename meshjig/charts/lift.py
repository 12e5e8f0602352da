"""Take points and curves of the plane through a chart onto the surface."""

import numpy as np

from meshjig.mesh.arrays import Floats, Ints, ragged, ranks, row_of
from meshjig.mesh.measure import barycentric, interpolate
from meshjig.mesh.types import Atlas

__all__ = ["curve", "lift", "locate"]

_OUTSIDE = 1e-9  # barycentric coordinate down to which a point counts as inside


def lift(atlas: Atlas, chart: int, uv: Floats) -> tuple[Ints, Floats, Floats]:
    """Map points of the plane to the surface.

    Parameters
    ----------
    atlas : Atlas
    chart : int
    uv : (k, 2) float64, mm, in the plane of the atlas; on a periodic chart also whole periods away

    Returns
    -------
    face : (k,) int64, of the mesh; -1 where the point is not in the chart
    bary : (k, 3) float64, where in the face; nan there
    xyz : (k, 3) float64, mm; nan there
    """
    face, bary, _ = _located(atlas, chart, np.asarray(uv, np.float64).reshape(-1, 2))
    inside = face >= 0
    xyz = np.full((len(face), 3), np.nan)
    xyz[inside] = interpolate(atlas.mesh.V, atlas.mesh.F, face[inside], bary[inside])
    return face, bary, xyz


def curve(atlas: Atlas, chart: int, polyline: Floats) -> list[Floats]:
    """Map a polyline of the plane to the surface, bending it where it crosses from face to face.

    Parameters
    ----------
    atlas : Atlas
    chart : int
    polyline : (k, 2) float64, mm, in the plane of the atlas; repeat the first point to close it

    Returns
    -------
    list of (n, 3) float64, mm. The parts inside the chart, in order; every piece between two
    points lies in one face.
    """
    line = np.asarray(polyline, np.float64).reshape(-1, 2)
    if len(line) < 2:
        return []
    parameter = _crossings(atlas, chart, line)
    points = _along(line, parameter)
    face, _, shift = _located(atlas, chart, _along(line, (parameter[1:] + parameter[:-1]) / 2))
    inside = np.flatnonzero(face >= 0)
    V, F = atlas.mesh.V, atlas.mesh.F
    ends = [_in_face(atlas, face[inside], points[inside + k] + shift[inside]) for k in (0, 1)]
    start, stop = (interpolate(V, F, face[inside], bary) for bary in ends)
    breaks = np.flatnonzero(np.diff(inside) > 1) + 1
    return [
        np.append(start[run], stop[run[-1:]], axis=0)
        for run in np.split(np.arange(len(inside)), breaks)
        if len(run)
    ]


def _located(atlas: Atlas, chart: int, uv: Floats) -> tuple[Ints, Floats, Floats]:
    """The face or -1, where in it, and by what whole periods a point was moved (k, 2), mm."""
    faces = np.flatnonzero(atlas.chart_of_face == chart)
    G = atlas.F_uv[faces]
    low, high = float(atlas.uv[G, 0].min()), float(atlas.uv[G, 0].max())
    period = _period(atlas, chart)
    face, bary = np.full(len(uv), -1, np.int64), np.full((len(uv), 3), np.nan)
    shift = np.zeros((len(uv), 2))
    n_periods = 1
    if period:
        shift[:, 0] = -np.floor((uv[:, 0] - low) / period) * period
        n_periods = int((high - low) / period) + 1
    for _ in range(n_periods):
        left = np.flatnonzero(face < 0)
        local, weights = locate(atlas.uv, G, uv[left] + shift[left])
        found = local >= 0
        face[left[found]], bary[left[found]] = faces[local[found]], weights[found]
        shift[left[~found], 0] += period
    return face, bary, shift


def _period(atlas: Atlas, chart: int) -> float:
    return 0.0 if atlas.period is None else float(atlas.period[chart])


def _in_face(atlas: Atlas, face: Ints, points: Floats) -> Floats:
    """Barycentric coordinates of points that lie in or on their faces, rounding taken off."""
    bary = np.maximum(barycentric(atlas.uv, atlas.F_uv, face, points), 0)
    clean: Floats = bary / bary.sum(1, keepdims=True)
    return clean


def _crossings(atlas: Atlas, chart: int, line: Floats) -> Floats:
    """List where a polyline has its own points and where it crosses edges: segment + share of it."""
    import shapely

    G = atlas.F_uv[atlas.chart_of_face == chart]
    a, b = G.ravel(), np.roll(G, -1, 1).ravel()
    E = np.unique(np.stack([np.minimum(a, b), np.maximum(a, b)], 1), axis=0)
    tree = shapely.STRtree(shapely.linestrings(atlas.uv[E]))
    found = []
    for shift in _shifts(atlas, chart, line):
        moved = line + np.array([shift, 0.0])
        segment, edge = tree.query(shapely.linestrings(np.stack([moved[:-1], moved[1:]], 1)), "intersects")
        found.append(_meetings(moved, segment, atlas.uv[E[edge]]))
    every = np.sort(np.concatenate([np.arange(len(line), dtype=np.float64), *found]))
    # Edges that meet at a vertex give the same crossing up to rounding.
    whole = np.rint(every)
    every = np.where(np.abs(every - whole) < 1e-11, whole, every)
    return every[np.append(True, np.diff(every) > 1e-11)]


def _shifts(atlas: Atlas, chart: int, line: Floats) -> list[float]:
    """List the whole periods by which parts of a line must move to lie on the chart."""
    period = _period(atlas, chart)
    if not period:
        return [0.0]
    u = atlas.uv[atlas.F_uv[atlas.chart_of_face == chart], 0]
    first = np.floor((u.min() - line[:, 0].max()) / period)
    last = np.ceil((u.max() - line[:, 0].min()) / period)
    return [float(k * period) for k in np.arange(first, last + 1)]


def _meetings(line: Floats, segment: Ints, E: Floats) -> Floats:
    """Where segments of a line meet edges (k, 2, 2): segment + share of it; none for parallels."""
    origin, along = line[segment], line[segment + 1] - line[segment]
    foot, side = E[:, 0], E[:, 1] - E[:, 0]
    det = _cross(along, side)
    across = np.abs(det) > 1e-14 * np.linalg.norm(along, axis=1) * np.linalg.norm(side, axis=1)
    t = np.clip(_cross(foot - origin, side)[across] / det[across], 0, 1)
    meetings: Floats = segment[across] + t
    return meetings


def _along(line: Floats, parameter: Floats) -> Floats:
    segment = np.minimum(parameter.astype(np.int64), len(line) - 2)
    t = (parameter - segment)[:, None]
    return line[segment] * (1 - t) + line[segment + 1] * t


def _cross(a: Floats, b: Floats) -> Floats:
    det: Floats = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
    return det


def locate(uv: Floats, F: Ints, points: Floats) -> tuple[Ints, Floats]:
    """Locate points among triangles, by a uniform grid.

    Parameters
    ----------
    uv : (n, 2) float64
    F : (m, 3) int64
    points : (k, 2) float64

    Returns
    -------
    face : (k,) int64, -1 where a point lies in no triangle
    bary : (k, 3) float64, nan there
    """
    face, bary = np.full(len(points), -1, np.int64), np.full((len(points), 3), np.nan)
    if not len(F) or not len(points):
        return face, bary
    low, high = uv[F].min(1), uv[F].max(1)
    origin, cell = low.min(0), max(2 * float(np.mean(high - low)), 1e-12)
    shape = np.floor((high.max(0) - origin) / cell).astype(np.int64) + 1
    row, triangle = _covered_cells((low - origin) / cell, (high - origin) / cell, shape)
    order = np.argsort(row, kind="stable")
    start = np.searchsorted(row[order], np.arange(shape.prod() + 1))

    at = np.floor((points - origin) / cell)
    on_grid = np.flatnonzero((np.isfinite(at) & (at >= 0) & (at < shape)).all(1))
    here = at[on_grid].astype(np.int64) @ np.array([shape[1], 1])
    sizes = start[here + 1] - start[here]
    which = row_of(sizes)
    point, candidate = on_grid[which], triangle[order[ragged(start[here], sizes)]]
    weights = barycentric(uv, F, candidate, points[point])
    depth = weights.min(1)
    best = np.lexsort([-depth, point])
    best = best[np.unique(point[best], return_index=True)[1]]
    best = best[depth[best] >= -_OUTSIDE]
    face[point[best]], bary[point[best]] = candidate[best], weights[best]
    return face, bary


def _covered_cells(low: Floats, high: Floats, shape: Ints) -> tuple[Ints, Ints]:
    """List (cell, box) pairs for boxes given in units of a cell."""
    first = np.floor(low).astype(np.int64)
    n = np.minimum(np.floor(high).astype(np.int64), shape - 1) - first + 1
    box, offset = row_of(n.prod(1)), ranks(n.prod(1))
    i, j = first[box, 0] + offset // n[box, 1], first[box, 1] + offset % n[box, 1]
    return i * shape[1] + j, box
