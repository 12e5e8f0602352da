"""A quick look whether rings would suit a surface, before any is made."""

import numpy as np
from numpy.typing import NDArray

from meshjig.charts.tubes.ends import Ends, two_ends
from meshjig.charts.tubes.harmonic_function import Girths
from meshjig.charts.tubes.tube_decomposition import stack
from meshjig.errors import ChartError
from meshjig.mesh.measure import face_areas
from meshjig.mesh.shortest_paths import distances, edge_graph

__all__ = ["suits"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

_SLICES = 60
_SPREAD = 4  # places at which a face counts
_BLUR = np.array([0.25, 0.5, 0.25])
_MOST = 6  # charts foreseen
_IN_RINGS = 0.6  # of the area, at least
_ROUND = (0.9, 1.1)  # girth over that of a circle of the same mean radius: neither branched nor bent
_MOSTLY = 0.85  # of the area has to be round
_LONG = 0.7  # girths from end to end, at least


def suits(V: Floats, F: Ints) -> bool:
    """Tell whether a component looks like a vase, a tube or a limb.

    Distances along edges stand in for the harmonic height, and the area between them for girths.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, manifold, one component

    Returns
    -------
    bool. `periodic` may still refuse, or cut the surface into more charts than foreseen.
    """
    try:
        ends = two_ends(V, F)
    except ChartError:
        return False
    area = face_areas(V, F)
    slices, radius = _sliced(V, F, area, ends)
    if slices.way[-1] < _LONG * slices.area.sum() / slices.way[-1]:
        return False
    bands = stack(slices, (len(ends.first) == 1, len(ends.last) == 1), [])
    rings = sum(float(slices.area[b.start : b.stop].sum()) for b in bands if b.kind == "ring")
    if not bands or len(bands) > _MOST or any(band.kind == "rest" for band in bands):
        return False
    if rings < _IN_RINGS * area.sum():
        return False
    roundness = slices.girth / (2 * np.pi * radius)
    round_ones = (_ROUND[0] <= roundness) & (roundness <= _ROUND[1])
    return float(slices.area[round_ones].sum()) >= _MOSTLY * float(area.sum())


def _sliced(V: Floats, F: Ints, area: Floats, ends: Ends) -> tuple[Girths, Floats]:
    """Slice a tube by the distance from its first end; also give each slice's mean radius, (k,), mm."""
    distance = distances(edge_graph(V, F), ends.first)[F]
    level = np.linspace(0, distance.max() * (1 + 1e-9), _SLICES + 1)
    # faces of a regular mesh lie in rows: counted whole, they would fill some slices and leave others empty
    low, high = distance.min(1), distance.max(1)
    spread = low + (high - low) * (np.arange(_SPREAD)[:, None] + 0.5) / _SPREAD
    where = np.searchsorted(level, spread, side="right").ravel() - 1
    part = np.tile(area / _SPREAD, _SPREAD)
    total = np.convolve(np.bincount(where, part, _SLICES), _BLUR, "same") + 1e-300
    middle = V[F].mean(1)
    weight = np.maximum(np.bincount(where, part, _SLICES), 1e-300)
    centre = [np.bincount(where, part * np.tile(x, _SPREAD), _SLICES) / weight for x in middle.T]
    off = np.tile(middle, (_SPREAD, 1)) - np.stack(centre, 1)[where]
    radius = (
        np.convolve(np.bincount(where, part * np.linalg.norm(off, axis=1), _SLICES), _BLUR, "same") / total
    )
    girth = np.maximum(total / np.diff(level), 1e-9)
    return Girths(level, total, girth), np.maximum(radius, 1e-9)
