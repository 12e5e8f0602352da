"""The outlines of pieces, each seen from its outer side and turned to lie flat."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from meshjig.mesh.measure import unit
from meshjig.mesh.types import Floats, Ints
from meshjig.output.guide.light_model import Joint
from meshjig.output.plates.footprint import convex_ring, least_rectangle

__all__ = ["Outline", "outlines"]

_FINE = 0.006  # of a piece's extent; drawn no finer


class Outline(NamedTuple):
    """What a piece looks like from outside."""

    ring: Floats  # (k, 2), mm, y up, from (0, 0) on, no higher than wide
    size: Floats  # (2,), width and height, mm


def outlines(joint: Joint) -> list[Outline]:
    """Draw around every piece.

    Parameters
    ----------
    joint : Joint

    Returns
    -------
    list of Outline
        The longest of the curves along which a piece turns away from the eye.
    """
    import shapely

    V, F, piece_of_vertex, outer, outward = joint
    rings: list[Floats | None] = [None] * len(outward)
    for loop in _loops(_border(F[outer], len(V))):
        piece = int(piece_of_vertex[loop[0]])
        ring, longest = V[loop] @ _plane(outward[piece]).T, rings[piece]
        if longest is None or _area(ring) > _area(longest):
            rings[piece] = ring
    made = []
    for piece, found in enumerate(rings):
        ring = V[piece_of_vertex == piece] @ _plane(outward[piece]).T if found is None else found
        fine = _FINE * float(np.ptp(ring, axis=0).max())
        made.append(_lying(shapely.get_coordinates(shapely.simplify(shapely.linearrings(ring), fine))[:-1]))
    return made


def _border(F: Ints, n: int) -> Ints:
    """Give the half-edges without a twin, (k, 2)."""
    a, b = F.ravel(), F[:, [1, 2, 0]].ravel()
    key = np.minimum(a, b) * n + np.maximum(a, b)
    order = np.argsort(key)
    run = key[order]
    alone = np.ones(len(run), bool)
    same = run[1:] == run[:-1]
    alone[1:] &= ~same
    alone[:-1] &= ~same
    chosen = order[alone]
    return np.stack([a[chosen], b[chosen]], 1)


def _loops(border: Ints) -> list[list[int]]:
    """Chain half-edges, at each vertex as many in as out, to closed curves of vertices."""
    onward = np.empty(len(border), np.int64)
    onward[np.argsort(border[:, 1], kind="stable")] = np.argsort(border[:, 0], kind="stable")
    after: list[int] = onward.tolist()
    start: list[int] = border[:, 0].tolist()
    seen = [False] * len(start)
    loops = []
    for first in range(len(start)):
        loop = []
        here = first
        while not seen[here]:
            seen[here] = True
            loop.append(start[here])
            here = after[here]
        if len(loop) > 2:
            loops.append(loop)
    return loops


def _area(ring: Floats) -> float:
    x, y = ring.T
    return abs(float(x @ np.roll(y, -1) - y @ np.roll(x, -1))) / 2


def _plane(outward: Floats) -> Floats:
    """Give the picture plane of an eye that looks against a direction: rows right and up, (2, 3)."""
    n = unit(outward)
    right = unit(np.cross(np.eye(3)[np.abs(n).argmin()], n))
    return np.stack([right, np.cross(n, right)])


def _lying(ring: Floats) -> Outline:
    if _area(ring) == 0:
        return Outline(ring, np.ptp(ring, axis=0))
    turn = least_rectangle(convex_ring(ring))
    cos, sin = np.cos(turn), np.sin(turn)
    ring = ring @ np.array([[cos, sin], [-sin, cos]])
    ring = ring - ring.min(axis=0)
    return Outline(ring, ring.max(axis=0))
