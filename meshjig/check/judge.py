"""The verdict on a whole puzzle: every promise, measured on its finished pieces."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from meshjig.check.alone import each_alone
from meshjig.check.gap import Gap, gap_between
from meshjig.check.overlap import overlaps_between
from meshjig.check.thickness import THICKNESS_SHARE, Thickness, thickest, without_sheets
from meshjig.check.thin_parts import ThinParts
from meshjig.errors import InputError
from meshjig.mesh.measure import face_areas
from meshjig.mesh.pieces import Pieces
from meshjig.runtime.thresholds import FILES_WORTH_A_CHILD
from meshjig.runtime.worker import Background

__all__ = ["Verdict", "judge"]

OVERLAP_MM3 = 1e-3  # what two pieces may share by rounding
GAP_SHARE = 0.95  # of the clearance, that every gap must keep
NEAR_SHARE = 0.97  # of the clearance, under which a gap is worth mending
WIDE_SHARE = 1.1  # of the clearance, that the median gap of all may have
WIDE_PAIR_SHARE = 1.25  # of the clearance, that the median gap of two neighbours may have
MOST_EXEMPT = 0.1  # of the pieces, or of their area, that may be excused from a promise
EXEMPTIBLE = ("self_intersections", "overlap_mm3", "gap_mm", "gap_wide_mm", "thin_walls")


@dataclass(frozen=True)
class Verdict:
    """What was measured, and which promises are broken by which pieces."""

    checks: Mapping[str, Any]  # the report's "checks"; None for what the pieces alone don't tell
    failures: dict[str, list[str]] = field(default_factory=dict)  # promise: names of pieces
    exempt: dict[str, list[str]] = field(default_factory=dict)  # promise: exempt pieces that break it
    named: dict[str, list[str]] = field(default_factory=dict)  # counted, but no promise: its pieces
    near: list[tuple[int, int]] = field(default_factory=list)  # pieces that keep less than the gap, yet some
    model_thin: dict[str, float] = field(default_factory=dict)  # piece: share of its sheets, as the model is

    @property
    def ok(self) -> bool:
        """Whether every promise is kept, but for pieces that are exempt."""
        return not self.failures


def judge(
    pieces: Iterable[Any],
    *,
    neighbours: Sequence[Sequence[int]] | None = None,
    thickness: float | None = None,
    clearance: float | None = None,
    min_wall: float | None = None,
    exempt_pieces: Collection[str] = (),
    thin_parts: ThinParts | None = None,
) -> Verdict:
    """Judge the finished pieces of a puzzle, whatever made them.

    The promises, each a name in `Verdict.failures` with the pieces that break it:

    - ``closed`` and oriented, also as STL; ``one_component``; ``positive_volume``: proven, on the faces;
    - ``self_intersections``: proven that no two faces of a piece cross deeper than 0.005 mm;
    - ``overlap_mm3``: no two pieces, neighbours or not, share more than 0.001 mm3, by exact booleans;
    - ``gap_mm``: the least distance of two neighbours, which is exact, is at least 0.95 of the clearance;
    - ``gap_wide_mm``: the median of what was sampled between all neighbours is at most 1.1 of the
      clearance, and between any two at most 1.25, as is their least distance; only where neighbours are
      named, since pieces far apart are none otherwise; sheets that face each other are left out where
      the thickness is known;
    - ``thickness_mm``: a piece's median, by rays from some 1,000 points, is 0.8 to 1.25 of the thickness;
      not asked of pieces that reach through a thin part;
    - ``thin_walls``: at most 0.1 % of a piece's sheets, by rays from 10,000 points, is thinner than the
      least wall where the model is not;
    - ``exempt``: at most a tenth of the pieces, and of their area, break a promise that they are exempt from.

    Gaps, thickness and walls count only where clearance, thickness and the least wall are known.

    Parameters
    ----------
    pieces : Pieces, or list of (name, V, F) or (V, F)
        V (n, 3), mm; F (m, 3). Without a name a piece is called piece_001 and so on.
    neighbours : (k, 2) indices of pieces that share a border, optional
        Without it, pieces that lie close to each other are neighbours.
    thickness, clearance : float, mm, optional
        What was asked for.
    min_wall : float, mm, optional
        What the process can make.
    exempt_pieces : names of pieces, such as those touched by crossings of the surface itself
        What they break by crossing, overlapping, standing too near or far or being thin, alone or with
        another piece, is named in `Verdict.exempt` and decides `Verdict.ok` only where these are too many.
    thin_parts : ThinParts, optional
        The model, or what of each piece was found to be thin because the model is; and which pieces reach
        through. Without it, all that is thinner than the least wall counts.

    Returns
    -------
    Verdict

    Raises
    ------
    InputError
        No pieces, or arrays that are no mesh with finite coordinates; or neighbours that don't exist.
    """
    pieces = Pieces.of(pieces, neighbours)
    if not len(pieces):
        raise InputError("there are no pieces to judge")
    names = pieces.names
    spared = {i for i, name in enumerate(names) if name in set(exempt_pieces)}
    known = thin_parts or ThinParts()
    through = {i for i, name in enumerate(names) if name in set(known.through_pieces)}
    failures: dict[str, list[str]] = {}
    exempt: dict[str, list[str]] = {}

    def hold(promise: str, broken: Iterable[tuple[int, ...]]) -> None:
        """Blame pieces, alone or in pairs; where one of them is exempt, it alone is named as such."""
        for blamed, excused in ((failures, False), (exempt, True)):
            found = {
                i
                for together in broken
                if excused == (promise in EXEMPTIBLE and not spared.isdisjoint(together))
                for i in together
                if not excused or i in spared
            }
            if found:
                blamed[promise] = [names[i] for i in sorted(found)]

    small = sum(len(F) for _, F in pieces) < FILES_WORTH_A_CHILD
    beside = Background(each_alone, pieces.solids, min_wall, known.model, alone=small)
    try:
        gap = gap_between(pieces, clearance)
        apart = {(min(i, j), max(i, j)) for i, j, least in gap.pairs if least}
        shared = overlaps_between(pieces, pieces.close(0.0).tolist(), apart)
        each = beside.result()
    except BaseException:
        beside.cancel()
        raise
    for promise, broken in each.unsound.items():
        hold(promise, [(i,) for i in broken])
    hold("self_intersections", [(i,) for i, n in enumerate(each.crossings) if n])
    sharing = [(i, j) for i, j, mm3 in shared.pairs if mm3 > OVERLAP_MM3]
    hold("overlap_mm3", [*sharing, *((i,) for i in shared.unmeasured)])
    if clearance:
        narrow = GAP_SHARE * clearance
        hold("gap_mm", [(i, j) for i, j, least in gap.pairs if least is not None and least < narrow])
        wide = _wide(gap, clearance) if pieces.neighbours is not None else []
        if wide and thickness:
            behind = thickest(each.sheets, thickness, through, len(pieces))
            wide = _wide(without_sheets(gap, pieces, wide, behind), clearance)
        hold("gap_wide_mm", wide)
    sheets = each.sheets.without(through)
    facts = sheets.facts(thickness)
    if thickness and len(through) < len(pieces) and not _within(facts["median"], thickness):
        off = _off_thickness(sheets, thickness, len(pieces))
        hold("thickness_mm", [(i,) for i in off if i not in through])
    thin = each.thin.broken(names, known) if each.thin else []
    hold("thin_walls", [(i,) for i in thin])
    if _too_many_exempt(pieces, {name for broken in exempt.values() for name in broken}):
        failures["exempt"] = sorted({name for broken in exempt.values() for name in broken}, key=names.index)

    checks = {
        "closed": "closed" not in failures,
        "one_component": "one_component" not in failures,
        "self_intersections": int(sum(each.crossings)),
        "overlap_mm3": shared.total,
        "gap_mm": gap.facts(clearance),
        "thickness_mm": facts,
        "thin_walls": len(thin) if each.thin else None,
        **dict.fromkeys(
            (
                "area_error",
                "discarded_volume_share",
                "interlocked_borders",
                "interlocked_length",
                "thin_necks",
            )
        ),
        "head_neck": {"min": None, "median": None},
        "area_cv": None,
    }
    named = {"thin_walls": [names[i] for i in thin]} if each.thin else {}
    near = [(i, j) for i, j, least in gap.pairs if least and least < NEAR_SHARE * (clearance or 0.0)]
    return Verdict(checks, failures, exempt, named, near, each.thin.of_model(names) if each.thin else {})


def _too_many_exempt(pieces: Pieces, excused: set[str]) -> bool:
    """Tell whether too much of a puzzle is excused for it to be one: by number, or by area."""
    some = np.array([name in excused for name in pieces.names])
    area = np.array([face_areas(V, F).sum() for V, F in pieces])
    return bool(some.mean() > MOST_EXEMPT or area[some].sum() > MOST_EXEMPT * area.sum())


def _wide(gap: Gap, clearance: float) -> list[tuple[int, int]]:
    """List the neighbours that stand too far apart."""
    median = gap.facts(clearance)["median"]
    everywhere = median is not None and median > WIDE_SHARE * clearance
    return gap.wide((WIDE_SHARE if everywhere else WIDE_PAIR_SHARE) * clearance)


def _within(median: float | None, nominal: float) -> bool:
    return median is not None and THICKNESS_SHARE[0] * nominal <= median <= THICKNESS_SHARE[1] * nominal


def _off_thickness(sheets: Thickness, nominal: float, n: int) -> list[int]:
    """List the pieces whose own median is off, or which have no sheets at all."""
    own = (sheets.samples[sheets.piece == i] for i in range(n))
    return [i for i, x in enumerate(own) if not (len(x) and _within(float(np.median(x)), nominal))]
