"""Pieces that meet where no wall parts them, as under a third one that is narrower there."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from meshjig.mesh.booleans import arrays, body, largest, sound
from meshjig.mesh.mesh import Mesh
from meshjig.mesh.pieces import Pieces, piece_names

__all__ = ["without_overlaps"]

_LEAST = 1e-4  # mm3, of what pieces may share by rounding
_SHORTEST = 0.003  # mm; details of the booleans below this are dissolved


def without_overlaps(solids: Sequence[Mesh]) -> list[Mesh]:
    """Take out of pieces what they share with later ones.

    Parameters
    ----------
    solids : list of Mesh, in the order in which they are put in

    Returns
    -------
    list of Mesh
        Nothing is added to any piece: whatever motions were free stay free.
    """
    made = list(solids)
    pairs = np.sort(Pieces(tuple(piece_names(len(made))), tuple(made)).close(0.0), axis=1)
    for i, j in pairs.tolist():
        first, later = body(*made[i]), body(*made[j])
        if (first ^ later).volume() <= _LEAST:
            continue
        rest = largest((first - later).simplify(_SHORTEST))[0]
        if sound(rest):
            made[i] = Mesh(*arrays(rest))
    return made
