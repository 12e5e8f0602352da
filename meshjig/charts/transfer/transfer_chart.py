"""Transfer flattened charts from a proxy to the full mesh, cuts inside them too."""

import numpy as np

from meshjig.charts.chart import Chart
from meshjig.charts.cuts import cut_faces
from meshjig.charts.distortion import (
    flat_share,
    is_unflipped,
    ring_is_simple,
    share_within_limits,
    unit_stretch,
)
from meshjig.charts.flatten.isometry import slim
from meshjig.charts.flatten.untangle import separate_border, untangle
from meshjig.charts.transfer.glued_seams import GluedSeams
from meshjig.charts.transfer.local_arap import local_arap
from meshjig.mesh.arrays import Bools, Floats, Ints, connected
from meshjig.mesh.boundary_loops import single_loop
from meshjig.mesh.closest_points import Nearest, nearest
from meshjig.mesh.halfedges import compact, edges
from meshjig.mesh.measure import face_areas, face_sides, singular_values
from meshjig.mesh.mesh import Mesh

__all__ = ["ChartTransfer", "without_outliers"]

_MAY_LOSE = 0.03
_LITTLE = 0.01  # of the area may leave FLAT_LIMITS as mirrored faces are turned back; SLIM brings more back
_ITERATIONS = 5  # of it
_HEAVY = 40_000  # faces, for which it takes too long
_LONGEST = 3.0  # an edge in the plane over the edge in space


class ChartTransfer:
    """Transfers charts of a proxy to a mesh whose faces know the proxy's regions.

    Regions have no cuts inside; a chart is made of whole regions, glued along parts of the seams
    between them. So a face's region tells on which side of a cut it is.

    Parameters
    ----------
    mesh : Mesh, one component
    region : (m,) int64, 0 to k - 1
    proxy : Mesh
    proxy_region : (m',) int64, 0 to k - 1
    places : Nearest, of all vertices on the proxy, where the caller has them
    details : bool, whether to look for details of the mesh that the proxy has not seen
    """

    def __init__(
        self,
        mesh: Mesh,
        region: Ints,
        proxy: Mesh,
        proxy_region: Ints,
        places: Nearest | None = None,
        details: bool = True,
    ) -> None:
        self.mesh, self.region = mesh, region
        self._proxy, self._proxy_region = proxy, proxy_region
        self._places = nearest(mesh.V, proxy.V, proxy.F) if places is None else places
        self._n_regions, self._details = int(max(region.max(), proxy_region.max())) + 1, details
        self._seams = GluedSeams(mesh, region, proxy, proxy_region)

    def apply(self, chart: Chart, may_lose: float = _MAY_LOSE) -> Chart | None:
        """Flatten a chart's part of the mesh as the proxy's is; None where that makes no sound chart.

        Parameters
        ----------
        chart : Chart, of the proxy
        may_lose : float, share of the area that may leave FLAT_LIMITS for mirrored faces to be turned
            back and borders to be drawn apart
        """
        is_chosen = np.zeros(self._n_regions, bool)
        is_chosen[self._proxy_region[chart.faces]] = True
        faces = np.flatnonzero(is_chosen[self.region])
        if not len(faces):  # none of the mesh was nearest to them
            return None
        cut = self._seams.cuts(is_chosen, chart)
        corners = cut_faces(self.mesh.F, self.mesh.edges, cut, faces)
        border = self._border(cut, faces, corners)
        if border is None:
            return None
        origin = np.empty(int(corners.max()) + 1, np.int64)
        origin[corners] = self.mesh.F[faces]
        X = self.mesh.V[origin]
        guess = without_outliers(X, corners, self._first_guess(chart, faces, corners))
        stretch = singular_values(X, corners, guess)
        wanted = share_within_limits(face_areas(X, corners), stretch)
        uv = untangle(X, corners, guess, stretch=stretch)
        if self._details:
            uv = local_arap(X, corners, uv, border=border)
        if (
            len(faces) <= _HEAVY
            and is_unflipped(uv, corners)
            and flat_share(X, corners, uv) < wanted - _LITTLE
        ):
            uv = slim(X, corners, uv, _ITERATIONS)
        uv = separate_border(X, corners, uv, border=border)
        if not (is_unflipped(uv, corners) and ring_is_simple(uv[border])):
            return None
        uv = unit_stretch(X, corners, uv)
        if flat_share(X, corners, uv) < wanted - may_lose:
            return None  # too much was pulled along
        return Chart(faces, uv, corners)

    def _border(self, cut: Bools, faces: Ints, corners: Ints) -> Ints | None:
        """The corners along the border of faces cut open; None where they are no disc."""
        e, h = self.mesh.edges, (3 * faces[:, None] + np.arange(3)).ravel()
        rim = np.flatnonzero(cut[e.edge_of_halfedge[h]] | (e.twin[h] == h))
        n, ends = int(corners.max()) + 1, np.stack([corners.ravel(), np.roll(corners, -1, 1).ravel()], 1)[rim]
        # a cut that nothing ends at opens nothing
        start, end = ends[~np.isin(ends @ [1, n], ends @ [n, 1])].T
        if 2 * n - (3 * len(faces) + len(start)) + 2 * len(faces) != 2:
            return None
        return single_loop(start, end)

    def _first_guess(self, chart: Chart, faces: Ints, corners: Ints) -> Floats:
        """Place corners where their region says, and corners of several regions in the middle."""
        n = int(corners.max()) + 1
        total, count = np.zeros((n, 2)), np.zeros(n)
        number = np.full(len(self._proxy.F), -1)
        number[chart.faces] = np.arange(len(chart.faces))
        for region in np.unique(self._proxy_region[chart.faces]):
            own = self.region[faces] == region
            G, kept = compact(self.mesh.F[faces[own]])
            row = np.empty(len(kept), np.int64)
            row[G] = corners[own]
            face, bary = self._places.face[kept], self._places.bary[kept]
            there = chart.faces[self._proxy_region[chart.faces] == region]
            other = (self._proxy_region[face] != region) | (number[face] < 0)
            strange = np.flatnonzero(other)  # nearer to another region
            if len(strange):
                again = nearest(self.mesh.V[kept[strange]], self._proxy.V, self._proxy.F[there])
                face[strange], bary[strange] = there[again.face], again.bary
            total[row] += Nearest(number[face], bary).interpolated(chart.corners, chart.uv)
            count[row] += 1
        return total / count[:, None]


