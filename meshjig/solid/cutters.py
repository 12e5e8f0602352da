"""The bodies that take the gap out of the pieces, border by border."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from meshjig.measure import unit
from meshjig.solid.bodies import Body, body, sound
from meshjig.solid.borders import Chains
from meshjig.solid.offsets import Strip, mitered
from meshjig.solid.simplify_chain import simplified
from meshjig.solid.slab import slabs
from meshjig.types import Floats, Ints

__all__ = ["Cutter", "border_cutters", "walls"]

_TOLERANCE = 0.02  # mm, of the walls' lines; an eighth of the gap when that is less
_BEYOND = 0.3  # mm, that a wall is extended past both sheets; the gap when that is more


class Cutter(NamedTuple):
    """A body that both pieces at a border lose."""

    pair: tuple[int, int]
    body: Body


def walls(V: Floats, D: Floats, chains: Chains, clearance: float) -> tuple[Strip, Ints, Ints]:
    """Lay quads along borders, as few as their shape allows, and some way beyond both sheets.

    Parameters
    ----------
    V : (n, 3) float64, mm
    D : (n, 3) float64, mm, from the top of the wall to its bottom
    chains : Chains
    clearance : float, mm

    Returns
    -------
    strip : Strip
    after : (s,) int64, the quad that follows in its line, or -1
    line : (s,) int64, the line of each quad
    """
    v = chains.vertex
    kept = simplified([V[v], V[v] + D[v]], chains.start, min(_TOLERANCE, clearance / 8))
    line = np.repeat(np.arange(len(chains.pair)), np.diff(chains.start))[kept]
    v = v[kept]
    past = max(_BEYOND, clearance) * unit(D[v])
    top, bottom = V[v] - past, V[v] + D[v] + past
    a = np.flatnonzero(line[1:] == line[:-1])
    line = line[a]
    after = np.append(np.where(line[1:] == line[:-1], np.arange(1, len(a)), -1), -1)
    start = np.searchsorted(line, np.arange(len(chains.pair)))
    end = np.searchsorted(line, np.arange(len(chains.pair)), side="right") - 1
    ring = v[a[start]] == v[a[end] + 1]
    after[end[ring]] = start[ring]
    return Strip((top[a], bottom[a]), (top[a + 1], bottom[a + 1])), after, line


def border_cutters(strip: Strip, after: Ints, clearance: float) -> tuple[list[tuple[Ints, Body]], dict[str, Any]]:
    """Thicken walls to bodies as wide as the gap.

    Parameters
    ----------
    strip : Strip
    after : (s,) int64
    clearance : float, mm

    Returns
    -------
    cutters : list of (quads (k,) int64, body)
    facts : {"segments": quads, "slabs": int, "rounded": joints that were broken, "hulls": quads that had to
        be covered by a convex hull}
    """
    half = clearance / 2
    offsets = mitered(strip, after, half)
    made, failed = [], list(np.flatnonzero(offsets.failed))
    for quads, V, F in slabs(strip, offsets, half):
        solid = body(V, F)
        if sound(solid):
            made.append((quads, solid))
        else:
            failed += list(quads)
    facts = {
        "segments": len(after),
        "slabs": len(made),
        "rounded": int(((after >= 0) & (offsets.after < 0)).sum()),
        "hulls": len(failed),
    }
    return made + [(np.array([s]), hull(strip, s, half)) for s in failed], facts


def hull(strip: Strip, quad: int, half: float) -> Body:
    """Give the convex hull of balls of a radius around the corners of a quad, or a little more."""
    import manifold3d

    corners = np.stack([row[quad] for row in (*strip.first, *strip.last)])
    return manifold3d.Manifold.hull_points((corners[:, None] + half * _ball()).reshape(-1, 3))


def _ball() -> Floats:
    """Give the corners of an icosahedron around the unit ball, (12, 3)."""
    g = (1 + np.sqrt(5)) / 2
    points = np.array([[0, a, b * g] for a in (-1, 1) for b in (-1, 1)], float)
    points = np.concatenate([points, np.roll(points, 1, 1), np.roll(points, 2, 1)])
    return points * np.sqrt(3) / g**2
