"""Close a sheet over its openings."""

from __future__ import annotations

import numpy as np

from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.chains import follow
from meshjig.mesh.components import fans
from meshjig.mesh.halfedges import border_halfedges, next_halfedge
from meshjig.mesh.measure import face_areas, unit

__all__ = ["cap_openings"]


def cap_openings(V: Floats, F: Ints) -> tuple[Floats, Ints, float]:
    """Close every opening by the flattest lid there is.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, manifold

    Returns
    -------
    V : (k, 3) float64, mm; a vertex at which two openings meet is there twice
    F : (m + c, 3) int64, without a border
    area : float, mm2, of the lids
    """
    h = border_halfedges(F)
    if not len(h):
        return V, F, 0.0
    F, origin = fans(F)
    V = V[origin]
    a, b = F.ravel()[h], F.ravel()[next_halfedge(h)]
    before = np.full(len(V), -1)
    before[b] = a
    seen: set[int] = set()
    loops = [follow(before, first, seen) for first in set(b.tolist()) if first not in seen]
    lid = np.concatenate([_lid(V, np.array(loop)) for loop in loops])
    return V, np.concatenate([F, lid]), float(face_areas(V, lid).sum())


def _lid(V: Floats, loop: Ints) -> Ints:
    """Triangulate a loop, seen from where it is widest."""
    import manifold3d

    at = V[loop] - V[loop].mean(axis=0)
    after = np.roll(at, -1, axis=0)
    normal = np.cross(at, after).sum(axis=0)
    side = np.cross(normal, np.eye(3)[np.abs(normal).argmin()])
    flat = at @ unit(np.stack([side, np.cross(normal, side)])).T
    return loop[np.asarray(manifold3d.triangulate([flat]), np.int64)]
