"""Find the corners of a tiling, where three tiles or more meet, and the edges between them."""

from dataclasses import dataclass
from itertools import product
from typing import Any

import numpy as np

from meshjig.errors import OptionError
from meshjig.mesh.arrays import Floats, Ints
from meshjig.tiling.svg.read_paths import place
from meshjig.tiling.svg.tile_paths import Outline

__all__ = ["copies_around", "split_at_corners"]

_STEPS = 500  # places looked at along an outline


def split_at_corners(
    outlines: list[Outline], translations: Floats, tolerance: float, path: object
) -> list[list[Floats]]:
    """Cut every outline where its neighbour changes.

    Parameters
    ----------
    outlines : list of Outline, that cover the plane
    translations : (2, 2) float64
    tolerance : float, how far apart the borders of neighbours may lie
    path : the file, for the message

    Returns
    -------
    list of list of (n, 2) float64
        The edges of every tile counterclockwise, each from the corner where the one before it ends.

    Raises
    ------
    OptionError
        The corners of an outline can't be told.
    """
    import shapely

    tiles = [shapely.Polygon(outline.points) for outline in outlines]
    copies = [
        (k, by, shapely.LinearRing(outlines[k].points + by))
        for by in copies_around(tiles, translations, tolerance)
        for k in range(len(tiles))
    ]
    split = []
    for i, outline in enumerate(outlines):
        own = shapely.LinearRing(outline.points)
        rings = [ring for k, by, ring in copies if (k != i or by.any()) and own.distance(ring) <= tolerance]
        edges = _split(_Around(own, rings, tolerance))
        if len(edges) < 2:
            raise OptionError(
                f"{path}: no corners can be told along {outline.name}, from {place(outline.points[0])}"
            )
        split.append(edges)
    return split


def copies_around(tiles: list[Any], translations: Floats, tolerance: float) -> list[Floats]:
    """List the translations, (2,) each and zero first, whose copies may touch what the tiles reach over.

    Parameters
    ----------
    tiles : list of shapely.Polygon
    translations : (2, 2) float64
    tolerance : float
    """
    import shapely

    low_x, low_y, high_x, high_y = shapely.total_bounds(tiles)
    extent = np.array([high_x - low_x, high_y - low_y]) + tolerance
    reach = np.abs(translations).sum(0) + extent  # as far as the parallelogram that is looked at for holes
    n, m = np.ceil(np.linalg.norm(reach) * np.linalg.norm(np.linalg.inv(translations), axis=0)).astype(int)
    moves = np.array(list(product(range(-n, n + 1), range(-m, m + 1)))) @ translations
    moves = moves[(np.abs(moves) <= reach).all(1)]
    return list(moves[np.argsort(np.linalg.norm(moves, axis=1), kind="stable")])


@dataclass(frozen=True)
class _Around:
    """An outline and those that border on it."""

    own: Any  # shapely.LinearRing
    others: list[Any]
    tolerance: float


def _split(around: _Around) -> list[Floats]:
    import shapely

    length = around.own.length
    along = (np.arange(_STEPS) + 0.5) * length / _STEPS
    places = around.own.interpolate(along)
    apart = np.array([shapely.distance(places, other) for other in around.others])
    nearest = _without_short_runs(np.argmin(apart, axis=0), 3 * around.tolerance / length * _STEPS)
    changes = np.flatnonzero(nearest != np.roll(nearest, -1))
    corners = [
        _corner(around, (k + 1) * length / _STEPS, nearest[k], nearest[(k + 1) % _STEPS]) for k in changes
    ]
    return _between(around, sorted(corners, key=lambda corner: corner[0]))


def _without_short_runs(labels: Ints, shortest: float) -> Ints:
    """Let stretches of a label that are too short take the label before them."""
    labels = labels.copy()
    while True:
        starts = np.flatnonzero(labels != np.roll(labels, 1))
        if len(starts) < 2:
            return labels
        lengths = (np.roll(starts, -1) - starts) % len(labels)
        k = int(np.argmin(lengths))
        if lengths[k] >= shortest:
            return labels
        run = (starts[k] + np.arange(lengths[k])) % len(labels)
        labels[run] = labels[starts[k] - 1]


def _corner(around: _Around, at: float, before: int, after: int) -> tuple[float, Floats]:
    """Find where an outline and two others meet, near a place along it: how far along, and the point."""
    import shapely

    three = [around.own, around.others[before], around.others[after]]
    step = around.own.length / _STEPS
    window = (at + np.linspace(-1.5, 1.5, 61) * step) % around.own.length
    drawn = np.vstack([np.asarray(ring.coords)[:-1] for ring in three])
    rough = np.array(around.own.interpolate(at).coords[0])
    near = drawn[np.linalg.norm(drawn - rough, axis=1) < 2 * step + around.tolerance]
    choices = np.vstack([near, shapely.get_coordinates(around.own.interpolate(window))])
    apart = np.sum([shapely.distance(shapely.points(choices), ring) for ring in three], axis=0)
    point = choices[np.argmin(np.round(apart, 9))]
    return float(around.own.project(shapely.Point(point))), point


def _between(around: _Around, corners: list[tuple[float, Floats]]) -> list[Floats]:
    """Cut an outline at its corners."""
    ring = np.asarray(around.own.coords)[:-1]
    places = np.r_[0.0, np.linalg.norm(np.diff(ring, axis=0), axis=1).cumsum()]
    length = around.own.length
    edges = []
    for (start, first), (stop, last) in zip(corners, corners[1:] + corners[:1], strict=True):
        run = (stop - start) % length or length
        ahead = (places - start) % length
        inner = np.flatnonzero((ahead > around.tolerance) & (ahead < run - around.tolerance))
        inner = inner[np.argsort(ahead[inner])]
        edges.append(np.vstack([first, ring[inner], last]))
    return edges
