"""A motion for every piece, found by trying on the solids themselves."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from meshjig.check.assembly import Obstacles, smaller
from meshjig.check.straight import Trials, across, met_on_the_way
from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.mesh import Mesh
from meshjig.runtime.thresholds import FILES_WORTH_A_CHILD
from meshjig.runtime.worker import Background

__all__ = ["Found", "Motion", "find_motions"]

_SHIFT = 0.45  # of the clearance, that a piece may be moved by in its place before it goes out
_AROUND = 2 * np.pi * np.arange(8) / 8  # directions that are tried
_WORTH_A_CHILD = 8  # pieces
_LEANS = np.radians([2.5, 5.0, 9.0])  # of other ways


class Motion(NamedTuple):
    """How a piece goes out: moved a little in its place, then straight along its way."""

    way: Floats  # (3,), unit
    shift: Floats  # (3,), mm
    met: dict[int, int]  # pieces that hold it, and how many points do; empty where it is free

    def renumbered(self, number: Ints) -> Motion:
        """Give the same with other numbers of the pieces, (p,)."""
        return self._replace(met={int(number[q]): n for q, n in self.met.items()})


class Found(NamedTuple):
    """Motions, and what they were found past."""

    motions: list[Motion]
    near: list[Ints]  # by piece: those that were there and in its way
    way: Floats  # (p, 3), that was planned


def find_motions(
    solids: Sequence[Mesh],
    rank: Ints,
    way: Floats,
    clearance: float,
    give: float,
    before: tuple[Found, Bools] | None = None,
) -> Found:
    """Find for every piece a motion past all that was put in before it.

    Parameters
    ----------
    solids : list of Mesh, closed, without common space
    rank : (p,) int64, 0 for the first that is put in
    way : (p, 3) float64, unit, the way out that was planned; others near it are tried, too
    clearance : float, mm, between pieces
    give : float, mm, by which pieces may press into each other
    before : Found and (p,) bool, optional
        What was found, and which of the same pieces have other solids now: what is still so is kept.
    """
    obstacles = Obstacles(solids)
    near = [_around(obstacles, k, np.flatnonzero(rank < rank[k]), way[k]) for k in range(len(solids))]
    todo = np.arange(len(solids))
    if before is not None:
        known, changed = before
        todo = todo[
            [
                bool(changed[k] or changed[near[k]].any() or (way[k] != known.way[k]).any())
                or not np.array_equal(near[k], known.near[k])
                for k in range(len(solids))
            ]
        ]
    size = sum(len(solids[k].F) for k in todo.tolist())
    asked = solids, near, way, clearance, give
    if size < FILES_WORTH_A_CHILD or len(todo) < _WORTH_A_CHILD:
        found = _found(*asked, todo)
    else:
        beside = Background(_found, *asked, todo[1::2])
        try:
            found = _found(*asked, todo[::2]) | beside.result()
        except BaseException:
            beside.cancel()
            raise
    motions = [found[k] if before is None or k in found else before[0].motions[k] for k in range(len(solids))]
    return Found(motions, near, way)


def _around(obstacles: Obstacles, k: int, there: Ints, way: Floats) -> Ints:
    """Give of some pieces those that may be in the way, or in another near it."""
    tried = [obstacles.near(k, there, other) for other in (way, *_ways(way))]
    return np.unique(np.concatenate(tried))


def _found(
    solids: Sequence[Mesh], near: Sequence[Ints], way: Floats, clearance: float, give: float, some: Ints
) -> dict[int, Motion]:
    obstacles = Obstacles(solids)
    return {k: _motion(obstacles, k, near[k], way[k], clearance, give) for k in some.tolist()}


def _motion(obstacles: Obstacles, k: int, there: Ints, way: Floats, clearance: float, give: float) -> Motion:
    still, moving = np.zeros(3), obstacles.solids[k]
    near = obstacles.near(k, there, way)
    if not len(near):
        return Motion(way, still, {})
    staying, of = obstacles.together(near)
    first = met_on_the_way(moving, staying, way)
    if not first.points:
        return Motion(way, still, {})

    trials = Trials(moving, obstacles.together(there)[0])
    for shift in _shifts(way, _SHIFT * clearance):
        if (
            trials.is_free(way, shift)
            and not met_on_the_way(moving, staying, shift, _SHIFT * clearance).points
        ):
            return Motion(way, shift, {})
    if give > 0 and not met_on_the_way(smaller(moving, give), staying, way, first_only=True).points:
        return Motion(way, still, {})
    for other in _ways(way):
        if trials.is_free(other, still):
            return Motion(other, still, {})
    holds, points = np.unique(of[first.faces], return_counts=True)
    return Motion(way, still, dict(zip(holds.tolist(), points.tolist(), strict=True)))


def _shifts(way: Floats, length: float) -> Iterator[Floats]:
    x, y, _ = across(way)
    for turn in _AROUND:
        yield length * (np.cos(turn) * x + np.sin(turn) * y)


def _ways(way: Floats) -> Iterator[Floats]:
    x, y, _ = across(way)
    for lean in _LEANS:
        for turn in _AROUND:
            yield np.cos(lean) * way + np.sin(lean) * (np.cos(turn) * x + np.sin(turn) * y)
