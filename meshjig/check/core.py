"""The promises of a core: sound parts, clear of every piece."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from meshjig.check.closed import is_closed_as_stl, is_one_component, volume
from meshjig.check.judge import GAP_SHARE, OVERLAP_MM3
from meshjig.check.self_intersection import self_intersections
from meshjig.mesh.pieces import Pieces

__all__ = ["CoreChecks", "add_failures", "judge_core"]


@dataclass(frozen=True)
class CoreChecks:
    """What was measured on a core."""

    gap_mm: float | None  # least distance of a part and a piece; None beyond 1 mm or three clearances
    overlap_mm3: float
    self_intersections: int


def judge_core(
    core: Iterable[Any],
    pieces: Iterable[Any],
    *,
    clearance: float | None = None,
    exempt_pieces: Collection[str] = (),
) -> tuple[CoreChecks, dict[str, list[str]]]:
    """Judge the parts of a core, and how far they stay from the pieces.

    Each part keeps the promises of a piece (see `judge`) but for thickness; parts that touch where the
    core was cut in two may do so. No piece shares space with a part, and none comes nearer than
    0.95 of the clearance.

    Parameters
    ----------
    core, pieces : Pieces, or list of (name, V, F)
        V (n, 3), mm; F (m, 3).
    clearance : float, mm, optional
    exempt_pieces : names of pieces that may be too near

    Returns
    -------
    checks : CoreChecks
    failures : dict
        Names of promises, each with the parts that break it, and pieces they break it with.

    Raises
    ------
    InputError
        Arrays that are no mesh with finite coordinates.
    """
    parts, pieces = Pieces.of(core), Pieces.of(pieces)
    both = Pieces((*parts.names, *pieces.names), (*parts.solids, *pieces.solids))
    names = both.names
    failures: dict[str, list[str]] = {}

    def hold(promise: str, broken: Iterable[tuple[int, ...]]) -> None:
        found = {i for together in broken for i in together}
        if found:
            failures[promise] = [names[i] for i in sorted(found)]

    own = range(len(parts))
    crossings = [len(self_intersections(*both[i])) for i in own]
    hold("closed", [(i,) for i in own if not is_closed_as_stl(*both[i])])
    hold("one_component", [(i,) for i in own if not is_one_component(both[i].F)])
    hold("positive_volume", [(i,) for i in own if volume(*both[i]) <= 0])
    hold("self_intersections", [(i,) for i in own if crossings[i]])

    reach = max(1.0, 3 * (clearance or 0.0))
    solid, spared = both.bodies, set(exempt_pieces)
    pairs = both.close(reach)
    shared, least = {}, {}
    for i, j in pairs[(pairs[:, 0] < len(parts)) & (pairs[:, 1] >= len(parts))].tolist():
        if solid[i] is None or solid[j] is None or names[j] in spared:
            continue
        least[i, j] = float(solid[i].min_gap(solid[j], reach))
        if least[i, j] == 0:
            shared[i, j] = float((solid[i] ^ solid[j]).volume())
    hold("overlap_mm3", [pair for pair, mm3 in shared.items() if mm3 > OVERLAP_MM3])
    if clearance:
        hold("gap_mm", [pair for pair, gap in least.items() if gap < GAP_SHARE * clearance])
    nearest = min(least.values(), default=np.inf)
    gap = nearest if nearest < reach else None
    return CoreChecks(gap, sum(shared.values()), sum(crossings)), failures


def add_failures(failures: dict[str, list[str]], more: Mapping[str, list[str]]) -> None:
    """Add to the names of promises those that others break, each name once."""
    for promise, names in more.items():
        own = failures.setdefault(promise, [])
        own += [name for name in names if name not in own]
