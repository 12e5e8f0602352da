"""The order in which to put a puzzle together."""

import heapq
from collections.abc import Mapping, Sequence
from itertools import chain
from typing import Any, NamedTuple

import numpy as np

from meshjig.mesh.arrays import Floats
from meshjig.mesh.measure import unit
from meshjig.mesh.mesh import concatenate
from meshjig.output.pictures.view import guess_up, up_of
from meshjig.output.piece import Piece

__all__ = ["Assembly", "assembly_of", "assembly_order", "ways_out"]

_MOST_STEPS = 30  # so many pictures a person follows


class Assembly(NamedTuple):
    """Steps of putting pieces together, each a list of pieces counted from 1."""

    steps: list[list[int]]
    verified: bool  # somebody made sure that every piece can get to its place


def assembly_of(pieces: Sequence[Piece], report: Mapping[str, Any]) -> Assembly:
    """Give the order that a report holds, or make one of its neighbours.

    Parameters
    ----------
    pieces : sequence of Piece
    report : mapping
        ``assembly``, if there, is a mapping with ``steps`` and ``verified``; else ``pieces`` are asked
        for their ``neighbours``. ``up`` is where the order goes.

    Returns
    -------
    Assembly
        At most thirty steps: where the report has more, some that follow each other are one.
    """
    planned = report.get("assembly")
    if planned:
        steps = [[int(piece) for piece in step] for step in planned["steps"]]
        a_step = max(-(-len(steps) // _MOST_STEPS), 1)
        together = [list(chain.from_iterable(steps[k : k + a_step])) for k in range(0, len(steps), a_step)]
        return Assembly(together, bool(planned.get("verified", False)))
    listed = [entry["neighbours"] for entry in report.get("pieces", ())]
    neighbours = listed if len(listed) == len(pieces) else [[] for _ in pieces]
    V, F, _, _ = concatenate(pieces)
    return Assembly(assembly_order(pieces, neighbours, up_of(report, V, F)), False)


def ways_out(report: Mapping[str, Any], n: int) -> Floats | None:
    """Give the directions in which pieces go out again, as a report has them.

    Parameters
    ----------
    report : mapping
        ``assembly``, if there, may have ``motions``: by the number of a piece, a mapping with its ``axis``.
    n : int, pieces

    Returns
    -------
    (n, 3) float64, unit, or None where there is no plan. Zero for a piece without an axis.
    """
    motions = (report.get("assembly") or {}).get("motions")
    if not motions:
        return None
    axes = [(motions.get(str(i + 1)) or {}).get("axis") for i in range(n)]
    return unit(np.array([[0.0, 0.0, 0.0] if axis is None else axis for axis in axes], np.float64))


def assembly_order(
    pieces: Sequence[Piece], neighbours: Sequence[Sequence[int]], up: Floats | None = None
) -> list[list[int]]:
    """Order pieces from the bottom up, each on what is there already.

    The lowest piece is first; next is always the lowest of those that touch a piece placed before. Where
    none does, the lowest that is left begins again. Nothing makes sure that a piece can get to its place.

    Parameters
    ----------
    pieces : sequence of Piece
    neighbours : for each piece, the pieces it borders on, counted from 1
    up : (3,) float64, unit; guessed where it is not given

    Returns
    -------
    list of list of int
        Steps of as many pieces each, at most thirty steps; pieces are counted from 1.
    """
    if not pieces:
        return []
    V, F, piece_of_vertex, _ = concatenate(pieces)
    upward = guess_up(V, F) if up is None else up
    height = np.bincount(piece_of_vertex, V @ upward) / np.bincount(piece_of_vertex)
    lowest_first = np.argsort(height, kind="stable").tolist()
    row: list[int] = []
    waiting: list[tuple[float, int]] = []
    known = np.zeros(len(pieces), bool)
    for start in lowest_first:
        if not known[start]:
            known[start] = True
            waiting.append((height[start], start))
        while waiting:
            _, piece = heapq.heappop(waiting)
            row.append(piece + 1)
            for near in neighbours[piece]:
                if not known[near - 1]:
                    known[near - 1] = True
                    heapq.heappush(waiting, (height[near - 1], near - 1))
    a_step = -(-len(row) // _MOST_STEPS)
    return [row[k : k + a_step] for k in range(0, len(row), a_step)]
