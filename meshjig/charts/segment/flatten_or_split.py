"""Flatten any connected region, splitting it for as long as it makes no sound chart."""

import numpy as np
from numpy.typing import NDArray

from meshjig.charts.flatten.flatten import Method, border_is_simple, flat_share, flatten
from meshjig.charts.segment.dual_graph import dual
from meshjig.charts.segment.patches import patches
from meshjig.errors import ChartError
from meshjig.mesh.components import components, is_disc
from meshjig.mesh.halfedges import compact

__all__ = ["rescue"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


def rescue(
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
        n_parts, of_face = components(G)
        if n_parts == 1:
            uv = _sound(V[kept], G, method, least_share)
            if uv is not None:
                done.append((part, uv))
                continue
            if len(part) == 1:
                raise ChartError(f"face {part[0]} has no area", hint="repair the mesh", ids=[int(part[0])])
            of_face = patches(dual(V[kept], G), 2, seed, rounds=4)
        todo += [part[of_face == p] for p in range(int(of_face.max()) + 1)]
    return done


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
