"""How much space pieces share."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import NamedTuple

from meshjig.check.solids import Body, bodies
from meshjig.mesh.validated import Piece, boxes, close_boxes

__all__ = ["Overlaps", "overlaps", "overlaps_of_bodies"]


class Overlaps(NamedTuple):
    """The space that pieces share."""

    total: float | None  # mm3; None when a piece could not be measured
    pairs: list[tuple[int, int, float]]  # pieces that share space, and how much, mm3
    unmeasured: list[int]  # pieces that are no manifold and so have no inside


def overlaps(pieces: Sequence[Piece]) -> Overlaps:
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
    low, high = boxes(pieces)
    return overlaps_of_bodies(bodies(pieces), close_boxes(low, high, 0.0).tolist())


def overlaps_of_bodies(
    bodies: Sequence[Body], pairs: Sequence[Sequence[int]], apart: Collection[tuple[int, int]] = ()
) -> Overlaps:
    """Measure the space shared by named pairs of bodies, as overlaps() does.

    Parameters
    ----------
    bodies : as bodies() gives them
    pairs : (k, 2) pieces, lower first
    apart : pairs, lower first, whose distance is known to be more than 0: they share nothing
    """
    unmeasured = [i for i, body in enumerate(bodies) if body is None]
    found = []
    for i, j in pairs:
        if bodies[i] is None or bodies[j] is None or (i, j) in apart:
            continue
        shared = float((bodies[i] ^ bodies[j]).volume())
        if shared > 0:
            found.append((int(i), int(j), shared))
    total = None if unmeasured else sum(shared for _, _, shared in found)
    return Overlaps(total, found, unmeasured)
