"""Which seams between regions are closed inside the charts that regions were glued to."""

import numpy as np

from meshjig.charts.chart import Chart
from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.chains import edge_chains
from meshjig.mesh.halfedges import Edges
from meshjig.mesh.mesh import Mesh

__all__ = ["GluedSeams"]


class GluedSeams:
    """The seams between the regions of a mesh, and those of its proxy that tell which of them are closed.

    Parameters
    ----------
    mesh : Mesh, one component
    region : (m,) int64, 0 to k - 1
    proxy : Mesh
    proxy_region : (m',) int64, 0 to k - 1
    """

    def __init__(self, mesh: Mesh, region: Ints, proxy: Mesh, proxy_region: Ints) -> None:
        self._mesh, self._proxy = mesh, proxy
        e = mesh.edges
        self._sides, self._proxy_sides = _sides(e, region), _sides(proxy.edges, proxy_region)
        rows = np.flatnonzero(self._sides[:, 0] != self._sides[:, 1])
        border = np.unique(e.E[e.n_faces == 1])
        self._chains = [rows[chain] for chain in edge_chains(e.E[rows], border)]

    def cuts(self, is_chosen: Bools, chart: Chart) -> Bools:
        """Tell which edges of the mesh are cut: all between regions but those closed inside a chart, (e,).

        Parameters
        ----------
        is_chosen : (k,) bool, the regions that make up the chart
        chart : Chart, of the proxy
        """
        cut = self._sides[:, 0] != self._sides[:, 1]
        corners = np.full((len(self._proxy.F), 3), -1)
        corners[chart.faces] = chart.corners
        closed = _closed(self._proxy.edges, corners)
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
        """The stretches of two regions' seams that are closed, going by the nearest place on the proxy.

        Each closed stretch of the proxy closes one here: another, be it a single edge long, would be a
        bridge that leaves a hole.
        """
        proxy, E = self._proxy.edges, self._mesh.edges.E
        rows = np.flatnonzero((self._proxy_sides == pair).all(1))
        if not closed[rows].any():
            return []
        run = np.full(len(rows), -1)
        shut = np.flatnonzero(closed[rows])
        runs = edge_chains(proxy.E[rows[shut]], rows[:0])
        for number, found in enumerate(runs):
            run[shut[found]] = number
        middle = self._proxy.V[proxy.E[rows]].mean(1)
        near = [run[_nearest(self._mesh.V[E[seam]].mean(1), middle)] for seam in seams]
        length = [np.linalg.norm(np.diff(self._mesh.V[E[seam]], axis=1)[:, 0], axis=1) for seam in seams]
        glued = []
        for number in range(len(runs)):
            gains = [np.where(n == number, along, -along) for n, along in zip(near, length, strict=True)]
            stretches = [_best_stretch(gain) for gain in gains]
            sums = [float(gain[stretch].sum()) for gain, stretch in zip(gains, stretches, strict=True)]
            best = int(np.argmax(sums))
            glued.append(seams[best][stretches[best]])
        return glued


def _nearest(points: Floats, others: Floats) -> Ints:
    """The nearest of some other points for each point, (n,)."""
    # the square of the distance but for what all others share
    off = (others**2).sum(1) - 2 * points @ others.T
    return off.argmin(1)


def _sides(e: Edges, label: Ints) -> Ints:
    """The labels on both sides of every edge, lower first; twice 0 where they are the same, (e, 2)."""
    sides = np.zeros((len(e.E), 2), np.int64)
    here, there = np.repeat(label, 3), label[e.twin // 3]
    h = np.flatnonzero(here != there)
    sides[e.edge_of_halfedge[h]] = np.sort(np.stack([here[h], there[h]], 1), axis=1)
    return sides


def _closed(e: Edges, corners: Ints) -> Bools:
    """Tell over which edges corners (m, 3) are connected, (e,)."""
    h = np.flatnonzero(e.twin > np.arange(len(e.twin)))
    t = e.twin[h]
    G = corners.ravel()
    after = np.roll(corners, -1, 1).ravel()
    closed = np.zeros(len(e.E), bool)
    closed[e.edge_of_halfedge[h]] = (G[h] == after[t]) & (after[h] == G[t]) & (G[h] >= 0)
    return closed


def _best_stretch(gain: Floats) -> slice:
    """The stretch with the largest sum; empty where no sum is above 0."""
    sums = np.append(0, np.cumsum(gain))
    low = np.minimum.accumulate(sums)
    end = int((sums - low).argmax())
    return slice(int(sums[: end + 1].argmin()), end)
