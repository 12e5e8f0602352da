"""Flattened charts, and how they are laid side by side in one plane."""

from dataclasses import dataclass

import numpy as np

from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.halfedges import compact
from meshjig.mesh.types import UV_GRID, Atlas, Mesh

__all__ = ["Chart", "Charting", "lay_out", "lie_along", "shelves", "uncut_chart"]


@dataclass(frozen=True)
class Chart:
    """Faces of a mesh and where their corners lie in a plane of their own.

    Corners of one vertex lie apart where the chart is cut inside.
    """

    faces: Ints  # (k,), of the mesh
    uv: Floats  # (n, 2), mm
    corners: Ints  # (k, 3), into uv
    period: float = 0.0  # mm along u after which the chart repeats; 0 where it does not


@dataclass(frozen=True)
class Charting:
    """Charts that cover a mesh, and how they came about."""

    charts: list[Chart]
    method: str
    region: Ints | None = None  # (m,), the chart that a face was in before charts were glued
    note: str = ""  # why another method was not used


def uncut_chart(F: Ints, faces: Ints, uv: Floats) -> Chart:
    """Make a chart without cuts inside.

    Parameters
    ----------
    F : (m, 3) int64, the mesh
    faces : (k,) int64
    uv : (n, 2) float64, of the vertices that compact(F[faces]) keeps
    """
    return Chart(faces, uv, compact(F[faces])[0])


def lay_out(mesh: Mesh, charts: list[Chart], margin: float = 5.0) -> Atlas:
    """Number charts, the largest first, and place them in one plane.

    Parameters
    ----------
    mesh : Mesh
    charts : list of Chart, which cover all faces
    margin : float, mm, between the charts' boxes

    Returns
    -------
    Atlas
        Charts lie along u, longer side first; a periodic chart with its period along u, in steps of 2^-18 mm.
    """
    charts = sorted(charts, key=lambda chart: -len(chart.faces))
    plans = [_on_grid(chart.uv) if chart.period else lie_along(chart.uv) for chart in charts]
    # a periodic chart may move on by up to a mm, to a whole one
    boxes = [uv.max(0) + bool(chart.period) for chart, uv in zip(charts, plans, strict=True)]
    corners = shelves(np.array(boxes), margin)
    F_uv, chart_of_face = np.empty_like(mesh.F), np.empty(len(mesh.F), np.int64)
    placed = []
    start = 0
    for number, (chart, uv, corner) in enumerate(zip(charts, plans, corners, strict=True)):
        F_uv[chart.faces] = chart.corners + start
        chart_of_face[chart.faces] = number
        start += len(uv)
        placed.append(uv + (np.ceil(corner) if chart.period else corner))
    period = np.array([chart.period for chart in charts])
    return Atlas(mesh, np.concatenate(placed), F_uv, chart_of_face, period=period if period.any() else None)


def _on_grid(uv: Floats) -> Floats:
    """Round a periodic chart, and move it to the origin, without turning it."""
    steps = np.rint(uv / UV_GRID)
    moved: Floats = (steps - steps.min(0)) * UV_GRID
    return moved


def lie_along(uv: Floats) -> Floats:
    """Turn a chart so that its smallest box lies along u, longer side first, and starts at the origin.

    Parameters
    ----------
    uv : (n, 2) float64, mm

    Returns
    -------
    uv : (n, 2) float64, mm, from (0, 0) on; turned, never mirrored
    """
    import shapely

    box = shapely.minimum_rotated_rectangle(shapely.multipoints(uv[_may_be_corners(uv)]))
    corners = shapely.get_coordinates(box)
    if len(corners) >= 4:
        sides = np.diff(corners[:3], axis=0)
        x, y = sides[np.linalg.norm(sides, axis=1).argmax()]
        c, s = np.array([x, y]) / max(float(np.hypot(x, y)), 1e-300)
        uv = uv @ np.array([[c, -s], [s, c]])
    moved: Floats = uv - uv.min(0)
    return moved


def _may_be_corners(uv: Floats) -> Ints:
    """Leave out points that can't be corners of the convex hull, (k,)."""
    slant = np.stack([uv[:, 0], uv[:, 1], uv.sum(1), uv[:, 0] - uv[:, 1]], 1)
    far = np.append(slant.argmax(0), slant.argmin(0))
    middle = uv[far].mean(0)
    order = far[np.argsort(np.arctan2(*(uv[far] - middle).T[::-1]))]
    start, side = uv[order], np.roll(uv[order], -1, 0) - uv[order]
    inside = np.ones(len(uv), bool)
    for (x, y), (dx, dy) in zip(start, side, strict=True):
        if dx or dy:
            inside &= dx * (uv[:, 1] - y) - dy * (uv[:, 0] - x) > 0
    return np.flatnonzero(~inside)


def shelves(size: Floats, margin: float = 5.0) -> Floats:
    """Place boxes on shelves that make up about a square, with a margin between them.

    Parameters
    ----------
    size : (k, 2) float64, mm, width and height
    margin : float, mm

    Returns
    -------
    corner : (k, 2) float64, mm, the lower left corner of each box
    """
    padded = size + margin
    widths = np.sqrt(padded.prod(1).sum()) * np.linspace(1.0, 1.6, 13)
    layouts = [_shelve(padded, max(float(w), float(padded[:, 0].max()))) for w in widths]
    extents = [float((corner + padded).max()) for corner in layouts]
    return layouts[int(np.argmin(extents))]


def _shelve(size: Floats, width: float) -> Floats:
    """Fill shelves of a width from left to right, the highest boxes first."""
    corner = np.zeros_like(size)
    x = y = height = 0.0
    for k in np.argsort(-size[:, 1], kind="stable"):
        w, h = size[k]
        if x > 0 and x + w > width:
            x, y, height = 0.0, y + height, 0.0
        corner[k] = x, y
        x, height = x + w, max(height, h)
    return corner
