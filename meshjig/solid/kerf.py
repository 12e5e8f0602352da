"""The true gap: a slab of constant width is taken from the pieces along every border."""

from __future__ import annotations

from typing import Any

import numpy as np

from meshjig.solid.bodies import Body, arrays, body, largest, sound
from meshjig.solid.borders import border_chains
from meshjig.solid.cutters import border_cutters, walls
from meshjig.solid.pieces import solidify
from meshjig.types import Floats, Ints

__all__ = ["kerf"]

_SHORTEST = 0.003  # mm; details of the booleans below this are dissolved


def kerf(
    V: Floats,
    F: Ints,
    piece_of_face: Ints,
    D: Floats,
    clearance: float,
    wall: Floats | None = None,
) -> tuple[list[tuple[Floats, Ints]], dict[str, Any]]:
    """Give pieces their thickness, and leave a gap of constant width between them.

    The surface is cut at zero width. Along every border the wall is thickened by half the gap to both
    sides, and taken from both pieces: so the gap is as wide as asked at any depth, over creases, seams
    and junctions.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, manifold, oriented outward
    piece_of_face : (m,) int64; faces below 0 are dropped
    D : (n, 3) float64, mm, from the outer to the inner sheet
    clearance : float, mm; 0 leaves the pieces touching
    wall : (n, 3) float64, mm, optional
        The walls' direction, in place of D at vertices where pieces meet.

    Returns
    -------
    solids : list of (V, F), by piece number, closed and in one part
    facts : dict
        Those of `solidify`; "discarded_volume_share", "split": pieces that lost parts, by number;
        "segments", "slabs", "rounded", "hulls" as in `border_cutters`; "failed": pieces that could not be cut.

    Notes
    -----
    Two pieces have a point of their common border, or two of their borders with a third piece, on any
    straight way between them; each keeps half the gap from it.
    """
    chains = border_chains(F, piece_of_face)
    if wall is not None:
        D = D.copy()
        D[chains.vertex] = wall[chains.vertex]
    solids, facts = solidify(V, F, piece_of_face, D)
    if clearance == 0:
        return [(solid.V, solid.F) for solid in solids], facts | {"discarded_volume_share": 0.0, "split": []}
    strip, after, line = walls(V, D, chains, clearance)
    cutters, counts = border_cutters(strip, after, clearance)
    of_piece: list[list[Body]] = [[] for _ in solids]
    for quads, cutter in cutters:
        for piece in chains.pair[line[quads[0]]]:
            of_piece[piece].append(cutter)
    made, lost, kept, split, failed = [], 0.0, 0.0, [], []
    for i, solid in enumerate(solids):
        whole = body(solid.V, solid.F)
        rest, gone, parts = largest(_difference(whole, of_piece[i]))
        if not sound(rest):
            failed.append(i)
            rest = whole
        lost, kept = lost + gone, kept + float(rest.volume())
        if parts:
            split.append(i)
        made.append(arrays(rest))
    share = lost / max(lost + kept, 1e-300)
    return made, facts | counts | {"discarded_volume_share": share, "split": split, "failed": failed}


def _difference(solid: Body, cutters: list[Body]) -> Body:
    import manifold3d

    return manifold3d.Manifold.batch_boolean([solid, *cutters], manifold3d.OpType.Subtract).simplify(_SHORTEST)
