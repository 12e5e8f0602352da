"""Whether a piece is the boundary of one solid: closed, oriented, in one part, the right way out.

All of it is decided on the faces' corners, exactly. Nothing here tells whether the surface passes
through itself: see self_intersection.py.
"""

import numpy as np

from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.components import components, fans
from meshjig.mesh.measure import mesh_volume
from meshjig.mesh.validated import weld

__all__ = ["as_stl", "is_closed", "is_closed_as_stl", "is_one_component", "volume"]

_DECIMALS = 8  # of a mm, that readers tell apart


def is_closed(F: Ints) -> bool:
    """Prove that faces form a closed, oriented 2-manifold.

    Every edge has exactly two faces, which run along it in opposite directions, and the faces at
    every vertex form one fan.

    Parameters
    ----------
    F : (m, 3) int64

    Returns
    -------
    bool
        False also for no faces, and for a face that names a vertex twice.
    """
    if not len(F):
        return False
    tail, head = F.ravel(), F[:, [1, 2, 0]].ravel()
    if (tail == head).any():
        return False
    n = np.int64(F.max()) + 1
    along, back = np.sort(tail * n + head), np.sort(head * n + tail)
    if (along[1:] == along[:-1]).any() or (along != back).any():
        return False
    return len(fans(F)[1]) == len(np.unique(tail))


def as_stl(V: Floats, F: Ints) -> tuple[Floats, Ints]:
    """Give a piece as it comes back from an STL: float32 coordinates, equal vertices merged.

    STL keeps no indices: vertices that round to one place become one vertex, for every reader; for some so do
    those nearer to each other than 1e-8 mm, which 32 bits tell apart around 0. A
    micro-edge collapses by it, which is harmless if what remains is a manifold; a vertex that only
    the indices kept apart becomes a pinch, which is not.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64

    Returns
    -------
    V : (k, 3) float64, mm
    F : (l, 3) int64, without the faces that have lost a corner
    """
    with np.errstate(over="ignore"):
        single: Floats = V.astype(np.float32).astype(np.float64)
    return weld(np.round(single, _DECIMALS), F)


def is_closed_as_stl(V: Floats, F: Ints) -> bool:
    """Prove that a piece is closed, and still is when it comes back from an STL.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64
    """
    G = as_stl(V, F)[1]
    return is_closed(F) and (np.array_equal(F, G) or is_closed(G))


def is_one_component(F: Ints) -> bool:
    """Prove that faces are connected over shared edges, all of them."""
    return components(F)[0] == 1


def volume(V: Floats, F: Ints) -> float:
    """Give the signed volume of a closed piece, mm3; negative when it is inside out.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64
    """
    return mesh_volume(V - V[F[0, 0]], F)
