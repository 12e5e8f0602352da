"""The two ends of a tube, how far along it a place is, and its girth there."""

from typing import Any, NamedTuple

import numpy as np

from meshjig.errors import ChartError
from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.boundary_loops import borders_by_length
from meshjig.mesh.measure import face_areas, unit
from meshjig.mesh.mesh import Mesh
from meshjig.mesh.shortest_paths import distances, symmetric

__all__ = ["Ends", "Girths", "girths", "harmonic_function", "transferred_ends", "two_ends"]

_LEAST_RIM = 0.2  # of the longest rim: a shorter one is a hole, no end
_DEEP = 0.45  # radii: a tube two radii long lies on average one behind its rim, a sheet none
_BLUNT = 0.03  # of the distance from end to end, within which vertices belong to the same tip
_SLICES = 120
_THINNEST = 5e-4  # of the area: near tips, slices go down to this
_GROWTH = 1.4  # of slices away from a tip


class Ends(NamedTuple):
    """The vertices of both ends, the lower one first: a whole rim each, or a single tip."""

    first: Ints  # (k,)
    last: Ints  # (l,)

    @property
    def tips(self) -> tuple[bool, bool]:
        """Whether the surface is closed at its first and at its last end."""
        return len(self.first) == 1, len(self.last) == 1


def two_ends(mesh: Mesh) -> Ends:
    """Choose the two ends of one component.

    Parameters
    ----------
    mesh : Mesh, y upward, manifold, one component

    Raises
    ------
    ChartError
        The component has handles, or more than two open ends.
    """
    (V, F), e = mesh, mesh.edges
    loops = sorted(borders_by_length(F, mesh.borders), key=lambda rim: -_length(V, rim))
    if len(V) - len(e.E) + len(F) + len(loops) != 2:
        raise ChartError("the surface has handles, so no rings go around it", hint="use --charts auto")
    graph = symmetric(e.E, np.linalg.norm(V[e.E[:, 0]] - V[e.E[:, 1]], axis=1), len(V))
    found = [rim for rim in loops if _is_open_end(V, F, graph, rim, _LEAST_RIM * _length(V, loops[0]))]
    if len(found) > 2:
        raise ChartError(
            f"the surface has {len(found)} open ends, and a tube has two", hint="use --charts auto"
        )
    if not found:
        found = [_tip(V, F, distances(graph, np.zeros(1, np.int64)))]
    if len(found) < 2:
        found.append(_tip(V, F, distances(graph, found[0])))
    first, last = sorted(found, key=lambda end: float(V[end, 1].mean()))
    return Ends(first, last)


def _is_open_end(V: Floats, F: Ints, graph: Any, rim: Ints, least: float) -> bool:
    """Tell whether the surface leaves the plane of a rim, as a tube does, not a sheet around a hole."""
    spokes = V[rim] - V[rim].mean(0)
    radius = float(np.linalg.norm(spokes, axis=1).mean())
    normal = unit(np.cross(spokes, np.roll(spokes, -1, 0)).sum(0))
    near = F[distances(graph, rim, 2 * radius)[F].mean(1) <= 2 * radius]
    if _length(V, rim) < least or not len(near):
        return False
    height = (V[near].mean(1) - V[rim].mean(0)) @ normal
    return abs(float(np.average(height, weights=face_areas(V, near)))) >= _DEEP * radius


def _length(V: Floats, rim: Ints) -> float:
    return float(np.linalg.norm(V[rim] - V[np.roll(rim, -1)], axis=1).sum())


def _tip(V: Floats, F: Ints, distance: Floats) -> Ints:
    """The vertex in the middle of the area that is farthest away."""
    far = distance >= (1 - _BLUNT) * distance.max()
    faces = far[F].any(1)
    middle = np.average(V[F[faces]].mean(1), axis=0, weights=face_areas(V, F[faces]))
    some = np.flatnonzero(far)
    return some[[np.linalg.norm(V[some] - middle, axis=1).argmin()]]


def transferred_ends(V: Floats, F: Ints, W: Floats, ends: Ends) -> Ends:
    """Find the ends of a proxy's tube on the mesh itself.

    Parameters
    ----------
    V, F : (n, 3) float64, mm, and (m, 3) int64, the mesh
    W : (n', 3) float64, mm, the proxy's vertices
    ends : Ends, of the proxy
    """
    loops = borders_by_length(F)

    def transferred(end: Ints) -> Ints:
        if len(end) == 1:
            return np.array([np.linalg.norm(V - W[end], axis=1).argmin()], np.int64)
        return min(loops, key=lambda loop: float(np.linalg.norm(V[loop] - W[end[0]], axis=1).min()))

    return Ends(transferred(ends.first), transferred(ends.last))


class Girths(NamedTuple):
    """A tube in thin slices from end to end."""

    level: Floats  # (k + 1,), heights between the slices, the ends included
    area: Floats  # (k,), mm2
    girth: Floats  # (k,), mm around the middle of each slice

    @property
    def run(self) -> Floats:
        """How long each slice is along the tube, (k,), mm."""
        length: Floats = self.area / np.maximum(self.girth, 1e-300)
        return length

    @property
    def along(self) -> Floats:
        """How far along the tube the slices begin and end, (k + 1,), mm."""
        return np.append(0.0, np.cumsum(self.run))


def harmonic_function(V: Floats, F: Ints, ends: Ends) -> Floats:
    """A harmonic function, 0 at the first end and 1 at the last; (n,).

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
    """The shares of the area below each level between slices."""
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
