"""Carry flattened charts from a proxy to the full mesh, cuts inside them too."""

import numpy as np

from meshjig.charts.chart import Chart
from meshjig.charts.cuts import chains, cut_faces
from meshjig.charts.distortion_limits import within_limits
from meshjig.charts.flatten.flatten import flat_share, is_unflipped, ring_is_simple, unit_stretch
from meshjig.charts.flatten.separate_border import part
from meshjig.charts.flatten.slim import slim
from meshjig.charts.flatten.untangle import untangle
from meshjig.charts.segment.region import single_loop
from meshjig.charts.transfer.local_arap import settle
from meshjig.charts.transfer.outliers import without_strays
from meshjig.mesh.closest_points import Nearest, nearest
from meshjig.mesh.halfedges import Edges, compact, edges
from meshjig.mesh.measure import face_areas, singular_values
from meshjig.mesh.types import Bools, Floats, Ints

__all__ = ["Carrier"]

_MAY_LOSE = 0.03
_LITTLE = 0.01  # of the area may leave FLAT_LIMITS as mirrored faces are turned back; SLIM brings more back
_ITERATIONS = 5  # of it
_HEAVY = 40_000  # faces, for which it takes too long


class Carrier:
    """Takes charts of a proxy over to a mesh whose faces know the proxy's leaves.

    Leaves are regions without cuts inside; a chart is made of whole leaves, glued along parts of
    the seams between them. So a face's leaf tells on which side of a cut it is.

    Parameters
    ----------
    V, F : (n, 3) float64, mm, and (m, 3) int64, the mesh, one component
    leaf : (m,) int64, 0 to k - 1
    W, G : (n', 3) float64, mm, and (m', 3) int64, the proxy
    light_leaf : (m',) int64, 0 to k - 1
    e : Edges, of F, where the caller has them
    places : Nearest, of all V on the proxy, where the caller has them
    settles : bool, whether to look for details of the mesh that the proxy has not seen
    """

    def __init__(
        self,
        V: Floats,
        F: Ints,
        leaf: Ints,
        W: Floats,
        G: Ints,
        light_leaf: Ints,
        e: Edges | None = None,
        places: Nearest | None = None,
        settles: bool = True,
    ) -> None:
        self._V, self._F, self.leaf = V, F, leaf
        self._W, self._G, self._light_leaf = W, G, light_leaf
        self._places = nearest(V, W, G) if places is None else places
        self._n_leaves, self._settles = int(max(leaf.max(), light_leaf.max())) + 1, settles
        self._e, self._light = edges(F) if e is None else e, edges(G)
        self._sides, self._light_sides = _sides(self._e, leaf), _sides(self._light, light_leaf)
        rim = np.unique(self._e.E[self._e.n_faces == 1])
        rows = np.flatnonzero(self._sides[:, 0] != self._sides[:, 1])
        self._chains = [rows[chain] for chain in chains(self._e.E[rows], rim)]

    def carry(self, chart: Chart, may_lose: float = _MAY_LOSE) -> Chart | None:
        """Flatten a chart's part of the mesh as the proxy's is; None where that makes no sound chart.

        Parameters
        ----------
        chart : Chart, of the proxy
        may_lose : float, share of the area that may leave FLAT_LIMITS for mirrored faces to be turned
            back and borders to be drawn apart
        """
        is_chosen = np.zeros(self._n_leaves, bool)
        is_chosen[self._light_leaf[chart.faces]] = True
        faces = np.flatnonzero(is_chosen[self.leaf])
        if not len(faces):  # none of the mesh was nearest to them
            return None
        cut = self._cut_around(is_chosen, chart)
        corners = cut_faces(self._F, self._e, cut, faces)
        border = self._border(cut, faces, corners)
        if border is None:
            return None
        origin = np.empty(int(corners.max()) + 1, np.int64)
        origin[corners] = self._F[faces]
        X = self._V[origin]
        guess = without_strays(X, corners, self._first_guess(chart, faces, corners))
        stretch = singular_values(X, corners, guess)
        wanted = within_limits(face_areas(X, corners), stretch)
        uv = untangle(X, corners, guess, stretch=stretch)
        if self._settles:
            uv = settle(X, corners, uv, border=border)
        if (
            len(faces) <= _HEAVY
            and is_unflipped(uv, corners)
            and flat_share(X, corners, uv) < wanted - _LITTLE
        ):
            uv = slim(X, corners, uv, _ITERATIONS)
        uv = part(X, corners, uv, border=border)
        if not (is_unflipped(uv, corners) and ring_is_simple(uv[border])):
            return None
        uv = unit_stretch(X, corners, uv)
        if flat_share(X, corners, uv) < wanted - may_lose:
            return None  # too much was pulled along
        return Chart(faces, uv, corners)

    def _border(self, cut: Bools, faces: Ints, corners: Ints) -> Ints | None:
        """Give the corners along the border of faces cut open; None where they are no disc."""
        h = (3 * faces[:, None] + np.arange(3)).ravel()
        rim = np.flatnonzero(cut[self._e.edge_of_halfedge[h]] | (self._e.twin[h] == h))
        n, ends = int(corners.max()) + 1, np.stack([corners.ravel(), np.roll(corners, -1, 1).ravel()], 1)[rim]
        # a cut that nothing ends at opens nothing
        start, end = ends[~np.isin(ends @ [1, n], ends @ [n, 1])].T
        if 2 * n - (3 * len(faces) + len(start)) + 2 * len(faces) != 2:
            return None
        return single_loop(start, end)

    def _cut_around(self, is_chosen: Bools, chart: Chart) -> Bools:
        """Tell which edges are cut: all between leaves but those that are closed inside a chart, (e,)."""
        cut = self._sides[:, 0] != self._sides[:, 1]
        corners = np.full((len(self._G), 3), -1)
        corners[chart.faces] = chart.corners
        closed = _closed(self._light, corners)
        seams: dict[tuple[int, int], list[Ints]] = {}
        for chain in self._chains:
            low, high = self._sides[chain[0]].tolist()
            if is_chosen[[low, high]].all():
                seams.setdefault((low, high), []).append(chain)
        for pair, chained in seams.items():
            for stretch in self._glued(chained, np.array(pair), closed):
                cut[stretch] = False
        return cut

    def _glued(self, seams: list[Ints], pair: Ints, closed: Bools) -> list[Ints]:
        """Give the stretches of two leaves' seams that are closed, going by the nearest place on the proxy.

        Each closed stretch of the proxy closes one here: another, be it a single edge long, would be a
        bridge that leaves a hole.
        """
        rows = np.flatnonzero((self._light_sides == pair).all(1))
        if not closed[rows].any():
            return []
        run = np.full(len(rows), -1)
        shut = np.flatnonzero(closed[rows])
        runs = chains(self._light.E[rows[shut]], rows[:0])
        for number, found in enumerate(runs):
            run[shut[found]] = number
        middle = self._W[self._light.E[rows]].mean(1)
        near = [run[_nearest(self._V[self._e.E[seam]].mean(1), middle)] for seam in seams]
        length = [np.linalg.norm(np.diff(self._V[self._e.E[seam]], axis=1)[:, 0], axis=1) for seam in seams]
        glued = []
        for number in range(len(runs)):
            gains = [np.where(n == number, along, -along) for n, along in zip(near, length, strict=True)]
            stretches = [_best_stretch(gain) for gain in gains]
            sums = [float(gain[stretch].sum()) for gain, stretch in zip(gains, stretches, strict=True)]
            best = int(np.argmax(sums))
            glued.append(seams[best][stretches[best]])
        return glued

    def _first_guess(self, chart: Chart, faces: Ints, corners: Ints) -> Floats:
        """Place corners where their leaf says, and corners of several leaves in the middle."""
        n = int(corners.max()) + 1
        total, count = np.zeros((n, 2)), np.zeros(n)
        number = np.full(len(self._G), -1)
        number[chart.faces] = np.arange(len(chart.faces))
        for leaf in np.unique(self._light_leaf[chart.faces]):
            own = self.leaf[faces] == leaf
            G, kept = compact(self._F[faces[own]])
            row = np.empty(len(kept), np.int64)
            row[G] = corners[own]
            face, bary = self._places.face[kept], self._places.bary[kept]
            light = chart.faces[self._light_leaf[chart.faces] == leaf]
            other = (self._light_leaf[face] != leaf) | (number[face] < 0)
            strange = np.flatnonzero(other)  # nearer to another leaf
            if len(strange):
                again = nearest(self._V[kept[strange]], self._W, self._G[light])
                face[strange], bary[strange] = light[again.face], again.bary
            total[row] += Nearest(number[face], bary).interpolated(chart.corners, chart.uv)
            count[row] += 1
        return total / count[:, None]