def without_outliers(V: Floats, F: Ints, uv: Floats) -> Floats:
    """Place outliers at the mean of their neighbours.

    Where two sheets of a surface come close, a vertex may be taken for one of the other sheet. Edges
    that become much too long give it away: outliers are joined to the rest by such edges only.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, one disc that uses every vertex
    uv : (n, 2) float64, mm

    Returns
    -------
    uv : (n, 2) float64, mm; itself where there are none
    """
    from scipy.sparse import coo_matrix, diags
    from scipy.sparse.linalg import spsolve

    n = len(V)
    ab, ac, bc = _sound_sides(V, F, uv)
    if (ab & ac & bc).all():
        return uv
    bc &= ~(ab & ac)  # no need to join what is connected
    rows = np.concatenate([F[ab, 0], F[ac, 0], F[bc, 1]])
    cols = np.concatenate([F[ab, 1], F[ac, 2], F[bc, 2]])
    _, part = connected(n, rows, cols)
    out = part != np.bincount(part).argmax()
    if not out.any():
        return uv
    E = edges(F).E
    W = coo_matrix((np.ones(len(E)), E.T), shape=(n, n)).tocsr()
    W = W + W.T
    L = (diags(np.asarray(W.sum(1)).ravel()) - W).tocsr()[out]
    placed = uv.copy()
    placed[out] = spsolve(L[:, out].tocsc(), -(L[:, ~out] @ uv[~out])).reshape(-1, 2)
    return placed


def _sound_sides(V: Floats, F: Ints, uv: Floats) -> tuple[Bools, Bools, Bools]:
    """Tell which sides of faces are not much too long: from corner 0 to 1, 0 to 2 and 1 to 2, (m,) each."""
    sound = np.empty((3, len(F)), bool)
    for (some, p, q), (_, d, e) in zip(face_sides(uv, F), face_sides(V, F), strict=True):
        flat, long = ([x, y, [b - a for a, b in zip(x, y, strict=True)]] for x, y in ((p, q), (d, e)))
        for k in range(3):
            sound[k, some] = sum(x * x for x in flat[k]) <= _LONGEST**2 * sum(x * x for x in long[k])
    return sound[0], sound[1], sound[2]
