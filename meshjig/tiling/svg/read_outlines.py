"""Read closed outlines from an SVG file."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from meshjig.errors import OptionError
from meshjig.mesh.types import Bools, Floats
from meshjig.runtime.bounded import Bounded, Limits, OutOfBounds, allow_file

__all__ = ["SNAP", "Outline", "bounded", "place", "polyline", "read_outlines", "shown_parts"]

SNAP = 0.005  # share of a tile's size within which points of a drawing count as one

_SAME = 2e-5  # share of an outline's extent within which points that follow each other are one
_FLAT = 2e-4  # share of an outline's extent that its polyline may stray from a curve
_FINEST = 256  # segments a curve
_LIMITS = Limits(memory=400e6, seconds=5.0)

Drawn = TypeVar("Drawn")


@dataclass(frozen=True)
class Outline:
    """A closed path as a polyline, counterclockwise, in the file's units with y upward."""

    name: str
    points: Floats  # (n, 2), the first not repeated
    node: Bools  # (n,), drawn as a node; the rest are points of curves

    def sharpest(self, most: int) -> Floats:
        """Give the nodes (k, 2) at which the outline turns most, and no more than so many."""
        along = np.roll(self.points, -1, 0) - self.points
        before = np.roll(along, 1, 0)
        turn = np.arctan2(before[:, 0] * along[:, 1] - before[:, 1] * along[:, 0], (before * along).sum(1))
        nodes = np.flatnonzero(self.node)
        return self.points[nodes[np.argsort(-np.abs(turn[nodes]), kind="stable")[:most]]]


def bounded(reader: Callable[[str], Drawn], path: str | Path) -> Drawn:
    """Call a reader of SVG files in a process of its own, within limits of memory and time.

    Raises
    ------
    OptionError
        What the reader raises; or it went beyond the limits.
    """
    try:
        return Bounded(reader.__module__, reader.__qualname__, str(path), limits=_LIMITS).result()
    except OutOfBounds as error:
        raise OptionError(f"{path} {error}", hint="simplify the drawing") from None


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


def shown_parts(path: str | Path) -> Iterator[tuple[str, Any]]:
    """Give every subpath that is shown, in the drawing's coordinates, and the name of its path.

    Parameters
    ----------
    path : str or Path

    Yields
    ------
    (str, svgelements.Subpath)

    Raises
    ------
    OptionError
        The file can't be read.
    """
    import svgelements

    if not Path(path).is_file():
        raise OptionError(f"there is no file {path}")
    allow_file(path)
    try:
        drawing = svgelements.SVG.parse(str(path), reify=True)
        to_file = ~svgelements.Matrix(drawing.viewbox_transform or "")
    except Exception as error:  # malformed attributes make the parser fail in any way
        raise OptionError(f"{path} can't be read as SVG: {error}") from None
    number = 0
    for element in drawing.elements():
        if isinstance(element, svgelements.Shape) and _is_shown(element):
            drawn = svgelements.Path(element) * to_file
            drawn.reify()
            number += 1
            for part in drawn.as_subpaths():
                yield (f"path {element.id}" if element.id else f"path {number}"), part


def polyline(part: Any) -> tuple[Floats, Bools]:
    """Draw a subpath.

    Parameters
    ----------
    part : svgelements.Subpath

    Returns
    -------
    points : (n, 2) float64, y upward, its start first; none for a lone point
    node : (n,) bool, drawn as a node; the rest are points of curves
    """
    import svgelements

    segments = [segment for segment in part if not isinstance(segment, svgelements.Move)]
    box = part.bbox()
    extent = float(np.hypot(box[2] - box[0], box[3] - box[1])) if segments and box else 0.0
    if extent == 0.0:
        return np.zeros((0, 2)), np.zeros(0, bool)
    drawn = [_polyline(segment, _FLAT * extent) for segment in segments]
    points = np.vstack([np.array(segments[0].start, dtype=np.float64), *drawn]) * (1, -1)
    node = np.concatenate([[True], *(np.arange(len(part)) == len(part) - 1 for part in drawn)])
    return points, node


def place(point: Floats) -> str:
    """Write a point, y upward, as the drawing's own coordinates, y downward."""
    x, y = np.round(point, 6) * (1, -1) + 0.0
    return f"({x:.5g}, {y:.5g})"


def _is_shown(element: Any) -> bool:
    return element.values.get("visibility") not in ("hidden", "collapse")


def _outlines(part: Any, name: str, path: str | Path) -> Iterator[Outline]:
    """Give the outline that a subpath draws; none for a lone point."""
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


def _polyline(segment: Any, tolerance: float) -> Floats:
    """Give the points of a segment after its start, (k, 2)."""
    import svgelements

    if isinstance(segment, svgelements.Line | svgelements.Close):
        return np.array([segment.end], dtype=np.float64)
    n = 2
    drawn = _points(segment, n)
    while n < _FINEST:
        finer = _points(segment, 2 * n)
        middles = (drawn[1:] + drawn[:-1]) / 2
        if np.linalg.norm(finer[1::2] - middles, axis=1).max() < tolerance:
            break
        n, drawn = 2 * n, finer
    return drawn[1:]


def _points(segment: Any, n: int) -> Floats:
    return np.array([tuple(segment.point(t)) for t in np.linspace(0.0, 1.0, n + 1).tolist()])


def _check_simple(points: Floats, name: str, path: str | Path) -> None:
    import shapely

    reason = shapely.is_valid_reason(shapely.Polygon(points))
    if reason != "Valid Geometry":
        at = np.array([float(value) for value in reason.partition("[")[2].rstrip("]").split()[:2]])
        raise OptionError(
            f"{path}: {name} crosses or touches itself at {place(at)}", hint="take the loop out"
        )


def _counterclockwise(points: Floats, node: Bools) -> tuple[Floats, Bools]:
    x, y = points.T
    if np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)) < 0:
        return points[::-1], node[::-1]
    return points, node
