"""Solids that can be put together: planned, cut, swept, and planned again where something is in the way."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np

from meshjig.assembly import (
    BorderEdges,
    Plan,
    peel,
    wall_angles,
)
from meshjig.assembly.peel import Ban
from meshjig.assembly.tilt import DIRECTIONS
from meshjig.layout.layout import Layout, affected_pieces
from meshjig.layout.part_off import part_off
from meshjig.layout.plain_borders import joined, numbered, without_knobs
from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.measure import mesh_volume
from meshjig.mesh.mesh import Mesh
from meshjig.options import Options
from meshjig.pipeline.cut_to_assemble import CutToAssemble, knob_vertices
from meshjig.pipeline.find_motions import Found, Motion, find_motions
from meshjig.pipeline.ground import Ground
from meshjig.pipeline.through import strays_on
from meshjig.solid import Shell
from meshjig.solid.kerf import KerfFacts, Lean, carve_pieces
from meshjig.solid.no_overlaps import without_overlaps
from meshjig.solid.wall_edges import LabelledShell

__all__ = ["Assembled", "put_together"]

log = logging.getLogger("meshjig")

_ROUNDS = 10
_OTHER_WAYS = 2  # times that a piece is given another way before it loses a knob
_PLAIN = 4  # times that something was tried before it becomes one with what holds it
_LEAKS, _TOO_MUCH = (
    3,
    1.25,
)  # times that leaks are closed; share of its volume that a piece never has without one
_HANDED_OVER = 3  # times that what came off of pieces is handed over
_GATES, _STEEP = (
    3,
    50.0,
)  # times that knobs are taken off at first, and the lean beyond which they are, degrees


class Together(NamedTuple):
    """What is known of how a puzzle is to be put together."""

    up: Floats  # (3,), unit, which way it grows
    crossing: Ints  # (k, 2), faces of the surface that cross: their pieces can't be freed


@dataclass(frozen=True)
class Assembled:
    """Pieces and the plan by which they go together, in the order of their numbers."""

    layout: Layout
    solids: list[Mesh]
    facts: KerfFacts
    reaches: Bools  # (p,), pieces that reach through thin parts
    plan: Plan
    motions: list[Motion]
    laid_out: Floats  # (p,), mm3 between their sheets, less the gap
    angles: tuple[Floats, Floats]  # (e,) degrees between wall and sheet along borders, and (e,) mm
    islands: int  # pieces that are put down with no neighbour there yet
    plain: int  # borders that lost their knob so that a piece can go in
    joined: int  # pieces that became one with a neighbour for it


@dataclass
class _Tries:
    """What was tried for each piece."""

    count: dict[int, int] = field(default_factory=dict)
    bans: list[Ban] = field(default_factory=list)

    def renumbered(self, to: Ints) -> _Tries:
        """Give the same for pieces with other numbers."""
        count: dict[int, int] = {}
        for k, n in self.count.items():
            count[int(to[k])] = max(n, count.get(int(to[k]), 0))
        bans = [(int(to[k]), way, frozenset(int(to[q]) for q in met)) for k, way, met in self.bans]
        return _Tries(count, [ban for ban in bans if ban[0] not in ban[2]])


@dataclass(frozen=True)
class _Before:
    """What pieces were cut by: their faces, and the walls around them."""

    piece: Ints
    lean: Lean

    def changed(self, cut: CutToAssemble, lean: Lean) -> Bools:
        """Mark pieces that have to be made again, (p,)."""
        n = cut.layout.stitching.n_pieces
        old, new = np.full((2, len(cut.V), 3), np.nan)
        old[self.lean.vertex], new[lean.vertex] = self.lean.wall, lean.wall
        same = (np.isnan(old) & np.isnan(new) | (np.abs(old - new) < 1e-9)).all(axis=1)
        other = ~same[cut.F].all(axis=1) | (cut.piece != self.piece)
        changed = np.zeros(n, bool)
        changed[cut.piece[other & (cut.piece >= 0)]] = True
        return changed


def put_together(
    layout: Layout, ground: Ground, sheets: Shell, options: Options, together: Together
) -> Assembled:
    """Cut a layout into solids that go together one after the other.

    Pieces are planned, cut and tried. One that is held is given another way out; then the borders that
    hold it lose their knobs; then it becomes one with what holds it.

    Parameters
    ----------
    layout : Layout
    ground : Ground
    sheets : Shell
    options : Options
    together : Together

    Returns
    -------
    Assembled
        Pieces are numbered in the order in which they are put in.
    """
    tries, merged, handed, leaks = _Tries(), 0, 0, 0
    cut, plain = _gated(CutToAssemble(layout, ground, sheets, options, knob_vertices(layout)), together.up)
    layout = cut.layout
    solids: list[Mesh] = []
    known: Found | None = None
    before: _Before | None = None
    facts: KerfFacts | None = None
    turn = 0
    while True:
        plan, lean = cut.planned(together.up, tries.bans)
        wanted = before.changed(cut, lean) if before else np.ones(len(cut.reaches), bool)
        shell = LabelledShell(cut.V, cut.F, cut.piece, cut.deep)
        if wanted.any():
            made, found, strays = carve_pieces(shell, options.clearance, cut.stock, lean, wanted)
            solids = [made[i] if new else solids[i] for i, new in enumerate(wanted)] if before else made
            facts = found if facts is None else facts.updated(found, wanted)
            leaking = _leaking(solids, cut, options.clearance)
            if leaking.any() and leaks < _LEAKS:
                leaks, before, known = leaks + 1, _Before(cut.piece, lean), None
                cut.keep_upright(leaking)
                continue
            if strays and handed < _HANDED_OVER:
                handed += 1
                layout = part_off(layout, strays_on(layout, cut.V, solids, strays), options.min_piece)
                cut = cut.of(layout)
                before = known = None
                continue
        known = find_motions(
            solids, plan.rank, plan.way, options.clearance, options.give, (known, wanted) if known else None
        )
        held = {k: motion.met for k, motion in enumerate(known.motions) if motion.met}
        turn += 1
        log.info("assembly: round %d, %d pieces made, %d held", turn, int(wanted.sum()), len(held))
        if not held or turn == _ROUNDS:
            break
        before, join, lost, tried = _Before(cut.piece, lean), [], 0, False
        spared = affected_pieces(together.crossing, ground.faces_of(layout), layout.piece_of_face)
        for k, met in held.items():
            if k in spared or spared >= {*met}:
                continue
            tried = True
            n = tries.count[k] = tries.count.get(k, 0) + 1
            if n <= _OTHER_WAYS:
                tries.bans.append((k, plan.way[k], frozenset(met)))
                continue
            around = met if n < _PLAIN else [q for q in cut.beside(k) if plan.rank[q] < plan.rank[k]]
            plainer, some = without_knobs(layout, [(k, q) for q in around])
            if not some and n < _PLAIN:
                tries.count[k] = _PLAIN
                around = [q for q in cut.beside(k) if plan.rank[q] < plan.rank[k]]
                plainer, some = without_knobs(layout, [(k, q) for q in around])
            if some and n <= _PLAIN:
                layout, lost = plainer, lost + some
            else:
                join.append((k, max(met, key=lambda q: met[q])))
        if not tried:
            break
        plain += lost
        if join:
            layout, to = joined(layout, join)
            merged, tries = merged + len(join), tries.renumbered(to)
            known = None
            solids = [solids[i] for i in np.unique(to, return_index=True)[1].tolist()]
            piece = np.append(to, -1)[before.piece]
            piece[np.isin(piece, to[[k for k, _ in join]])] = -1
            before, facts = replace(before, piece=piece), facts.renumbered(to) if facts else None
        if join or lost:
            cut = cut.of(layout)
    assert facts is not None
    order = np.argsort(plan.rank)
    return Assembled(
        numbered(layout, plan.rank),
        without_overlaps([solids[k] for k in order.tolist()]),
        facts.renumbered(plan.rank),
        cut.reaches[order],
        Plan(np.arange(len(order)), plan.way[order], plan.tilt[order]),
        [known.motions[k].renumbered(plan.rank) for k in order.tolist()],
        cut.laid_out(options.clearance)[order],
        (wall_angles(cut.borders, lean.vertex, lean.wall, len(cut.V)), cut.borders.length),
        _islands(cut.borders, plan),
        plain,
        merged,
    )


def _leaking(solids: Sequence[Mesh], cut: CutToAssemble, clearance: float) -> Bools:
    """Mark pieces from which a wall has not parted all of a neighbour, (p,)."""
    volume = np.array([mesh_volume(*solid) for solid in solids])
    return np.asarray(volume > _TOO_MUCH * cut.laid_out(clearance))


def _gated(cut: CutToAssemble, up: Floats) -> tuple[CutToAssemble, int]:
    """Take knobs off borders whose walls would have to lean too far for them."""
    plain = 0
    for _ in range(_GATES):
        b = cut.borders
        plan = peel(Mesh(cut.V, cut.F), cut.piece, b, cut.need, up)
        later = plan.later(b.pairs)
        column = (plan.way[b.pairs[np.arange(len(later)), later]] @ DIRECTIONS.T).argmax(axis=1)
        steep = cut.need[later, np.arange(len(later)), column] > _STEEP
        layout, lost = without_knobs(cut.layout, b.pairs[steep].tolist())
        if not lost:
            break
        plain += lost
        cut = cut.of(layout)
    return cut, plain


def _islands(b: BorderEdges, plan: Plan) -> int:
    later = plan.later(b.side)
    alone = np.ones(len(plan.rank), bool)
    alone[b.side[np.arange(len(later)), later]] = False
    return int(alone.sum())
