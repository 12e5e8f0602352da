"""Regions of one mesh: whether they are discs, and without thin parts."""

from typing import NamedTuple

import numpy as np

from meshjig.charts.segment.clean_labels import clean_labels
from meshjig.mesh.arrays import Bools, Floats, Ints, connected
from meshjig.mesh.boundary_loops import single_loop
from meshjig.mesh.halfedges import edges, next_halfedge
from meshjig.mesh.mesh import Mesh

__all__ = ["Region", "Regions", "inner_vertices", "is_neck_free", "without_necks"]

_SMALL = 30  # faces; smaller regions are not asked for more than to be discs
_TIPS = 4  # thin faces that may always be, or as a share of all:
_TIPS_SHARE = 0.02


class Region(NamedTuple):
    """A disc cut out of a mesh."""

    F: Ints  # (m, 3), into kept
    kept: Ints  # (n,), the mesh's vertices
    loop: Ints  # (b,), into kept: the rim in order, faces on the left


class Regions:
    """Answers what discs faces of one mesh make, at the cost of these faces only.

    Parameters
    ----------
    F : (m, 3) int64, manifold
    """

    def __init__(self, F: Ints) -> None:
        self._F = F
        self._across = edges(F).twin // 3
        h = np.arange(3 * len(F))
        self._across[edges(F).twin == h] = -1
        self._end = F.ravel()[next_halfedge(h)]
        self._inside = np.zeros(len(F) + 1, bool)  # the last stands for what is beyond a border
        self._used = np.zeros(int(F.max(initial=-1)) + 1, bool)
        self._number = np.empty(len(self._used), np.int64)

    def disc(self, faces: Ints) -> Region | None:
        """Give faces (k,) as a disc; None where they are none."""
        self._inside[faces] = True
        h = (3 * faces[:, None] + np.arange(3)).ravel()
        rim = h[~self._inside[self._across[h]]]
        self._inside[faces] = False
        start, end = self._F.ravel()[rim], self._end[rim]
        corners = self._F[faces]
        self._used[corners.ravel()] = True
        kept = np.flatnonzero(self._used)
        self._used[kept] = False
        n_edges = (len(h) + len(rim)) // 2
        if len(kept) - n_edges + len(faces) != 1:
            return None
        self._number[kept] = np.arange(len(kept))
        loop = single_loop(self._number[start], self._number[end])
        return None if loop is None else Region(self._number[corners], kept, loop)


def is_neck_free(region: Region) -> bool:
    """Tell whether a region has neither thin necks nor long thin tips.

    Every two inner vertices must be connected over edges between inner vertices, and only a few
    faces may be away from all faces that have one.
    """
    F, n = region.F, len(region.kept)
    if len(F) < _SMALL:
        return True
    inner = np.ones(n, bool)
    inner[region.loop] = False
    core = inner[F].any(1)
    at_core = np.zeros(n, bool)
    at_core[F[core].ravel()] = True
    if (~at_core[F].any(1)).sum() > max(_TIPS, _TIPS_SHARE * len(F)):
        return False
    # All that is not inner is connected along the rim, so that what is inner has no holes: its Euler
    # number is the number of its parts.
    following = inner[np.roll(F, -1, 1)]
    n_edges = int((inner[F] & following).sum()) // 2
    return int(inner.sum()) - n_edges + int(inner[F].all(1).sum()) <= 1


def without_necks(mesh: Mesh, label: Ints, area: Floats) -> Ints:
    """Cut labels at their thin necks, and give their thin tips to the labels around.

    Parameters
    ----------
    mesh : Mesh, manifold, one component
    label : (m,) int64, 0 to k - 1
    area : (m,) float64, mm2

    Returns
    -------
    label : (m,) int64, 0 to k' - 1
    """
    F, inner = mesh.F, inner_vertices(mesh.F, label)
    ends = mesh.edges.E
    ends = ends[inner[ends].all(1)]
    part = connected(len(inner), *ends.T)[1]
    out = np.where(inner[F], part[F], -1).max(1)
    if (out < 0).all():
        return label
    out[out >= 0] = np.unique(out[out >= 0], return_inverse=True)[1]
    return np.unique(clean_labels(mesh, out, area), return_inverse=True)[1].astype(np.int64)


def inner_vertices(F: Ints, label: Ints) -> Bools:
    """Tell which vertices have faces of one label only, (n,); F (m, 3), label (m,)."""
    n = int(F.max()) + 1
    low, high = np.full(n, len(label)), np.full(n, -1)
    np.minimum.at(low, F.ravel(), np.repeat(label, 3))
    np.maximum.at(high, F.ravel(), np.repeat(label, 3))
    return low == high
