"""Pieces that touch, overlap or stand too near: one of the two gives way."""

from __future__ import annotations

import numpy as np

from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.booleans import Body, arrays, body, largest, sound
from meshjig.mesh.measure import unit
from meshjig.mesh.mesh import Mesh
from meshjig.solid.crossing_pairs import crossing_pairs
from meshjig.solid.cutters import ball
from meshjig.solid.enforce_gap import SPREAD

__all__ = ["separate"]

_ENOUGH = 0.97  # of the clearance
_INSCRIBED = 0.933  # of the corners' distance: how far the faces of a ball of 42 corners are from its middle
_SHORTEST = (
    0.003,
    0.005,
    0.01,
    0.02,
    0.04,
)  # mm; details below the first, or a later one where it would cross itself
_DEPTH = 0.005  # mm; shallower crossings are rounding
_MOST = 4000  # faces around which room is made


def separate(pieces: dict[int, Mesh], pairs: Ints, clearance: float) -> dict[int, Mesh]:
    """Take from the larger of two pieces all that is nearer to the other than the gap.

    Parameters
    ----------
    pieces : dict of Mesh, by piece number
    pairs : (k, 2) int64, pieces that may be too near to each other
    clearance : float, mm

    Returns
    -------
    dict of Mesh : the pieces that have changed
    """
    bodies = {i: body(*pieces[i]) for i in np.unique(pairs).tolist()}
    changed: set[int] = set()
    for i, j in pairs.tolist():
        small, large = sorted((i, j), key=lambda k: float(bodies[k].volume()))
        room = _around(bodies[small], bodies[large], clearance)
        if room is None:
            continue
        rest = _without_crossings(bodies[large] - room)
        if rest is not None:
            bodies[large] = rest
            changed.add(large)
    return {i: Mesh(*arrays(bodies[i])) for i in sorted(changed)}


def _without_crossings(solid: Body) -> Body | None:
    """Give the largest part of a body, its smallest details dissolved; None where it is no sound piece."""
    found = None
    for shortest in _SHORTEST:
        main, _, _ = largest(solid.simplify(shortest))
        if not sound(main):
            continue
        found = main if found is None else found
        if not (crossing_pairs(*arrays(main))[1] > _DEPTH).any():
            return main
    return found


def _around(solid: Body, other: Body, clearance: float) -> Body | None:
    """Give a body, and what is nearer than the gap to those of its faces that are near to another."""
    import igl
    import manifold3d

    (V, F), (W, G) = arrays(solid), arrays(other)
    low, high = W.min(0) - clearance, W.max(0) + clearance
    corners = V[F]
    corners = corners[((corners.max(1) >= low) & (corners.min(1) <= high)).all(1)]
    if not len(corners):
        return None
    middle = corners.mean(axis=1)
    radius = np.linalg.norm(corners - middle[:, None], axis=2).max(axis=1)
    far = np.sqrt(igl.point_mesh_squared_distance(middle, W, G)[0])
    corners = corners[far < radius + clearance]
    if not len(corners):
        return None
    P = (corners[:, None] * SPREAD[None, :, :, None]).sum(2)
    squared = igl.point_mesh_squared_distance(P.reshape(-1, 3), W, G)[0].reshape(len(P), -1)
    inside = igl.fast_winding_number(W, G, corners.mean(axis=1)) > 0.5
    near = corners[inside | (squared.min(axis=1) < (_ENOUGH * clearance) ** 2)]
    if not 0 < len(near) <= _MOST:
        return None
    points = clearance / _INSCRIBED * _fine_ball()
    hulls = [manifold3d.Manifold.hull_points((c[:, None] + points).reshape(-1, 3)) for c in near]
    return manifold3d.Manifold.batch_boolean([solid, *hulls], manifold3d.OpType.Add)


def _fine_ball() -> Floats:
    """Give the corners of an icosahedron and the middles of its edges, all on the unit ball, (42, 3)."""
    corners = ball()
    i, j = np.triu_indices(len(corners), 1)
    middles = (corners[i] + corners[j])[np.linalg.norm(corners[i] - corners[j], axis=1) < 1.5]
    return unit(np.concatenate([corners, middles]))
