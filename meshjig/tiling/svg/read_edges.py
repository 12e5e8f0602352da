"""Read the edges of tiles, drawn as open paths, from an SVG file."""

from pathlib import Path

import numpy as np

from meshjig.errors import OptionError
from meshjig.mesh.types import Floats
from meshjig.tiling.svg.read_outlines import SNAP, place, polyline, shown_parts

__all__ = ["read_edges"]


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


def _on_unit_edge(points: Floats) -> Floats:
    """Turn and scale a curve so that it runs from (0, 0) to (1, 0)."""
    z = (points - points[0]) @ (1, 1j)
    z = z / z[-1]
    return np.stack([z.real, z.imag], 1)
