"""Whether a set of faces may be one chart; the flattening is the arbiter."""

import numpy as np
from numpy.typing import NDArray

from meshjig.charts.flatten.arap import arap
from meshjig.charts.flatten.flatten import FLAT_LIMITS, ring_is_simple
from meshjig.charts.flatten.lscm import lscm
from meshjig.charts.flatten.tutte import tutte
from meshjig.charts.segment.conformal_distortion import Bend
from meshjig.charts.segment.neck_free import is_stout
from meshjig.charts.segment.region import Region, Regions
from meshjig.errors import ChartError
from meshjig.mesh.measure import face_areas, singular_values

__all__ = ["Judge"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

_SPREAD = 0.62  # log scale; regions above it hardly ever pass the flattening
_ITERATIONS = 4  # of ARAP; more hardly ever change the verdict


class Judge:
    """Answers whether regions of one mesh are good charts.

    A good chart is a disc without thin parts that flattens without mirrored faces, keeps both its
    stretches within FLAT_LIMITS on enough of its area, and has a border that does not meet itself in
    the plane. Cheap tests come first. ARAP stands in for SLIM: it takes a fifth of the time, and the
    two agree on nine regions of ten.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, manifold
    least_share : float
        Share of the area that must lie within FLAT_LIMITS.
    conformal : bool
        Whether charts are flattened with their angles kept: then ARAP is not asked.
    """

    def __init__(self, V: Floats, F: Ints, least_share: float = 0.97, conformal: bool = False) -> None:
        self._V = V
        self._area = face_areas(V, F)
        self._bend = Bend(V, F)
        self._regions = Regions(F)
        self._least_share, self._conformal = least_share, conformal
        self._known: dict[int, bool] = {}

    def accepts(self, faces: Ints) -> bool:
        """Tell whether faces (k,) make a good chart."""
        key = hash(np.sort(faces).tobytes())
        if key not in self._known:
            self._known[key] = self._is_good(faces)
        return self._known[key]

    def _is_good(self, faces: Ints) -> bool:
        region = self._regions.disc(faces)
        if region is None or not is_stout(region) or self._bend.exceeds(faces, _SPREAD):
            return False
        V, area = self._V[region.kept], self._area[faces]
        try:
            uv = lscm(V, region.F, region.loop, float(area.sum()))
        except ChartError:
            uv = tutte(V, region.F)
        if not ring_is_simple(uv[region.loop]):  # hardly ever does ARAP draw it apart
            return False
        if _share(V, region, area, uv) >= self._least_share:
            return True
        if self._conformal:
            return False
        uv = arap(V, region.F, uv, _ITERATIONS)
        return _share(V, region, area, uv) >= self._least_share and ring_is_simple(uv[region.loop])


def _share(V: Floats, region: Region, area: Floats, uv: Floats) -> float:
    """Give the share of the area within FLAT_LIMITS at a mean stretch of 1; 0 where a face is mirrored."""
    s = singular_values(V, region.F, uv)
    if not s[:, 1].min(initial=np.inf) > 0:  # mirrored, or not finite
        return 0.0
    total = max(float(area.sum()), 1e-300)
    s = s / np.exp((area * np.log(s.prod(1))).sum() / total / 2)
    good = (s[:, 1] >= FLAT_LIMITS[0]) & (s[:, 0] <= FLAT_LIMITS[1])
    return float(area[good].sum() / total)
