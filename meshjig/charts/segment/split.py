"""Split regions of a mesh until each is as it should be, or flattens to a sound chart."""

from collections.abc import Callable

import numpy as np

from meshjig.charts.distortion import border_is_simple, flat_share
from meshjig.charts.flatten.flatten import Method, flatten
from meshjig.charts.segment.dual_graph import dual_graph, patches
from meshjig.errors import ChartError
from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.components import components, is_disc
from meshjig.mesh.halfedges import compact
from meshjig.mesh.mesh import Mesh

__all__ = ["flatten_or_split", "split"]


def split(mesh: Mesh, label: Ints, is_good: Callable[[Ints], bool], seed: int) -> Ints:
    """Take apart what is not connected, and halve what is not good.

    Parameters
    ----------
    mesh : Mesh, manifold
    label : (m,) int64
    is_good : callable, tells whether faces (k,) are connected and may stay so; not asked about single ones
    seed : int

    Returns
    -------
    label : (m,) int64, 0 to k - 1
    """
    out = np.empty(len(mesh.F), np.int64)
    todo = [np.flatnonzero(label == k) for k in np.unique(label)]
    n = 0
    while todo:
        faces = todo.pop()
        if len(faces) == 1 or is_good(faces):
            out[faces] = n
            n += 1
        else:
            todo += _parts(mesh.V, mesh.F, faces, seed)
    return out


def flatten_or_split(
    V: Floats, F: Ints, faces: Ints, method: Method, seed: int, least_share: float = 0.0
) -> list[tuple[Ints, Floats]]:
    """Make sound charts of some faces, at whatever number.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, manifold
    faces : (k,) int64
    method : str
    seed : int
    least_share : float
        Of the area that must lie within FLAT_LIMITS.

    Returns
    -------
    list of (faces, uv) : the charts; uv belongs to the vertices that compact(F[faces]) keeps

    Raises
    ------
    ChartError
        A face has no area.
    """
    done = []
    todo = [faces]
    while todo:
        part = todo.pop()
        G, kept = compact(F[part])
        uv = _sound(V[kept], G, method, least_share)
        if uv is not None:
            done.append((part, uv))
        elif len(part) == 1:
            raise ChartError(f"face {part[0]} has no area", hint="repair the mesh", ids=[int(part[0])])
        else:
            todo += _parts(V, F, part, seed)
    return done


def _parts(V: Floats, F: Ints, faces: Ints, seed: int) -> list[Ints]:
    """Take faces apart where they are not connected, else halve them."""
    G, kept = compact(F[faces])
    n, part = components(G)
    if n == 1:
        part = patches(dual_graph(V[kept], G), 2, seed, rounds=4)
    return [faces[part == p] for p in range(int(part.max()) + 1)]


def _sound(V: Floats, F: Ints, method: Method, least_share: float) -> Floats | None:
    """Flatten faces; None where they are no disc, fold, overlap themselves or hardly lie flat."""
    if not is_disc(F):
        return None
    try:
        uv = flatten(V, F, method)
    except ChartError:
        return None
    flat = len(F) == 1 or flat_share(V, F, uv) >= least_share
    return uv if flat and border_is_simple(uv, F) else None
