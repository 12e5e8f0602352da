"""The promise that a puzzle can be put together: every piece goes in past all that is there before it."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np

from meshjig.check.straight import Met, met_on_the_way
from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.measure import angle_normals, mesh_volume
from meshjig.mesh.mesh import Mesh, concatenate
from meshjig.mesh.pieces import Pieces
from meshjig.runtime.thresholds import FILES_WORTH_A_CHILD
from meshjig.runtime.worker import Background

__all__ = ["AssemblyChecks", "AssemblyPlan", "Obstacles", "judge_assembly", "smaller"]

MOST_VOLUME_ERROR = 0.15  # of what lay between a piece's sheets, that it may have lost or gained
_STEPS = 4  # in which the depth is measured that surfaces press into each other by


class AssemblyPlan(NamedTuple):
    """In which order pieces go in, and how."""

    order: Sequence[str]  # names, the first that is put in first
    way: Mapping[str, Sequence[float]]  # by name: the direction in which it goes out again
    shift: Mapping[str, Sequence[float]] = {}  # by name: how it is moved in its place before that, mm
    give: float = 0.0  # mm, that surfaces may press into each other
    laid_out: Mapping[str, float] = {}  # by name: mm3 between its sheets before it was cut, less the gap


@dataclass(frozen=True)
class AssemblyChecks:
    """What was measured."""

    pieces: int
    proved: int  # pieces with a proved motion
    straight: int  # of these, that go straight in from outside
    press_mm: float  # how far surfaces press into each other at most
    held_by: dict[str, list[str]] = field(default_factory=dict)  # others: what is in their way
    volume_error: float | None = None  # the largest, as a share


class Obstacles:
    """Solids, of which those in the way of a piece are found by their boxes."""

    def __init__(self, solids: Sequence[Mesh]) -> None:
        self.solids = solids
        self.low, self.high = (np.array([f(X, axis=0) for X, _ in solids]) for f in (np.min, np.max))

    def near(self, k: int, there: Ints, way: Floats, shift: Floats | None = None) -> Ints:
        """Give of some pieces those that the box of piece k meets along a way, moved by a shift first."""
        return there[self._meets(k, there, way, np.zeros(3) if shift is None else shift)]

    def _meets(self, k: int, there: Ints, way: Floats, shift: Floats) -> Bools:
        low, high, lows, highs = self.low[k] + shift, self.high[k] + shift, self.low[there], self.high[there]
        still = np.abs(way) < 1e-12
        with np.errstate(divide="ignore", invalid="ignore"):
            first, last = (lows - high) / way, (highs - low) / way
        beside = (lows > high) | (highs < low)
        enter = np.where(still, np.where(beside, np.inf, -np.inf), np.minimum(first, last)).max(axis=1)
        leave = np.where(still, np.where(beside, -np.inf, np.inf), np.maximum(first, last)).min(axis=1)
        return np.asarray((enter <= leave) & (leave > 0))

    def together(self, some: Ints) -> tuple[Mesh, Ints]:
        """Give some pieces as one mesh, and the piece that each face is of."""
        V, F, _, of = concatenate([self.solids[i] for i in some])
        return Mesh(V, F), some[of]


def smaller(solid: Mesh, by: float) -> Mesh:
    """Draw a solid's surface in along its normals, mm."""
    return Mesh(solid.V - by * angle_normals(*solid), solid.F)


