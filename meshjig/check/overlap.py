"""How much space pieces share."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from typing import Any, NamedTuple

from meshjig.mesh.pieces import Pieces

__all__ = ["Overlaps", "overlaps", "overlaps_between"]


class Overlaps(NamedTuple):
    """The space that pieces share."""

    total: float | None  # mm3; None when a piece could not be measured
    pairs: list[tuple[int, int, float]]  # pieces that share space, and how much, mm3
    unmeasured: list[int]  # pieces that are no manifold and so have no inside


def overlaps(pieces: Iterable[Any]) -> Overlaps:
    """Measure the space shared by every two pieces, neighbours or not.

    Two pieces whose boxes don't touch share nothing; for all others the volume of the intersection
    is taken by manifold3d in double precision.

    Parameters
    ----------
    pieces : list of (V, F)
        V (n, 3) float64, mm; F (m, 3) int64.

    Returns
    -------
    Overlaps
        A piece that manifold3d refuses is listed as unmeasured, and makes the total None.
    """
    pieces = Pieces.of(pieces)
    return overlaps_between(pieces, pieces.close(0.0).tolist())


def overlaps_between(
    pieces: Pieces, pairs: Sequence[Sequence[int]], apart: Collection[tuple[int, int]] = ()
) -> Overlaps:
    """Measure the space shared by named pairs of pieces, as overlaps() does.

    Parameters
    ----------
    pieces : Pieces
    pairs : (k, 2) pieces, lower first
    apart : pairs, lower first, whose distance is known to be more than 0: they share nothing
    """
    bodies = pieces.bodies
    unmeasured = [i for i, body in enumerate(bodies) if body is None]
    found = []
    for i, j in pairs:
        one, other = bodies[i], bodies[j]
        if one is None or other is None or (i, j) in apart:
            continue
        shared = float((one ^ other).volume())
        if shared > 0:
            found.append((int(i), int(j), shared))
    total = None if unmeasured else sum(shared for _, _, shared in found)
    return Overlaps(total, found, unmeasured)
