"""The true gap: a slab of constant width is taken from the pieces along every border."""

from __future__ import annotations

from typing import Any

import numpy as np

from meshjig.background import Background
from meshjig.measure import mesh_volume
from meshjig.solid.borders import border_chains
from meshjig.solid.carve import Carved, carve
from meshjig.solid.offsets import Offsets, Strip, mitered
from meshjig.solid.pieces import Solid, solidify
from meshjig.solid.wall_edges import split_bent_walls
from meshjig.solid.walls import most_bend, wall_strip
from meshjig.types import Bools, Floats, Ints

__all__ = ["kerf"]

_WORTH_A_CHILD = 60_000  # faces of all solids
_OWN_SHARE = 0.46  # of the faces; the caller has to prepare them all


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
    solids : list of (V, F), by piece number, closed and in one part; a number without faces has none
    facts : dict
        Those of `solidify`; "discarded_volume_share" and "split": the pieces that lost parts by it;
        "segments": quads of wall; "rounded": joints too sharp for a miter; "hulls": quads too twisted for
        one; "taken_apart", "mended": pieces whose slabs or folds had to be repaired;
        "crossing", "uncut": pieces for which that failed, by number.

    Notes
    -----
    On a straight way between two pieces there is a point of their common wall, or one of each's wall with a
    third piece; a piece keeps half the gap from all of its walls.
    """
    if wall is not None:
        at = border_chains(F, piece_of_face).vertex
        D = D.copy()
        D[at] = wall[at]
    if clearance > 0:
        V, F, piece_of_face, D = split_bent_walls(V, F, piece_of_face, D, most_bend(clearance))
    solids, facts = solidify(V, F, piece_of_face, D)
    chains = border_chains(F, piece_of_face)
    if clearance == 0 or not len(chains.pair):
        return [(solid.V, solid.F) for solid in solids], facts | _counts({}, 0.0)
    strip, line = wall_strip(V, D, F, chains, clearance)
    offsets = mitered(strip, clearance / 2)
    pair = chains.pair[line]
    first = _first_half(solids)
    small = sum(len(solid.F) for solid in solids) < _WORTH_A_CHILD
    child = Background(carve, *_part(solids, strip, offsets, pair, ~first), clearance, alone=small)
    try:
        carved = carve(*_part(solids, strip, offsets, pair, first), clearance)
        carved |= child.result()
    except BaseException:
        child.cancel()
        raise
    volume = sum(mesh_volume(piece.V, piece.F) for piece in carved.values())
    facts |= _counts(carved, volume)
    facts |= {
        "segments": len(pair),
        "rounded": int(((strip.after >= 0) & (offsets.after < 0)).sum()),
        "hulls": int(offsets.failed.sum()),
    }
    empty = np.empty((0, 3)), np.empty((0, 3), np.int64)
    return [carved[i][:2] if i in carved else empty for i in range(len(solids))], facts


def _counts(carved: dict[int, Carved], volume: float) -> dict[str, Any]:
    lost = sum(piece.lost for piece in carved.values())

    def those(state: str) -> list[int]:
        return sorted(i for i, piece in carved.items() if piece.state == state)

    return {
        "discarded_volume_share": lost / max(lost + volume, 1e-300),
        "split": sorted(i for i, piece in carved.items() if piece.parts),
        "taken_apart": those("rounded"),
        "mended": those("mended"),
        "crossing": those("crosses"),
        "uncut": those("uncut"),
    }


def _first_half(solids: list[Solid]) -> Bools:
    """Choose pieces on one side of the model, with about half of the faces; (p,) bool."""
    size = np.array([len(solid.F) for solid in solids])
    centre = np.array([solid.V.mean(0) if len(solid.V) else np.zeros(3) for solid in solids])
    order = np.argsort(centre[:, np.ptp(centre, axis=0).argmax()], kind="stable")
    first = np.zeros(len(solids), bool)
    first[order[np.cumsum(size[order]) <= _OWN_SHARE * size.sum()]] = True
    return first


def _part(
    solids: list[Solid], strip: Strip, offsets: Offsets, pair: Ints, chosen: Bools
) -> tuple[dict[int, Solid], Strip, Offsets, Ints]:
    """Give some of the pieces, and the walls around them."""
    kept = np.flatnonzero(chosen[pair].any(1))
    number = np.append(np.full(len(pair), -1), -1)
    number[kept] = np.arange(len(kept))
    return (
        {int(i): solids[i] for i in np.flatnonzero(chosen) if len(solids[i].F)},
        Strip(strip.corners[kept], strip.rising[kept], number[strip.after[kept]]),
        Offsets(offsets.moves[kept], number[offsets.after[kept]], offsets.failed[kept]),
        pair[kept],
    )
