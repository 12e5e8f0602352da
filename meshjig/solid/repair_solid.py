"""A solid that is folded, put together anew from convex prisms where it is."""

from __future__ import annotations

import numpy as np

from meshjig.mesh.booleans import Body, body, sound
from meshjig.solid.crossing_pairs import at_any_corner, crossing_pairs
from meshjig.solid.pieces import OUTER, Solid, solidify

__all__ = ["mended"]


def mended(solid: Solid, width: int) -> Body | None:
    """Replace the folded part of a piece by a union of prisms, one under each outer face.

    Parameters
    ----------
    solid : Solid
    width : int, how many rings of faces around a crossing are replaced

    Returns
    -------
    body, or None when the solid crosses itself nowhere
    """
    import manifold3d

    crossing = crossing_pairs(solid.V, solid.F)[0]
    if not len(crossing):
        return None
    m = int((solid.kind == OUTER).sum())
    n = len(solid.V) // 2
    outer, X, Y = solid.F[:m], solid.V[:n], solid.V[n:]
    folded = np.zeros(n, bool)
    folded[solid.F[crossing.ravel()].ravel() % n] = True
    for _ in range(width - 1):
        folded[outer[at_any_corner(folded, outer)]] = True
    region = at_any_corner(folded, outer)
    prisms = [manifold3d.Manifold.hull_points(np.concatenate([X[face], Y[face]])) for face in outer[region]]
    bodies = [prism for prism in prisms if sound(prism)]
    if not region.all():
        rest = solidify(X, outer[~region], np.zeros(int((~region).sum()), np.int64), Y - X)[0][0]
        bodies.append(body(rest.V, rest.F))
    return manifold3d.Manifold.batch_boolean(bodies, manifold3d.OpType.Add)
