"""Fill the parts of cut faces with triangles."""

from typing import NamedTuple

import numpy as np

from meshjig.cut.cycles import Cycles
from meshjig.cut.ears import clip_ears
from meshjig.cut.places import Places
from meshjig.cut.spread_vertices import moved, parts_beside, spread
from meshjig.mesh.types import Floats, Ints

__all__ = ["Filling", "fill"]

SHARES = (2.0**-12, 2.0**-9, 2.0**-6, 2.0**-3, 1.0)  # of the way that tangled corners go to their goal
IDEAL = np.array([[0.0, 0.0], [1.0, 0.0], [0.5, np.sqrt(0.75)]])


class Filling(NamedTuple):
    """Triangles over the parts of cut faces."""

    T: Ints  # (t, 3), half-edges that start at the corners; from n_half_edges on, centres
    part: Ints  # (t,), the cycle each triangle fills
    centre_part: Ints  # (s,), the cycle of each centre
    centre_bary: Floats  # (s, 3), where it lies in its face
    n_untangled: int  # parts whose corners had to be moved


def fill(places: Places, parts: Cycles, frames: Floats) -> tuple[Places, Filling]:
    """Triangulate every part of every cut face.

    A part that can't be clipped has its corners inside the face moved, as few as will do; what
    fails still is fanned from its centre.

    Parameters
    ----------
    places : Places
    parts : Cycles
    frames : (t, 3, 2) float64, the flat corners of cut faces

    Returns
    -------
    places : Places, with corners moved
    filling : Filling
    """
    T, part, failed = _clipped(places, parts, frames, np.arange(len(parts.size)))
    n_untangled = len(failed)
    for all_in_face in (False, True):
        goal = spread(places, parts, failed, all_in_face=all_in_face)
        start = places
        for share in SHARES:
            if not len(failed):
                break
            again = parts_beside(places, parts, failed)
            places = moved(start, goal, share, of=places, parts=parts, some=again)
            new, new_part, failed = _clipped(places, parts, frames, again)
            kept = ~np.isin(part, again)
            T, part = np.concatenate([T[kept], new]), np.concatenate([part[kept], new_part])
    fan, fan_part, centre = _fans(places, parts, failed)
    return places, Filling(
        np.concatenate([T, fan]), np.concatenate([part, fan_part]), failed, centre, n_untangled
    )


def _clipped(places: Places, parts: Cycles, frames: Floats, some: Ints) -> tuple[Ints, Ints, Ints]:
    """Clip some parts in the shape of their face, or else of an equilateral one, where needles are none.

    Returns
    -------
    T : (t, 3) int64, half-edges
    part : (t,) int64
    failed : (f,) int64, parts
    """
    bary, row = places.bary[parts.members], places.row[parts.members]
    flat = np.einsum("hk,hkd->hd", bary, frames[row])
    T, owner, failed = clip_ears(flat, parts.first[some], parts.size[some])
    part, failed = some[owner], some[failed]
    if len(failed):
        more, owner, still = clip_ears(bary @ IDEAL, parts.first[failed], parts.size[failed], thorough=True)
        T, part = np.concatenate([T, more]), np.concatenate([part, failed[owner]])
        failed = failed[still]
    return parts.members[T], part, failed


def _fans(places: Places, parts: Cycles, some: Ints) -> tuple[Ints, Ints, Floats]:
    """Join the sides of parts to their centres; also give where those lie."""
    size = parts.size[some]
    which = np.repeat(np.arange(len(some)), size)
    k = np.arange(len(which)) - np.repeat(np.cumsum(size) - size, size)
    first = parts.first[some][which]
    here, after = parts.members[first + k], parts.members[first + (k + 1) % size[which]]
    total = np.stack([np.bincount(which, places.bary[here, j], len(some)) for j in range(3)], 1)
    fan = np.stack([here, after, len(places.vertex) + which], 1)
    return fan, some[which], total / np.maximum(size, 1)[:, None]