def judge_assembly(
    pieces: Iterable[Any], plan: AssemblyPlan, exempt_pieces: Collection[str] = ()
) -> tuple[AssemblyChecks, dict[str, list[str]]]:
    """Prove on finished pieces that they go together by a plan.

    Each piece is moved by its shift, and then straight along its way until it is clear of all that was put in
    before it. Seen along the way nothing of that may lie before it: that is tested for corners against faces
    both ways and for edges against edges, so it holds for every place on the way. Where that fails, and the
    material gives, the piece is drawn in by as much.

    Parameters
    ----------
    pieces : Pieces, or list of (name, V, F)
        V (n, 3), mm; F (m, 3); closed, without common space.
    plan : AssemblyPlan
    exempt_pieces : names of pieces that may be held, and hold others, such as those that overlap since the
        model crosses itself

    Returns
    -------
    checks : AssemblyChecks
    failures : dict
        Names of promises, each with the pieces that break it: "assembly", what can't go in or is in no
        order; "volume_error", what has lost or gained more than 15 % of its volume.

    Raises
    ------
    InputError
        Arrays that are no mesh with finite coordinates.
    """
    pieces = Pieces.of(pieces)
    place = {name: i for i, name in enumerate(pieces.names)}
    order = [place[name] for name in dict.fromkeys(plan.order) if name in place]
    known = [k for k in order if _is_direction(plan.way.get(pieces.names[k]))]
    motions = _Asked(
        np.array(order, np.int64),
        {k: np.array(plan.way[pieces.names[k]], float) for k in known},
        {k: np.array(plan.shift.get(pieces.names[k], np.zeros(3)), float) for k in known},
        plan.give,
    )
    found = _proved(pieces.solids, motions, known)
    held = {k: met for k, (met, _) in found.items() if met is not None}
    unknown = sorted({*range(len(pieces))} - {*known})
    volume_error, wrong = _volume_errors(pieces, plan.laid_out)
    checks = AssemblyChecks(
        len(pieces),
        len(known) - len(held),
        sum(met is None and press == 0 for met, press in found.values()),
        max((press for met, press in found.values() if met is None), default=0.0),
        {pieces.names[k]: [pieces.names[q] for q in met] for k, met in sorted(held.items()) if met},
        volume_error,
    )
    failures = {}
    spared = {place[name] for name in exempt_pieces if name in place}
    blamed = {k for k, met in held.items() if k not in spared and not (met and spared >= {*met})}
    if blamed or unknown:
        failures["assembly"] = [pieces.names[k] for k in sorted({*blamed, *unknown})]
    if wrong:
        failures["volume_error"] = wrong
    return checks, failures


class _Asked(NamedTuple):
    order: Ints
    way: dict[int, Floats]
    shift: dict[int, Floats]
    give: float


def _is_direction(way: Sequence[float] | None) -> bool:
    return way is not None and len(way) == 3 and bool(np.isfinite(way).all()) and bool(np.any(way))


def _volume_errors(pieces: Pieces, laid_out: Mapping[str, float]) -> tuple[float | None, list[str]]:
    """Give the largest share by which a volume is off, and the pieces where it is too large."""
    off = {
        name: abs(mesh_volume(*solid) / laid_out[name] - 1)
        for name, solid in zip(pieces.names, pieces, strict=True)
        if laid_out.get(name, 0) > 0
    }
    return max(off.values(), default=None), [name for name, x in off.items() if x > MOST_VOLUME_ERROR]


def _proved(
    solids: Sequence[Mesh], asked: _Asked, some: Sequence[int]
) -> dict[int, tuple[list[int] | None, float]]:
    """Tell of some pieces what holds them, None for nothing, and how far they press into others, mm."""
    if sum(len(F) for _, F in solids) < FILES_WORTH_A_CHILD:
        return _proved_here(solids, asked, some)
    beside = Background(_proved_here, solids, asked, some[1::2])
    try:
        return _proved_here(solids, asked, some[::2]) | beside.result()
    except BaseException:
        beside.cancel()
        raise


def _proved_here(
    solids: Sequence[Mesh], asked: _Asked, some: Sequence[int]
) -> dict[int, tuple[list[int] | None, float]]:
    obstacles, found = Obstacles(solids), {}
    rank = {int(k): i for i, k in enumerate(asked.order)}
    for k in some:
        found[k] = _held(obstacles, k, asked.order[: rank[k]], asked.way[k], asked.shift[k], asked.give)
    return found


def _held(
    obstacles: Obstacles, k: int, there: Ints, way: Floats, shift: Floats, give: float
) -> tuple[list[int] | None, float]:
    far = float(np.linalg.norm(shift))
    near = obstacles.near(k, there, way, shift)
    if far:
        near = np.union1d(near, obstacles.near(k, there, shift))
    if not len(near):
        return None, 0.0
    staying, of = obstacles.together(near)
    solid, met = obstacles.solids[k], Met(0, near[:0], np.inf)
    for press in (0.0, *(give * (i + 1) / _STEPS for i in range(_STEPS if give > 0 else 0))):
        moving = smaller(solid, press) if press else solid
        first = met_on_the_way(moving, staying, shift, far) if far else Met(0, near[:0], np.inf)
        then = met_on_the_way(Mesh(moving.V + shift, moving.F), staying, way)
        if not first.points and not then.points:
            return None, press
        met = met if met.points else (first if first.points else then)
    return np.unique(of[met.faces]).tolist(), 0.0
