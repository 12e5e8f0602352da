"""Which cells are discs, which are rings."""

import numpy as np

from meshjig.mesh.components import components
from meshjig.mesh.types import Ints, Mesh

__all__ = ["DISC", "RING", "shapes"]

DISC, RING, OTHER = 1, 0, -99


def shapes(mesh: Mesh, cell: Ints, n: int) -> Ints:
    """Tell what shape cells have.

    Parameters
    ----------
    mesh : Mesh
    cell : (m,) int64, 0 to n - 1
    n : int

    Returns
    -------
    (n,) int64, the Euler number: 1 for a disc, 0 for a ring; -99 for a cell that is empty, in parts, or
    touches itself at a vertex
    """
    F, e = mesh.F, mesh.edges
    twin = e.twin
    h = np.arange(len(twin))
    of, corner = np.repeat(cell, 3), F.ravel()
    on_rim = (twin == h) | (of != of[twin])
    a = np.flatnonzero(~on_rim & (twin > h))
    k, part = components(F, on_rim, twin)
    of_part = np.empty(k, np.int64)
    of_part[part] = cell
    home = np.full(int(F.max(initial=-1)) + 1, -1)
    home[corner] = of
    home[e.E[e.edge_of_halfedge[on_rim]]] = -1  # such a corner may be in several cells
    at_rim = home[corner] < 0
    shared = _distinct(corner[at_rim] * np.int64(n) + of[at_rim])[0]
    n_corners = np.bincount(home[home >= 0], minlength=n) + np.bincount(shared % n, minlength=n)
    n_edges = np.bincount(of[on_rim], minlength=n) + np.bincount(of[a], minlength=n)
    euler = n_corners - n_edges + np.bincount(cell, minlength=n)
    start, count = _distinct(corner[on_rim] * np.int64(n) + of[on_rim])
    pinched = np.bincount(start[count > 1] % n, minlength=n) > 0
    sound = (np.bincount(of_part, minlength=n) == 1) & ~pinched
    return np.where(sound, euler, OTHER)


def _distinct(keys: Ints) -> tuple[Ints, Ints]:
    """Give the values among keys, in order, and how often each is there."""
    keys = np.sort(keys)
    first = np.flatnonzero(np.diff(keys, prepend=-1))
    return keys[first], np.diff(first, append=len(keys))
