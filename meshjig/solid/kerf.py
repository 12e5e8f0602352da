"""The true gap: a slab of constant width is taken from the pieces along every border."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.booleans import share_cores
from meshjig.mesh.measure import sums
from meshjig.mesh.mesh import Mesh
from meshjig.runtime.thresholds import SOLIDS_WORTH_A_CHILD
from meshjig.runtime.worker import Background
from meshjig.solid.border_chains import Chains, border_chains
from meshjig.solid.carve_gap import Carved, Walls, carve
from meshjig.solid.carve_leaning import LeaningWalls, bands, finer, ruled
from meshjig.solid.carve_through import Stock, carve_marked, carve_through, joined_lines, rim_lines, separated
from meshjig.solid.kerf_facts import KerfFacts, kerf_facts
from meshjig.solid.offsets import Strip, mitered
from meshjig.solid.solidify import solidify
from meshjig.solid.wall_edges import LabelledShell, split_bent_walls
from meshjig.solid.walls import most_bend, wall_strip

__all__ = ["KerfFacts", "Lean", "carve_pieces", "kerf"]

_BELOW = 2.5  # mm, that leaning walls go below the ground of others
_OWN_SHARE = 0.48  # of the faces; the caller also takes what the child has made


class Lean(NamedTuple):
    """Walls that don't follow the way from the outer to the inner sheet."""

    vertex: Ints  # (k,)
    wall: Floats  # (k, 3), mm, as long as it takes from sheet to sheet where both are level
    D: Floats  # (n, 3), mm, from the outer to the inner sheet


