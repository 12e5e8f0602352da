"""How far along a tube: a harmonic height between its ends, and the girth at every height."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from meshjig.charts.tubes.ends import Ends
from meshjig.mesh.measure import face_areas

__all__ = ["Girths", "girths", "harmonic_height"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

_SLICES = 120
_THINNEST = 5e-4  # of the area: near tips, slices go down to this
_GROWTH = 1.4  # of slices away from a tip


class Girths(NamedTuple):
    """A tube in thin slices from end to end."""

    level: Floats  # (k + 1,), heights between the slices, the ends included
    area: Floats  # (k,), mm2
    girth: Floats  # (k,), mm around the middle of each slice

    @property
    def run(self) -> Floats:
        """Give how long each slice is along the tube, (k,), mm."""
        length: Floats = self.area / np.maximum(self.girth, 1e-300)
        return length

    @property
    def way(self) -> Floats:
        """Give how far along the tube the slices begin and end, (k + 1,), mm."""
        return np.append(0.0, np.cumsum(self.run))


def harmonic_height(V: Floats, F: Ints, ends: Ends) -> Floats:
    """Give a harmonic function, 0 at the first end and 1 at the last; (n,).

    On a tube it has no peaks and no saddles: between its ends, each of its level lines is one loop
    around the tube.
    """
    import igl
    from scipy.sparse.linalg import splu

    laplacian = -igl.intrinsic_delaunay_cotmatrix(V, F)[0].tocsr()
    h = np.zeros(len(V))
    h[ends.last] = 1.0
    fixed = np.zeros(len(V), bool)
    fixed[ends.first] = fixed[ends.last] = True
    free = np.flatnonzero(~fixed)
    if len(free):
        rows = laplacian[free]
        solver = splu(rows[:, free].tocsc(), permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True})
        h[free] = solver.solve(-(rows[:, ends.last] @ np.ones(len(ends.last))))
    return h


def girths(V: Floats, F: Ints, height: Floats) -> Girths:
    """Slice a tube by height and measure its slices.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64
    height : (n,) float64
    """
    area = face_areas(V, F)
    middle = height[F].mean(1)
    order = np.argsort(middle, kind="stable")
    share = np.cumsum(area[order]) / area.sum()
    at = order[np.minimum(np.searchsorted(share, _shares()), len(order) - 1)]
    inner = np.unique(middle[at])
    level = np.concatenate(
        [[height.min()], inner[(inner > height.min()) & (inner < height.max())], [height.max()]]
    )
    slice_of_face = np.clip(np.searchsorted(level, middle) - 1, 0, len(level) - 2)
    total = np.bincount(slice_of_face, area, len(level) - 1).astype(np.float64)
    around = np.array([_length_of_level(V, F, height, t) for t in (level[1:] + level[:-1]) / 2])
    full = (total > 0) & (around > 0)
    begin = level[:-1][full]
    begin[0] = level[0]
    return Girths(np.append(begin, level[-1]), total[full], around[full])


def _shares() -> Floats:
    """Give the shares of the area below each level between slices."""
    step = 1 / _SLICES
    n = int(np.log(step / _THINNEST) / np.log(_GROWTH)) + 1
    tip = np.cumsum(_THINNEST * _GROWTH ** np.arange(n))
    even = np.arange(tip[-1] + step, 1 - tip[-1], step)
    return np.concatenate([tip, even, 1 - tip[::-1]])


def _length_of_level(V: Floats, F: Ints, height: Floats, level: float) -> float:
    """Measure the level line of a piecewise linear function, mm."""
    above = height[F] > level
    crossed = np.flatnonzero(above.any(1) & ~above.all(1))
    G, up = F[crossed], above[crossed]
    lonely = np.where((up.sum(1) == 1)[:, None], up, ~up).argmax(1)
    i = np.arange(len(G))
    apex = G[i, lonely]
    ends = []
    for k in (1, 2):
        other = G[i, (lonely + k) % 3]
        t = (level - height[apex]) / (height[other] - height[apex])
        ends.append(V[apex] + t[:, None] * (V[other] - V[apex]))
    return float(np.linalg.norm(ends[1] - ends[0], axis=1).sum())
