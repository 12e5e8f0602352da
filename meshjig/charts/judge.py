"""Whether a set of faces may be one chart; the flattening is the arbiter."""

import numpy as np
from numpy.typing import NDArray

from meshjig.charts.bend import Bend
from meshjig.charts.flatten import border_is_simple, flat_share, is_unflipped, unit_stretch
from meshjig.charts.lscm import lscm
from meshjig.charts.slim import slim
from meshjig.charts.tutte import tutte
from meshjig.errors import ChartError
from meshjig.topology import compact, is_disc

__all__ = ["Judge"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

_SPREAD = 0.62  # log scale; regions above it hardly ever pass the flattening
_ITERATIONS = 3  # more hardly ever change the verdict


class Judge:
    """Answers whether regions of one mesh are good charts.

    A good chart is a disc that flattens without mirrored faces, keeps both its stretches within
    FLAT_LIMITS on enough of its area, and has a border that does not meet itself in the plane.
    Cheap tests come first.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, manifold
    least_share : float
        Share of the area that must lie within FLAT_LIMITS.
    """

    def __init__(self, V: Floats, F: Ints, least_share: float = 0.99) -> None:
        self._V, self._F = V, F
        self._bend = Bend(V, F)
        self._least_share = least_share

    def accepts(self, faces: Ints) -> bool:
        """Tell whether faces (k,) make a good chart."""
        if not is_disc(self._F[faces]) or self._bend.spread(faces) > _SPREAD:
            return False
        G, kept = compact(self._F[faces])
        V = self._V[kept]
        try:
            uv = lscm(V, G)
        except ChartError:
            uv = tutte(V, G)
        if not is_unflipped(uv, G):
            uv = tutte(V, G)
        elif self._is_good(V, G, uv):
            return True
        return self._is_good(V, G, slim(V, G, uv, _ITERATIONS))

    def _is_good(self, V: Floats, F: Ints, uv: Floats) -> bool:
        if not is_unflipped(uv, F):
            return False
        uv = unit_stretch(V, F, uv)
        return flat_share(V, F, uv) >= self._least_share and border_is_simple(uv, F)
