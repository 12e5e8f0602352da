"""Fill the parts of cut faces with triangles."""

from typing import NamedTuple

import numpy as np

from meshjig.cut.cycles import Cycles
from meshjig.cut.ears import clip_ears
from meshjig.cut.places import Places
from meshjig.types import Floats, Ints

__all__ = ["Filling", "fill"]

IDEAL = np.array([[0.0, 0.0], [1.0, 0.0], [0.5, np.sqrt(0.75)]])


class Filling(NamedTuple):
    """Triangles over the parts of cut faces."""

    T: Ints  # (t, 3), half-edges that start at the corners; from n_half_edges on, centres
    part: Ints  # (t,), the cycle each triangle fills
    centre_part: Ints  # (s,), the cycle of each centre
    centre_bary: Floats  # (s, 3), where it lies in its face


def fill(places: Places, parts: Cycles, frames: Floats) -> Filling:
    """Triangulate every part of every cut face.

    What can't be clipped in its own shape is tried in that of an equilateral face, where a
    needle is none; what fails there too is fanned from its centre.

    Parameters
    ----------
    places : Places
    parts : Cycles
    frames : (t, 3, 2) float64, the flat corners of cut faces
    """
    members = parts.members
    bary, row = places.bary[members], places.row[members]
    flat = np.einsum("hk,hkd->hd", bary, frames[row])
    T, part, failed = clip_ears(flat, parts.first, parts.size)
    pieces, owners = [T], [part]
    if len(failed):
        again, owner, failed_again = clip_ears(
            bary @ IDEAL, parts.first[failed], parts.size[failed], thorough=True
        )
        pieces.append(again)
        owners.append(failed[owner])
        failed = failed[failed_again]
    T = members[np.concatenate(pieces)]
    part = np.concatenate(owners)
    if not len(failed):
        return Filling(T, part, failed, np.zeros((0, 3)))

    size = parts.size[failed]
    which = np.repeat(np.arange(len(failed)), size)
    k = np.arange(len(which)) - np.repeat(np.cumsum(size) - size, size)
    here = parts.first[failed][which] + k
    after = parts.first[failed][which] + (k + 1) % size[which]
    centre = np.stack([np.bincount(which, bary[here, j], len(failed)) for j in range(3)], 1) / size[:, None]
    fan = np.stack([members[here], members[after], len(members) + which], 1)
    return Filling(np.concatenate([T, fan]), np.concatenate([part, failed[which]]), failed, centre)