def kerf(
    V: Floats,
    F: Ints,
    piece_of_face: Ints,
    D: Floats,
    clearance: float,
    wall: Floats | None = None,
) -> tuple[list[Mesh], KerfFacts]:
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
    solids : list of Mesh, by piece number, closed and in one part; a number without faces has none
    facts : KerfFacts

    Notes
    -----
    On a straight path between two pieces there is a point of their common wall, or one of each's wall with a
    third piece; a piece keeps half the gap from all of its walls.
    """
    if wall is not None:
        at = border_chains(F, piece_of_face).vertex
        D = D.copy()
        D[at] = wall[at]
    return carve_pieces(LabelledShell(V, F, piece_of_face, D), clearance)[:2]


def carve_pieces(
    surface: LabelledShell,
    clearance: float,
    stock: Stock | None = None,
    lean: Lean | None = None,
    only: Bools | None = None,
) -> tuple[list[Mesh], KerfFacts, dict[int, tuple[Mesh, ...]]]:
    """Do as `kerf` does, where some pieces reach through thin parts: these are cut from the model's wall.

    Parameters
    ----------
    surface : LabelledShell
    clearance : float, mm
    stock : Stock, optional
    lean : Lean, optional
    only : (p,) bool, optional
        The pieces to be made; others come out empty.

    Returns
    -------
    solids : list of Mesh
    facts : KerfFacts
    strays : dict of meshes, by piece number: what came off of pieces that reach through
    """
    asked = surface, clearance, stock, lean
    wanted = np.ones(int(surface.piece_of_face.max(initial=-1)) + 1, bool) if only is None else only
    first = wanted & _first_half(*surface[:3], wanted)
    if clearance == 0 or len(surface.F) < SOLIDS_WORTH_A_CHILD or not first.any():
        carved, counted = _carved(*asked, wanted)
    else:
        child = Background(_carved_beside, *asked, wanted & ~first)
        try:
            share_cores()
            carved, counted = _carved(*asked, first)
            others, more = child.result()
        except BaseException:
            child.cancel()
            raise
        carved |= others
        counted = [a + b for a, b in zip(counted, more, strict=True)]
    if stock is not None and lean is None:
        carved |= separated(carved, stock, clearance)
    empty = np.empty((0, 3)), np.empty((0, 3), np.int64)
    solids = [Mesh(*(carved[i][:2] if i in carved else empty)) for i in range(len(first))]
    return (
        solids,
        kerf_facts(counted, carved),
        {i: piece.strays for i, piece in carved.items() if piece.strays},
    )


def _carved_beside(*asked: Any) -> tuple[dict[int, Carved], list[int]]:
    """Make some of the pieces while the caller makes the others."""
    share_cores(second=True)
    return _carved(*asked)


def _carved(
    surface: LabelledShell, clearance: float, stock: Stock | None, lean: Lean | None, chosen: Bools
) -> tuple[dict[int, Carved], list[int]]:
    """Make some of the pieces, and count what was met meanwhile, as the first of KerfFacts."""
    if clearance > 0 and lean is not None:
        return _carved_leaning(surface, clearance, stock, lean, chosen)
    if clearance > 0:
        surface = split_bent_walls(*surface, most_bend(clearance))
    V, F, piece, D = surface
    label = np.append(np.where(chosen, np.arange(len(chosen)), -1), -1)[piece]
    solids, counts = solidify(V, F, label, D)
    made = {i: solid for i, solid in enumerate(solids) if len(solid.F)}
    chains = _lines(F, piece, stock)
    if clearance == 0 or not len(chains.pair):
        return {i: Carved(s.V, s.F, 0.0, 0, "clean") for i, s in made.items()}, [*counts, 0, 0, 0]
    walls, met = _walls(LeaningWalls(V, D), F, chains, clearance, stock, chosen)
    if stock is None:
        return carve(made, walls), [*counts, *met]
    reaching = {
        i: made.pop(i) for i in np.flatnonzero(stock.reaches[: len(chosen)] & chosen).tolist() if i in made
    }
    through = carve_through(reaching, walls, stock)
    return carve(made, walls) | through, [*counts, *met]


def _carved_leaning(
    surface: LabelledShell, clearance: float, stock: Stock | None, lean: Lean, chosen: Bools
) -> tuple[dict[int, Carved], list[int]]:
    """Do the same for walls that lean."""
    V, F, piece, deep = surface
    leaning = ruled(LabelledShell(V, F, piece, lean.D), deep, lean.vertex, lean.wall)
    leaning, chains = finer(leaning, _lines(F, piece, stock), most_bend(clearance))
    walls, met = _walls(leaning, F, chains, clearance, stock, chosen)
    through, counts = chosen & (False if stock is None else stock.reaches), [0, 0, 0, 0]
    around = LabelledShell(V, F, piece, lean.D)
    carved = carve_marked(bands(around, leaning, np.flatnonzero(chosen & ~through), clearance), walls)
    if stock is not None and through.any():
        label = np.append(np.where(through, np.arange(len(through)), -1), -1)[piece]
        solids, found = solidify(V, F, label, deep)
        reaching = {i: solid for i, solid in enumerate(solids) if len(solid.F)}
        carved, counts = carved | carve_through(reaching, walls, stock), list(found)
    return carved, [*counts, *met]


def _lines(F: Ints, piece: Ints, stock: Stock | None) -> Chains:
    chains = border_chains(F, piece)
    return chains if stock is None else joined_lines(chains, rim_lines(stock.rim))


def _walls(
    ways: LeaningWalls, F: Ints, chains: Chains, clearance: float, stock: Stock | None, chosen: Bools
) -> tuple[Walls, list[int]]:
    """Thicken the walls around some pieces; tell how many quads they have, are rounded, and are hulls."""
    V, D = ways
    past = np.full(len(V), clearance)
    if stock is not None:
        past[: len(stock.past)] = np.maximum(clearance, stock.past)
    strip, line = wall_strip(V, D, F, chains, clearance, past)
    pair = chains.pair[line]
    kept = np.asarray(chosen[pair].any(1))
    strip, pair = _some(strip, kept), pair[kept]
    offsets = mitered(strip, clearance / 2)
    mine = chosen[pair[:, 0]]  # quads between the halves are met twice
    sharp = (strip.after >= 0) & (offsets.after < 0)
    return Walls(strip, offsets, pair, clearance / 2), [
        int((mine & some).sum()) for some in (mine, sharp, offsets.failed)
    ]


def _first_half(V: Floats, F: Ints, piece: Ints, wanted: Bools) -> Bools:
    """Choose of some pieces those on one side of the model, with about half of the faces; (p,) bool."""
    n = len(wanted)
    kept = np.append(wanted, False)[piece]
    size = np.bincount(piece[kept], minlength=n)
    middle = V[F[kept]].mean(1)
    centre = np.stack([sums(piece[kept], x, n) for x in middle.T], 1) / np.maximum(size, 1)[:, None]
    order = np.argsort(centre[:, np.ptp(centre, axis=0).argmax()], kind="stable") if n else np.arange(0)
    first = np.zeros(n, bool)
    first[order[np.cumsum(size[order]) <= _OWN_SHARE * size.sum()]] = True
    return first


def _some(strip: Strip, kept: Bools) -> Strip:
    """Give some quads of a strip."""
    number = np.append(np.where(kept, np.cumsum(kept) - 1, -1), -1)
    return Strip(strip.corners[kept], strip.rising[kept], number[strip.after[kept]])
