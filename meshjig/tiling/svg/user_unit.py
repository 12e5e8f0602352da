"""A user's own outline, from an SVG file, as a tiling."""

import logging
from dataclasses import replace
from pathlib import Path

import numpy as np

from meshjig.errors import OptionError
from meshjig.mesh.types import Floats
from meshjig.tiling.assemble_unit import NoOtherSide, assemble
from meshjig.tiling.check_unit import check_unit
from meshjig.tiling.locked_edges import locked_edges
from meshjig.tiling.svg.border_samples import Border
from meshjig.tiling.svg.corners import split_at_corners
from meshjig.tiling.svg.covering import check_covering
from meshjig.tiling.svg.read_outlines import SNAP, bounded, place, read_outlines
from meshjig.tiling.svg.translations import find_translations
from meshjig.tiling.unit import Unit

__all__ = ["user_unit"]

_NODES = 1200  # nodes of all outlines that are tried to lie on each other
_LONGEST = 0.04  # of a tile's edge, segments of the edges' curves

_log = logging.getLogger(__name__)


def user_unit(path: str | Path) -> Unit:
    """Make a tiling of the closed paths in an SVG file.

    Each path is a tile, and all of them together are repeated. The two translations are found from the
    borders themselves. Gaps and overlaps narrower than 0.5 % of a tile's size are snapped shut.

    Parameters
    ----------
    path : str or Path

    Returns
    -------
    Unit

    Raises
    ------
    OptionError
        The file can't be read, a path is open or crosses itself, copies overlap or leave a hole; the
        sentence says where, in the drawing's own coordinates.

    Notes
    -----
    When no two tiles hold on to each other, that is said in a warning.
    """
    outlines = bounded(read_outlines, path)
    rings = [outline.points for outline in outlines]
    area = sum(_area(ring) for ring in rings)
    tolerance = SNAP * float(np.sqrt(area / len(rings)))
    nodes = np.vstack([outline.sharpest(_NODES // len(outlines)) for outline in outlines])
    translations = find_translations(Border(rings, tolerance), nodes, area)
    if translations is None:
        raise OptionError(
            f"{path}: no two stretches of its border fit each other, such as at {place(rings[0][0])}",
            hint="draw opposite sides as copies of each other",
        )
    check_covering(outlines, translations, tolerance, path)
    edges = split_at_corners(outlines, translations, tolerance, path)
    try:
        unit = assemble(edges, translations, 4 * SNAP)
    except NoOtherSide as error:
        raise OptionError(f"{path}: the tiles on both sides of {place(error.at)} don't fit") from None
    unit = _densified(unit)
    try:
        check_unit(unit)
    except OptionError as error:
        raise OptionError(f"{path}: {error}") from None
    if not locked_edges(unit).any():
        _log.warning("%s: the tiles don't interlock: no two of them hold on to each other", path)
    return unit


def _area(ring: Floats) -> float:
    x, y = ring.T
    return float(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)) / 2)


def _densified(unit: Unit) -> Unit:
    """Divide long segments of a unit's curves, so that they bend where the plane is bent."""
    curves = []
    for curve in unit.curves or ():
        parts = np.ceil(np.linalg.norm(np.diff(curve, axis=0), axis=1) / _LONGEST).astype(int)
        at = np.concatenate([k + np.arange(n) / n for k, n in enumerate(parts)] + [[len(parts)]])
        curves.append(np.stack([np.interp(at, np.arange(len(curve)), curve[:, axis]) for axis in (0, 1)], 1))
    return replace(unit, curves=tuple(curves))
