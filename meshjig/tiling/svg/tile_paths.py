"""Read the outlines of tiles, drawn as closed paths, or their edges, drawn as open ones, from an SVG file."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from meshjig.errors import OptionError
from meshjig.mesh.arrays import Bools, Floats
from meshjig.mesh.measure import signed_area
from meshjig.tiling.svg.read_paths import place, polyline, shown_parts

__all__ = ["SNAP", "Outline", "read_edges", "read_outlines"]

SNAP = 0.005  # share of a tile's size within which points of a drawing count as one

_SAME = 2e-5  # share of an outline's extent within which points that follow each other are one


@dataclass(frozen=True)
class Outline:
    """A closed path as a polyline, counterclockwise, in the file's units with y upward."""

    name: str
    points: Floats  # (n, 2), the first not repeated
    node: Bools  # (n,), drawn as a node; the rest are points of curves

    def sharpest(self, most: int) -> Floats:
        """The nodes (k, 2) at which the outline turns most, and no more than so many."""
        along = np.roll(self.points, -1, 0) - self.points
        before = np.roll(along, 1, 0)
        turn = np.arctan2(before[:, 0] * along[:, 1] - before[:, 1] * along[:, 0], (before * along).sum(1))
        nodes = np.flatnonzero(self.node)
        return self.points[nodes[np.argsort(-np.abs(turn[nodes]), kind="stable")[:most]]]


def read_outlines(path: str | Path) -> list[Outline]:
    """Read every closed path and shape that is shown; text is left out.

    Transforms, groups, copies (use), units and the view box are taken care of; coordinates are those of
    the drawing's view box.

    Parameters
    ----------
    path : str or Path

    Returns
    -------
    list of Outline, at least one

    Raises
    ------
    OptionError
        The file can't be read, has no closed path, or a path is open, crosses or touches itself.
    """
    outlines = [outline for name, part in shown_parts(path) for outline in _outlines(part, name, path)]
    if not outlines:
        raise OptionError(f"{path} shows no closed path", hint="draw the outline of a tile")
    return outlines


def read_edges(path: str | Path) -> list[Floats]:
    """Read every path that is shown, turned and scaled to run from one corner of a tile to the next.

    Parameters
    ----------
    path : str or Path

    Returns
    -------
    list of (n, 2) float64, at least one
        Curves from (0, 0) to (1, 0), as they are drawn: not mirrored.

    Raises
    ------
    OptionError
        The file can't be read, has no path, or a path is closed or crosses itself; the sentence says
        where, in the drawing's own coordinates.
    """
    import shapely

    found = []
    for name, part in shown_parts(path):
        points, _ = polyline(part)
        if not len(points):
            continue
        start, end = points[0], points[-1]
        if np.linalg.norm(end - start) <= SNAP * np.linalg.norm(np.ptp(points, axis=0)):
            raise OptionError(
                f"{path}: {name} is closed, at {place(start)}",
                hint="an edge runs from one corner of a tile to the next",
            )
        points = points[np.append(True, np.linalg.norm(np.diff(points, axis=0), axis=1) > 0)]
        line = shapely.LineString(points)
        if not line.is_simple:
            first = shapely.get_parts(shapely.node(line))[0]
            at = np.array(first.coords[-1])
            raise OptionError(
                f"{path}: {name} crosses or touches itself at {place(at)}", hint="take the loop out"
            )
        found.append(_on_unit_edge(points))
    if not found:
        raise OptionError(f"{path} shows no path", hint="draw an edge from one corner of a tile to the next")
    return found


def _outlines(part: Any, name: str, path: str | Path) -> Iterator[Outline]:
    """The outline that a subpath draws; none for a lone point."""
    import svgelements

    points, node = polyline(part)
    if not len(points):
        return
    extent, start = float(np.linalg.norm(np.ptp(points, axis=0))), points[0]
    closed = any(isinstance(segment, svgelements.Close) for segment in part)
    if not closed and np.linalg.norm(points[-1] - start) > SNAP * extent:
        raise OptionError(
            f"{path}: {name} is open: it starts at {place(start)} and ends at {place(points[-1])}",
            hint="close it",
        )
    points, node = np.vstack([points[1:-1], start]), node[1:]
    kept = np.linalg.norm(points - np.roll(points, 1, 0), axis=1) > _SAME * extent
    points, node = points[kept], node[kept]
    if len(points) < 3:
        raise OptionError(f"{path}: {name} encloses nothing, at {place(start)}", hint="delete it")
    _check_simple(points, name, path)
    yield Outline(name, *_counterclockwise(points, node))


def _check_simple(points: Floats, name: str, path: str | Path) -> None:
    import shapely

    reason = shapely.is_valid_reason(shapely.Polygon(points))
    if reason != "Valid Geometry":
        at = np.array([float(value) for value in reason.partition("[")[2].rstrip("]").split()[:2]])
        raise OptionError(
            f"{path}: {name} crosses or touches itself at {place(at)}", hint="take the loop out"
        )


def _counterclockwise(points: Floats, node: Bools) -> tuple[Floats, Bools]:
    return (points[::-1], node[::-1]) if signed_area(points) < 0 else (points, node)


def _on_unit_edge(points: Floats) -> Floats:
    """Turn and scale a curve so that it runs from (0, 0) to (1, 0)."""
    z = (points - points[0]) @ (1, 1j)
    z = z / z[-1]
    return np.stack([z.real, z.imag], 1)
