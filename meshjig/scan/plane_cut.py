"""Cut a mesh along a level plane: what lies above stays, in one piece with its new border."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.halfedges import compact, edges

__all__ = ["PlaneCut", "cut_level"]

_SNAP = 1e-6  # of the extent: vertices nearer to the plane count as above, so that no sliver comes of them


class PlaneCut(NamedTuple):
    """The part of a mesh above a plane."""

    V: Floats  # (n, 3)
    F: Ints  # (m, 3)
    on_plane: Bools  # (n,), vertices that the cut has made


def cut_level(V: Floats, F: Ints, axis: int, height: float) -> PlaneCut:
    """Cut a mesh at a height along an axis, and keep what is above.

    Parameters
    ----------
    V : (n, 3) float64
    F : (m, 3) int64, manifold
    axis : int, 0, 1 or 2
    height : float, in the units of V

    Returns
    -------
    PlaneCut
        Without faces where nothing is above.
    """
    level = V[:, axis] - height
    snap = _SNAP * float(np.ptp(V, axis=0).max())
    level = np.where(np.abs(level) < snap, snap, level)
    above = level > 0
    e = edges(F)
    cut = np.flatnonzero(above[e.E[:, 0]] != above[e.E[:, 1]])
    a, b = e.E[cut].T
    t = (level[a] / (level[a] - level[b]))[:, None]
    points = (1 - t) * V[a] + t * V[b]
    points[:, axis] = height
    new = np.full(len(e.E), -1)
    new[cut] = len(V) + np.arange(len(cut))
    faces = [F[above[F].all(1)], *_clipped(F, above[F], new[e.edge_of_halfedge].reshape(-1, 3))]
    G, used = compact(np.concatenate(faces))
    return PlaneCut(np.concatenate([V, points])[used], G, used >= len(V))


def _clipped(F: Ints, above: Bools, new: Ints) -> list[Ints]:
    """Give the parts above of faces that the plane cuts, whose cut edges have new vertices (m, 3)."""
    parts = []
    for k in range(3):
        i, j = (k + 1) % 3, (k + 2) % 3
        tip = above[:, k] & ~above[:, i] & ~above[:, j]
        parts.append(np.stack([F[tip, k], new[tip, k], new[tip, j]], 1))
        foot = ~above[:, k] & above[:, i] & above[:, j]
        p, q = new[foot, k], new[foot, j]  # on the edges to the corners after and before
        parts.append(np.stack([p, F[foot, i], F[foot, j]], 1))
        parts.append(np.stack([p, F[foot, j], q], 1))
    return parts