def _nearest(points: Floats, others: Floats) -> Ints:
    """Give the nearest of some other points for each point, (n,)."""
    # the square of the distance but for what all others share
    off = (others**2).sum(1) - 2 * points @ others.T
    return off.argmin(1)


def _sides(e: Edges, label: Ints) -> Ints:
    """Give the labels on both sides of every edge, lower first; twice 0 where they are the same, (e, 2)."""
    sides = np.zeros((len(e.E), 2), np.int64)
    here, there = np.repeat(label, 3), label[e.twin // 3]
    h = np.flatnonzero(here != there)
    sides[e.edge_of_halfedge[h]] = np.sort(np.stack([here[h], there[h]], 1), axis=1)
    return sides


def _closed(e: Edges, corners: Ints) -> Bools:
    """Tell over which edges corners hang together."""
    h = np.flatnonzero(e.twin > np.arange(len(e.twin)))
    t = e.twin[h]
    G = corners.ravel()
    after = np.roll(corners, -1, 1).ravel()
    closed = np.zeros(len(e.E), bool)
    closed[e.edge_of_halfedge[h]] = (G[h] == after[t]) & (after[h] == G[t]) & (G[h] >= 0)
    return closed


def _best_stretch(gain: Floats) -> slice:
    """Give the stretch with the largest sum; empty where no sum is above 0."""
    sums = np.append(0, np.cumsum(gain))
    low = np.minimum.accumulate(sums)
    end = int((sums - low).argmax())
    return slice(int(sums[: end + 1].argmin()), end)
