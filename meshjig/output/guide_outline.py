"""The outlines of pieces, each seen from its outer side and turned to lie flat."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from meshjig.measure import unit
from meshjig.output.footprint import convex_ring, least_rectangle
from meshjig.output.guide_model import Joint
from meshjig.types import Floats, Ints

__all__ = ["Outline", "outlines"]

_FINE = 0.12  # mm; drawn no finer


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
    border = _border(F[outer], len(V))
    piece = piece_of_vertex[border[:, 0]]
    border = border[np.argsort(piece, kind="stable")]
    parts = np.split(border, np.cumsum(np.bincount(piece, minlength=len(outward)))[:-1])
    made = []
    for i, part in enumerate(parts):
        flat = _plane(outward[i])
        whole = V[piece_of_vertex == i][:3] if not len(part) else V[:0]
        ring = max((V[loop] @ flat.T for loop in _loops(part)), key=_area, default=whole @ flat.T)
        ring = shapely.get_coordinates(shapely.simplify(shapely.linearrings(ring), _FINE))[:-1]
        made.append(_lying(ring))
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
    """Chain half-edges to closed curves."""
    following: dict[int, list[int]] = {}
    for a, b in border.tolist():
        following.setdefault(a, []).append(b)
    loops = []
    while following:
        here = next(iter(following))
        loop = []
        while here in following:
            loop.append(here)
            onward = following[here]
            after = onward.pop()
            if not onward:
                del following[here]
            here = after
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
