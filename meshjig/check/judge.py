"""The verdict on a whole puzzle: every promise, measured on its finished pieces."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from meshjig.check.arrays import Piece, boxes, close_boxes, sound_piece
from meshjig.check.closed import is_closed_as_stl, is_one_component, volume
from meshjig.check.crossings import self_intersections
from meshjig.check.gap import Gap, default_reach, gap_between_bodies
from meshjig.check.overlap import overlaps_of_bodies
from meshjig.check.solids import bodies
from meshjig.check.thickness import Thickness, measure_thickness
from meshjig.errors import InputError

__all__ = ["Verdict", "judge"]

OVERLAP_MM3 = 1e-3  # what two pieces may share by rounding
GAP_SHARE = 0.95  # of the clearance, that every gap must keep
THICKNESS_SHARE = (0.8, 1.25)  # of the thickness, between which a piece's median must lie


@dataclass(frozen=True)
class Verdict:
    """What was measured, and which promises are broken by which pieces."""

    checks: dict[str, Any]  # the report's "checks"; None for what the pieces alone don't tell
    failures: dict[str, list[str]] = field(default_factory=dict)  # promise: names of pieces
    exempt: frozenset[str] = frozenset()  # promises that are measured, but not held against the puzzle

    @property
    def ok(self) -> bool:
        """Whether every promise that counts is kept."""
        return not set(self.failures) - self.exempt


def judge(
    pieces: Iterable[Sequence[Any]],
    *,
    neighbours: Sequence[Sequence[int]] | None = None,
    thickness: float | None = None,
    clearance: float | None = None,
    exempt: Collection[str] = (),
) -> Verdict:
    """Judge the finished pieces of a puzzle, whatever made them.

    The promises: ``closed`` and oriented, also as STL; ``one_component``; ``positive_volume``;
    ``self_intersections`` none; ``overlap_mm3`` of two pieces at most 0.001, and known; ``gap_mm`` of two
    neighbours at least 0.95 of the clearance; ``thickness_mm``, the median, from 0.8 to 1.25 of
    the thickness. The last two hold only where clearance and thickness are known.

    Parameters
    ----------
    pieces : list of (name, V, F) or (V, F)
        V (n, 3), mm; F (m, 3). Without a name a piece is called piece_001 and so on.
    neighbours : (k, 2) indices of pieces that share a border, optional
        Without it, pieces that lie close to each other are neighbours.
    thickness, clearance : float, mm, optional
        What was asked for.
    exempt : names of promises that are measured, but don't decide `Verdict.ok`

    Returns
    -------
    Verdict

    Raises
    ------
    InputError
        No pieces, or arrays that are no mesh with finite coordinates; or neighbours that don't exist.
    """
    names, meshes = _named(pieces)
    pairs = _neighbour_pairs(neighbours, len(meshes))
    failures: dict[str, list[str]] = {}

    def hold(promise: str, broken: Iterable[int]) -> None:
        blamed = sorted(set(broken))
        if blamed:
            failures[promise] = [names[i] for i in blamed]

    every = range(len(meshes))
    hold("closed", (i for i in every if not is_closed_as_stl(*meshes[i])))
    hold("one_component", (i for i in every if not is_one_component(meshes[i][1])))
    hold("positive_volume", (i for i in every if volume(*meshes[i]) <= 0))
    crossings = [len(self_intersections(*mesh)) for mesh in meshes]
    hold("self_intersections", np.flatnonzero(crossings).tolist())

    solids = bodies(meshes)
    low, high = boxes(meshes)
    shared = overlaps_of_bodies(solids, close_boxes(low, high, 0.0).tolist())
    sharing = [k for i, j, mm3 in shared.pairs if mm3 > OVERLAP_MM3 for k in (i, j)]
    hold("overlap_mm3", [*sharing, *shared.unmeasured])
    gap = _gap(meshes, solids, pairs, clearance, close_boxes(low, high, default_reach(clearance)))
    if clearance:
        hold(
            "gap_mm",
            (k for *pair, mm in gap.pairs if mm is not None and mm < GAP_SHARE * clearance for k in pair),
        )
    sheets = measure_thickness(meshes)
    facts = sheets.facts(thickness)
    if thickness and not _within(facts["median"], thickness):
        hold("thickness_mm", _off_thickness(sheets, thickness, len(meshes)))

    checks = {
        "closed": "closed" not in failures,
        "one_component": "one_component" not in failures,
        "self_intersections": int(sum(crossings)),
        "overlap_mm3": shared.total,
        "gap_mm": gap.facts(clearance),
        "thickness_mm": facts,
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
    return Verdict(checks, failures, frozenset(exempt))


def _named(pieces: Iterable[Sequence[Any]]) -> tuple[list[str], list[Piece]]:
    names, meshes = [], []
    for i, piece in enumerate(pieces):
        *name, V, F = piece
        names.append(str(name[0]) if name else f"piece_{i + 1:03d}")
        meshes.append(sound_piece(V, F, names[-1]))
    if not meshes:
        raise InputError("there are no pieces to judge")
    return names, meshes


def _neighbour_pairs(neighbours: Sequence[Sequence[int]] | None, n: int) -> Any:
    if neighbours is None:
        return None
    pairs = np.asarray(neighbours, np.int64).reshape(-1, 2)
    if len(pairs) and (pairs.min() < 0 or pairs.max() >= n):
        raise InputError(f"neighbours: a pair names a piece beyond the {n} that there are")
    return pairs


def _gap(meshes: list[Piece], solids: list[Any], pairs: Any, clearance: float | None, close: Any) -> Gap:
    reach = default_reach(clearance)
    if pairs is None:
        return gap_between_bodies(meshes, solids, close, reach, found=True)
    return gap_between_bodies(meshes, solids, pairs, max(reach, 1.0), found=False)


def _within(median: float | None, nominal: float) -> bool:
    return median is not None and THICKNESS_SHARE[0] * nominal <= median <= THICKNESS_SHARE[1] * nominal


def _off_thickness(sheets: Thickness, nominal: float, n: int) -> list[int]:
    """List the pieces whose own median is off, or which have no sheets at all."""
    own = (sheets.samples[sheets.piece == i] for i in range(n))
    return [i for i, x in enumerate(own) if not (len(x) and _within(float(np.median(x)), nominal))]
