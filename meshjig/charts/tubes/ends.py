"""The two ends of a long shape: open rims, or the tips farthest apart."""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from meshjig.errors import ChartError
from meshjig.mesh.halfedges import edges
from meshjig.mesh.measure import face_areas, unit
from meshjig.mesh.shortest_paths import distances, symmetric

__all__ = ["Ends", "carried_ends", "rims", "two_ends"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

_LEAST_RIM = 0.2  # of the longest rim: a shorter one is a hole, no end
_DEEP = 0.45  # radii: a tube two radii long lies on average one behind its rim, a sheet none
_BLUNT = 0.03  # of the way from end to end, within which vertices belong to the same tip


class Ends(NamedTuple):
    """The vertices of both ends, the lower one first: a whole rim each, or a single tip."""

    first: Ints  # (k,)
    last: Ints  # (l,)


def two_ends(V: Floats, F: Ints) -> Ends:
    """Choose the two ends of one component.

    Parameters
    ----------
    V : (n, 3) float64, mm, y upward
    F : (m, 3) int64, manifold, one component

    Raises
    ------
    ChartError
        The component has handles, or more than two open ends.
    """
    e = edges(F)
    loops = sorted(_loops(F, e.twin), key=lambda rim: -_length(V, rim))
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


def rims(F: Ints) -> list[Ints]:
    """List the border loops of a manifold mesh with their vertices in order, the longest first."""
    return _loops(F, edges(F).twin)


def _loops(F: Ints, twin: Ints) -> list[Ints]:
    h = np.flatnonzero(twin == np.arange(len(twin)))
    follows = dict(zip(F.ravel()[h].tolist(), F[h // 3, (h + 1) % 3].tolist(), strict=True))
    loops = []
    while follows:
        at, after = follows.popitem()
        loop = [at]
        while after in follows:
            loop.append(after)
            after = follows.pop(after)
        loops.append(np.array(loop, np.int64))
    return sorted(loops, key=len, reverse=True)


def _tip(V: Floats, F: Ints, distance: Floats) -> Ints:
    """Give the vertex in the middle of the area that is farthest away."""
    far = distance >= (1 - _BLUNT) * distance.max()
    faces = far[F].any(1)
    middle = np.average(V[F[faces]].mean(1), axis=0, weights=face_areas(V, F[faces]))
    some = np.flatnonzero(far)
    return some[[np.linalg.norm(V[some] - middle, axis=1).argmin()]]


def carried_ends(V: Floats, F: Ints, W: Floats, ends: Ends) -> Ends:
    """Find the ends of a proxy's tube on the mesh itself.

    Parameters
    ----------
    V, F : (n, 3) float64, mm, and (m, 3) int64, the mesh
    W : (n', 3) float64, mm, the proxy's vertices
    ends : Ends, of the proxy
    """
    loops = rims(F)

    def carried(end: Ints) -> Ints:
        if len(end) == 1:
            return np.array([np.linalg.norm(V - W[end], axis=1).argmin()], np.int64)
        return min(loops, key=lambda loop: float(np.linalg.norm(V[loop] - W[end[0]], axis=1).min()))

    return Ends(carried(ends.first), carried(ends.last))
