"""Pieces of different bodies share no border, and no gap is cut between them: contacts are named."""

from __future__ import annotations

import numpy as np

from meshjig.layout.layout import Layout
from meshjig.mesh.components import components
from meshjig.mesh.pieces import Pieces
from meshjig.mesh.types import Floats, Ints
from meshjig.options import Options

__all__ = ["note_contacts"]

ENOUGH = 0.95  # of the clearance
NAMED = 4  # pairs of pieces


def note_contacts(pieces: Pieces, layout: Layout, options: Options) -> list[str]:
    """Name the pieces of different bodies that are nearer to each other than the clearance, and where.

    Parameters
    ----------
    pieces : Pieces
    layout : Layout, that they were made by
    options : Options

    Returns
    -------
    list of str, one sentence, or none where all keep it
    """
    near = _too_near(pieces, _of_other_bodies(pieces, layout, options.clearance), options.clearance)
    return [_told(pieces, near, options.clearance)] if len(near) else []


def _of_other_bodies(pieces: Pieces, layout: Layout, reach: float) -> Ints:
    """List pairs of pieces of different bodies whose boxes are close, (k, 2)."""
    n, body = components(layout.cut.F)
    if n == 1 or reach == 0:
        return np.zeros((0, 2), np.int64)
    piece = layout.piece_of_face
    body_of_piece = np.zeros(len(pieces), np.int64)
    body_of_piece[piece[piece >= 0]] = body[piece >= 0]
    pairs = pieces.close(reach)
    return pairs[body_of_piece[pairs[:, 0]] != body_of_piece[pairs[:, 1]]]


def _too_near(pieces: Pieces, pairs: Ints, clearance: float) -> Ints:
    bodies = pieces.bodies if len(pairs) else []
    near = [
        (i, j)
        for i, j in pairs.tolist()
        if bodies[i] is not None
        and bodies[j] is not None
        and bodies[i].min_gap(bodies[j], clearance) < ENOUGH * clearance
    ]
    return np.array(near, np.int64).reshape(-1, 2)


def _told(pieces: Pieces, pairs: Ints, clearance: float) -> str:
    low, high = pieces.boxes
    named = [
        f"{pieces.names[i]} and {pieces.names[j]} around ({_place(low[[i, j]], high[[i, j]])}) mm"
        for i, j in pairs[:NAMED].tolist()
    ]
    more = f", and {len(pairs) - NAMED} pairs more" if len(pairs) > NAMED else ""
    return (
        f"bodies of the model touch or cross; pieces nearer than {clearance:g} mm to one of another "
        f"body are {'; '.join(named)}{more}"
    )


def _place(low: Floats, high: Floats) -> str:
    """The middle of what two boxes share."""
    middle = (low.max(0) + high.min(0)) / 2
    return ", ".join(f"{round(x)}" for x in middle.tolist())
