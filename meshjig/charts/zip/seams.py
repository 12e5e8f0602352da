"""The seams of flattened charts, which can be closed one stretch at a time."""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from meshjig.charts.chart import Chart
from meshjig.charts.cuts import cut_faces
from meshjig.charts.distortion import within_limits
from meshjig.charts.zip.glue import Fit, fits, glue
from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.boundary_loops import border_loop
from meshjig.mesh.chains import edge_chains
from meshjig.mesh.halfedges import edges, next_halfedge
from meshjig.mesh.measure import edge_lengths, face_areas, singular_values

__all__ = ["Arc", "Seams"]

_SHORTEST = 0.08  # of the root of the area: shorter arcs are no bridge
_MAY_LOSE = 0.005  # of the area within FLAT_LIMITS, where there is less of it than wanted
_SHORTEST_OF_SMALL = 0.3  # of the root of the smaller chart's area


class Arc(NamedTuple):
    """A stretch of seam between two charts."""

    rows: Ints  # (k,), of the edge list, in order
    first: int
    second: int
    fit: Fit


class Seams:
    """Flattened charts of one mesh and the cuts between and inside them.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, manifold
    charts : list of Chart, which cover all faces, without cuts inside
    """

    def __init__(self, V: Floats, F: Ints, charts: list[Chart]) -> None:
        self._V, self._F, self._e = V, F, edges(F)
        self.area = face_areas(V, F)
        self.chart = np.empty(len(F), np.int64)  # which chart a face is in; a new chart gets a new number
        self._place = np.empty((len(F), 3), np.complex128)  # of the corners, each in its chart's plane
        self._within = np.empty(len(F))  # area within FLAT_LIMITS, before anything was closed
        self._ring: dict[int, NDArray[np.complex128]] = {}
        for number, chart in enumerate(charts):
            self._put(number, chart.faces, chart.uv, chart.corners)
            s = singular_values(V, F[chart.faces], chart.uv, chart.corners)
            self._within[chart.faces] = self.area[chart.faces] * within_limits(s)
        twin = self._e.twin
        h = np.flatnonzero(twin > np.arange(len(twin)))
        self._half = np.full(len(self._e.E), -1)  # a half-edge of each inner edge
        self._half[self._e.edge_of_halfedge[h]] = h
        self._cut = np.zeros(len(self._e.E), bool)
        self._cut[self._e.edge_of_halfedge[h]] = self.chart[h // 3] != self.chart[twin[h] // 3]
        self._length = edge_lengths(V, self._e.E)
        self._rim = np.unique(self._e.E[self._e.n_faces == 1])

    def charts(self) -> list[Chart]:
        """The charts as they are."""
        out = []
        for number in self.numbers():
            faces = np.flatnonzero(self.chart == number)
            corners = cut_faces(self._F, self._e, self._cut, faces)
            uv = np.empty((int(corners.max()) + 1, 2))
            uv[corners] = np.stack([self._place[faces].real, self._place[faces].imag], -1)
            out.append(Chart(faces, uv, corners))
        return out

    def numbers(self) -> list[int]:
        """List the numbers of the charts."""
        return sorted(self._ring)

    def arcs(self, number: int | None = None) -> list[Arc]:
        """List stretches of seam between different charts, or those of one chart."""
        root, size = np.sqrt(self.area.sum()), np.sqrt(np.bincount(self.chart, self.area))
        found = []
        for chain in self._chains():
            first, second = sorted(self._sides(chain))
            if first == second or number not in (None, first, second):
                continue
            h, twin = self._half[chain], self._e.twin
            h = np.where(self.chart[h // 3] == first, h, twin[h])
            least = min(_SHORTEST * root, _SHORTEST_OF_SMALL * min(size[first], size[second]))
            some = fits(self._middles(h), self._middles(twin[h]), self._length[chain], least)
            found += [Arc(chain[fit.begin : fit.end], first, second, fit) for fit in some]
        return found

    def overlap(self, arc: Arc) -> float:
        """The share of all area by which two charts lie on each other when an arc's sides meet."""
        moved = self._ring[arc.second] * arc.fit.turn + arc.fit.shift
        return float(_polygon(self._ring[arc.first]).intersection(_polygon(moved)).area / self.area.sum())

    def tips(self, number: int, gap: float) -> Ints:
        """List cuts inside a chart, from the tip of each slit to where it opens by a share of its length.

        Parameters
        ----------
        number : int, of the chart
        gap : float

        Returns
        -------
        (k,) int64, rows of the edge list
        """
        degree = np.bincount(self._e.E[self._cut].ravel(), minlength=len(self._V))
        degree[self._rim] = 0
        found = [np.zeros(0, np.int64)]
        for chain in self._chains():
            if self._sides(chain) != (number, number):
                continue
            if (degree[self._e.E[chain[-1]]] == 1).any():
                chain = chain[::-1]
            elif not (degree[self._e.E[chain[0]]] == 1).any():
                continue
            h = self._half[chain]
            opening = abs(self._middles(h) - self._middles(self._e.twin[h]))
            wide = opening > gap * np.cumsum(self._length[chain])
            found.append(chain[: int(wide.argmax()) if wide.any() else len(chain)])
        return np.concatenate(found)

    def close(self, rows: Ints, least_share: float, arc: Arc | None = None) -> tuple[int | None, float]:
        """Close cuts, between two charts where an arc is given, if that makes a good chart.

        Parameters
        ----------
        rows : (k,) int64, of the edge list; all in one chart, or in the arc
        least_share : float
            Of the area that must lie within FLAT_LIMITS, where not less of it did from the first.
        arc : Arc, optional

        Returns
        -------
        number : int or None, of the new chart
        effort : float, about how many faces were flattened
        """
        touched = self._sides(rows) if arc is None else (arc.first, arc.second)
        faces = np.flatnonzero(np.isin(self.chart, touched))
        place = self._place[faces]
        if arc is not None:
            second = self.chart[faces] == arc.second
            place[second] = place[second] * arc.fit.turn + arc.fit.shift
        closed = self._cut.copy()
        closed[rows] = False
        before, after = (cut_faces(self._F, self._e, cut, faces) for cut in (self._cut, closed))
        within = float(self._within[faces].sum() / self.area[faces].sum())
        least_share = min(least_share, within - _MAY_LOSE)
        made, effort = glue(self._V, self._F[faces], before, after, place, least_share)
        if made is None:
            return None, effort
        self._cut = closed
        number = max(self._ring) + 1
        for old in set(touched):
            del self._ring[old]
        self._put(number, faces, *made)
        return number, effort

    def _put(self, number: int, faces: Ints, uv: Floats, corners: Ints) -> None:
        z = uv[:, 0] + 1j * uv[:, 1]
        self.chart[faces], self._place[faces] = number, z[corners]
        self._ring[number] = z[border_loop(corners)]

    def _chains(self) -> list[Ints]:
        rows = np.flatnonzero(self._cut)
        return [rows[chain] for chain in edge_chains(self._e.E[rows], self._rim)]

    def _sides(self, rows: Ints) -> tuple[int, int]:
        h = self._half[rows[0]]
        return int(self.chart[h // 3]), int(self.chart[self._e.twin[h] // 3])

    def _middles(self, h: Ints) -> NDArray[np.complex128]:
        place = self._place.ravel()
        middle: NDArray[np.complex128] = (place[h] + place[next_halfedge(h)]) / 2
        return middle


def _polygon(ring: NDArray[np.complex128]) -> Any:
    import shapely

    return shapely.Polygon(np.stack([ring.real, ring.imag], 1))
