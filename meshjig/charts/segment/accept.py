"""Whether a set of faces may be one chart; the flattening is the arbiter."""

import numpy as np

from meshjig.charts.distortion import ring_is_simple, within_limits
from meshjig.charts.flatten.embeddings import lscm, tutte
from meshjig.charts.flatten.isometry import arap
from meshjig.charts.segment.region import Region, Regions, is_neck_free
from meshjig.errors import ChartError
from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.halfedges import edges
from meshjig.mesh.measure import face_areas, singular_values

__all__ = ["Acceptance", "ConformalDistortion"]

_SPREAD = 0.62  # log scale; regions above it hardly ever pass the flattening
_ITERATIONS = 4  # of ARAP; more hardly ever change the verdict
_LITTLE = 6.0  # radians of curvature for a spread of 1: a cone of as much, spread over a disc, has less


class Acceptance:
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
        self._bend = ConformalDistortion(V, F)
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
        if region is None or not is_neck_free(region) or self._bend.exceeds(faces, _SPREAD):
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
    """The share of the area within FLAT_LIMITS at a mean stretch of 1; 0 where a face is mirrored."""
    s = singular_values(V, region.F, uv)
    if not s[:, 1].min(initial=np.inf) > 0:  # mirrored, or not finite
        return 0.0
    total = max(float(area.sum()), 1e-300)
    s = s / np.exp((area * np.log(s.prod(1))).sum() / total / 2)
    return float(area[within_limits(s)].sum() / total)


class ConformalDistortion:
    """Answers the spread of scale that flattening a region of a mesh takes.

    The conformal map with the least spread of scale has a constant scale along the border; the
    logarithm of its scale then solves Poisson's equation for the Gaussian curvature. The matrix
    and the curvature are those of the whole mesh, cut to the region's inner vertices: a few
    milliseconds, where the flattening takes fifty.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, manifold

    References
    ----------
    Ben-Chen et al., "Conformal Flattening by Curvature Prescription and Metric Scaling", 2008.
    """

    def __init__(self, V: Floats, F: Ints) -> None:
        import igl

        self._F = F
        self._area = face_areas(V, F)
        self._laplacian = -igl.cotmatrix(V, F).tocsr()
        angles = np.nan_to_num(igl.internal_angles(V, F))
        self._curvature = 2 * np.pi - np.bincount(F.ravel(), angles.ravel(), len(V))
        self._n_faces = np.bincount(F.ravel(), minlength=len(V))
        e = edges(F)
        self._n_faces[e.E[e.n_faces == 1].ravel()] = -1  # a border vertex is inner to no region

    def exceeds(self, faces: Ints, limit: float) -> bool:
        """Tell whether the spread over faces (k,), a disc, is above a limit.

        Where there is little curvature it hardly can be, and is not computed.
        """
        inner = self._inner(faces)
        if np.abs(self._curvature[inner]).sum() < _LITTLE * limit:
            return False
        return self._spread(faces, inner) > limit

    def spread(self, faces: Ints) -> float:
        """The spread of log scale over the middle 99 % of the area of some faces.

        Parameters
        ----------
        faces : (k,) int64, a disc
        """
        return self._spread(faces, self._inner(faces))

    def _spread(self, faces: Ints, inner: Ints) -> float:
        from scipy.sparse.linalg import splu

        G = self._F[faces]
        if not len(inner):
            return 0.0
        matrix = self._laplacian[inner][:, inner].T  # itself, in the format that is wanted
        scale = np.zeros(len(self._n_faces))
        try:
            solver = splu(matrix, permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True})
            scale[inner] = solver.solve(self._curvature[inner])
        except RuntimeError:  # singular: faces without area
            return np.inf
        u = scale[G].mean(1)
        order = np.argsort(u)
        share = np.cumsum(self._area[faces][order])
        low, high = np.searchsorted(share, [0.005 * share[-1], 0.995 * share[-1]])
        return float(u[order[min(high, len(u) - 1)]] - u[order[low]])

    def _inner(self, faces: Ints) -> Ints:
        """List the vertices around which all faces are among these."""
        n = np.bincount(self._F[faces].ravel(), minlength=len(self._n_faces))
        return np.flatnonzero(n == self._n_faces)
