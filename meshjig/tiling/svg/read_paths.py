"""Read what an SVG file shows, as polylines."""

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from meshjig.errors import OptionError
from meshjig.mesh.arrays import Bools, Floats
from meshjig.runtime.bounded import Bounded, Limits, OutOfBounds, allow_file

__all__ = ["bounded", "place", "polyline", "shown_parts"]

_FLAT = 2e-4  # share of an outline's extent that its polyline may stray from a curve
_FINEST = 256  # segments a curve
_LIMITS = Limits(memory=400e6, seconds=5.0)

Drawn = TypeVar("Drawn")


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


def shown_parts(path: str | Path) -> Iterator[tuple[str, Any]]:
    """List every subpath that is shown, in the drawing's coordinates, and the name of its path.

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
    except Exception as error:  # malformed attributes make the parser raise anything
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


def _polyline(segment: Any, tolerance: float) -> Floats:
    """The points of a segment after its start, (k, 2)."""
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
