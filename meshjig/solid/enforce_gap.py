"""Neighbours that are still too near to each other, moved apart where they are."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.booleans import Body, arrays, body, largest, sound
from meshjig.mesh.mesh import Mesh
from meshjig.solid.crossing_pairs import crossing_pairs
from meshjig.solid.cutters import ball

__all__ = ["SPREAD", "enforce_gap"]

_ENOUGH = 0.97  # of the clearance
_WANTED = 0.995
_RADIUS = 0.53  # of the clearance, of the dents
_ROUNDS = 5
_SHORTEST = 0.003  # mm; details of the booleans below this are dissolved
_DEPTH = 0.005  # mm; shallower crossings are rounding
_MOST_DENTS = 400

# weights of a triangle's corners that give points all over it
SPREAD = np.array([(a, b, 4 - a - b) for a in range(5) for b in range(5 - a)]) / 4


def enforce_gap(
    pieces: Mapping[int, Mesh | tuple[Floats, Ints]], pairs: Ints, clearance: float
) -> dict[int, tuple[Floats, Ints, float]]:
    """Dent pieces where a neighbour is nearer than the gap, whatever the reason.

    Walls that cross, or sheets of a thin limb that face each other, leave such places; their walls' slabs
    don't reach there.

    Parameters
    ----------
    pieces : dict of (V, F), by piece number
    pairs : (k, 2) int64, neighbours; pairs of which a piece is missing are skipped
    clearance : float, mm

    Returns
    -------
    dict of (V, F, lost) : the pieces that have changed, and the volume of what came off, mm3

    Notes
    -----
    Pieces that overlap are left as they are, and so is a pair that is near all over.
    """
    pairs = pairs[[i in pieces and j in pieces for i, j in pairs.tolist()]]
    bodies = {i: body(*pieces[i]) for i in np.unique(pairs).tolist()}
    lost: dict[int, float] = {}
    for i, j in pairs.tolist():
        for _ in range(_ROUNDS):
            near = bodies[i].min_gap(bodies[j], clearance)
            if near >= _ENOUGH * clearance or near == 0:
                break
            between = _contacts(bodies[i], bodies[j], clearance)
            if not 0 < len(between) <= _MOST_DENTS:
                break
            dents = _balls(between, _RADIUS * clearance)
            smaller = {k: largest((bodies[k] - dents).simplify(_SHORTEST)) for k in (i, j)}
            if not all(_usable(rest) for rest, _, _ in smaller.values()):
                break
            for k, (rest, gone, _) in smaller.items():
                bodies[k], lost[k] = rest, lost.get(k, 0.0) + gone
    return {i: (*arrays(bodies[i]), gone) for i, gone in sorted(lost.items())}


def _usable(piece: Body) -> bool:
    return sound(piece) and not (crossing_pairs(*arrays(piece))[1] > _DEPTH).any()


def _contacts(first: Body, second: Body, clearance: float) -> Floats:
    """Give points midway between two bodies where they are too near, (k, 3), not much denser than needed."""
    import igl

    found = []
    for (V, F), (W, G) in ((arrays(first), arrays(second)), (arrays(second), arrays(first))):
        low, high = W.min(0) - clearance, W.max(0) + clearance
        corners = V[F]
        corners = corners[((corners.max(1) >= low) & (corners.min(1) <= high)).all(1)]
        P = (corners[:, None] * SPREAD[None, :, :, None]).sum(2).reshape(-1, 3)
        if not len(P):
            continue
        squared, _, foot = igl.point_mesh_squared_distance(P, W, G)
        close = squared < (_WANTED * clearance) ** 2
        found.append((P[close] + foot[close]) / 2)
    points = np.concatenate([np.empty((0, 3)), *found])
    _, first_of_cell = np.unique(np.floor(points / (clearance / 4)), axis=0, return_index=True)
    return points[np.sort(first_of_cell)]


def _balls(centres: Floats, radius: float) -> Body:
    import manifold3d

    hulls = [manifold3d.Manifold.hull_points(centre + radius * ball()) for centre in centres]
    return manifold3d.Manifold.batch_boolean(hulls, manifold3d.OpType.Add)
