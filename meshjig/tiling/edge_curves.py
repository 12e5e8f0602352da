"""The curves of a net's edges: lists of points, one after another in one array."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from meshjig.mesh.types import Floats, Ints
from meshjig.tiling.net import Net
from meshjig.tiling.placing import Placing
from meshjig.tiling.unit import Unit

__all__ = ["POINT_DISTANCE", "Curves", "along", "shaped_curves"]

POINT_DISTANCE = 0.6  # mm along a tile's edge
FLAT = 0.02  # mm, that a drawn curve may be off when it is cut with fewer points


@dataclass(frozen=True)
class Curves:
    """Polylines of any number of points each."""

    points: Floats  # (k, 2), mm, curve after curve, both ends included
    start: Ints  # (e + 1,), where each curve begins in points, and where the last one ends

    @property
    def count(self) -> Ints:
        """The number of points of every curve, (e,)."""
        return np.diff(self.start)

    @property
    def of_point(self) -> Ints:
        """The curve of every point, (k,)."""
        return np.repeat(np.arange(len(self.start) - 1), self.count)


def along(shape: Floats, ends: Floats) -> Floats:
    """Carry unit curves (n, 2) or (e, n, 2), from (0, 0) to (1, 0), onto edges (e, 2, 2)."""
    a, d = ends[:, None, 0], (ends[:, 1] - ends[:, 0])[:, None]
    normal = np.stack([-d[..., 1], d[..., 0]], -1)
    placed: Floats = a + shape[..., :1] * d + shape[..., 1:] * normal
    return placed


def shaped_curves(
    unit: Unit, placing: Placing, net: Net, edges: Ints, bend: Callable[[Floats], Floats]
) -> Curves:
    """Draw edges that interlock by their shape.

    Parameters
    ----------
    unit : Unit, with curves
    placing : Placing
    net : Net
    edges : (e,) int64, of the net
    bend : callable, carries points (..., 2) of the chart's plane

    Returns
    -------
    Curves
        A point at least every 0.6 mm before they are bent.
    """
    drawn = [_refined(curve, placing) for curve in unit.curves or ()]
    size = np.array([len(curve) for curve in drawn])
    first = np.cumsum(size) - size
    kind = net.kind[edges]
    start = np.concatenate([[0], np.cumsum(size[kind])])
    at = np.arange(start[-1]) - np.repeat(start[:-1] - first[kind], size[kind])
    moved = np.repeat(net.copy[edges] @ unit.translations @ placing.matrix, size[kind], axis=0)
    return Curves(bend(placing(np.concatenate(drawn))[at] + moved), start)


def _refined(curve: Floats, placing: Placing) -> Floats:
    """Leave out the points of a placed curve that it hardly bends at, and split its long segments."""
    import shapely

    placed = placing(curve)
    kept = shapely.get_coordinates(
        shapely.simplify(shapely.linestrings(placed), FLAT, preserve_topology=False)
    )
    curve = curve[np.flatnonzero(np.isin(placed @ [1, 1j], kept @ [1, 1j]))]
    length = np.linalg.norm(np.diff(placing(curve), axis=0), axis=1)
    n = np.maximum(np.ceil(length / POINT_DISTANCE).astype(np.int64), 1)
    row = np.repeat(np.arange(len(n)), n)
    t = (np.arange(len(row)) - np.repeat(np.cumsum(n) - n, n)) / n[row]
    return np.vstack([curve[row] + t[:, None] * (curve[row + 1] - curve[row]), curve[-1:]])
