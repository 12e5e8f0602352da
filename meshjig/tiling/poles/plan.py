"""How a cap around a pole is divided: wedges that meet, a capstone in the middle, rows around them."""

from dataclasses import dataclass
from itertools import pairwise, product
from typing import Literal

import numpy as np

__all__ = ["PolePlan", "PoleStyle", "plan_pole"]

PoleStyle = Literal["wedge", "capstone"]

MOST_MEET = 8  # wedges that meet in a point
FEWEST_MEET = 4  # wedges of rows that begin in a cap
WIDEST_CAPSTONE = 1.5  # tiles; a wider cap is tiled
LEAST_CAPSTONE = 0.9  # tiles: below, the ring's tiles leave it so much of the cap that no knob has room
TINY = 0.35  # of a tile's area: a cap as small as that makes no piece
BESIDE = 0.1  # of a tile's edge: then they run on so little that its border is round, not as meshes have it
OVER = 0.3  # of a tile's edge, that the ring's tiles at least run on into a cap: knobs have room there
LARGEST = 1.5  # tiles that a wedge may be, what it has of the ring included
ASKEW = 0.02  # what rows cost whose spokes don't go on from those around them
STEPS = 15  # widths tried for what the ring's tiles have of a cap


@dataclass(frozen=True)
class PolePlan:
    """Levels are shares of the distance from the pole to the cap's border."""

    levels: tuple[float, ...]  # from 1 inward: each row's outer border, and that of the middle
    counts: tuple[int, ...]  # tiles in each row but the first, which is the ring's, then wedges in the middle
    capstone: bool  # the middle is one piece
    why: str = ""  # the middle is not as asked for

    @property
    def meeting(self) -> int:
        """Count the wedges that meet at the pole; 0 where the ring's tiles do, or with a capstone."""
        return 0 if self.capstone or not self.counts else self.counts[-1]


def plan_pole(style: PoleStyle, radius: float, depth: float, around: int) -> PolePlan | None:
    """Decide how a cap is divided.

    Parameters
    ----------
    style : "wedge" or "capstone"
    radius : float, of a disc as large as the cap, in edges of a tile
    depth : float, of the ring's last row, in edges of a tile
    around : int, the ring's tiles that end on the cap

    Returns
    -------
    PolePlan or None
        None where the cap is best tiled like any other chart.
    """
    tiny = np.pi * radius**2 < TINY
    meet = 2 <= around <= MOST_MEET
    if tiny and meet:
        small = "" if style == "wedge" else "the cap is too small for a piece of its own"
        return PolePlan((1.0,), (), False, small)
    if style == "wedge":
        last = 2 * np.pi * radius * min(depth, 1.0) / max(around, 1)
        if meet and last + np.pi * radius**2 / around <= LARGEST:
            return PolePlan((1.0,), (), False)
        if radius - OVER > WIDEST_CAPSTONE / 2:
            return _rows(radius, depth, around)
    return _capstone(style, radius, around)


def _capstone(style: PoleStyle, radius: float, around: int) -> PolePlan | None:
    why = ""
    if style == "wedge":
        why = _why(around)
    inner = radius - (OVER if radius - OVER >= LEAST_CAPSTONE / 2 else BESIDE)
    if around >= 2 and np.pi * inner**2 >= TINY and inner <= WIDEST_CAPSTONE / 2:
        return PolePlan((1.0, inner / radius), (), True, why)
    if radius <= WIDEST_CAPSTONE / 2:
        return PolePlan((1.0,), (), True, why)
    return None


def _rows(radius: float, depth: float, around: int) -> PolePlan | None:
    """Find rows whose tiles are nearest to squares of the right size, the ring's, which run on, included."""
    if around < 2:
        return None
    found: list[tuple[float, float, PolePlan]] = []
    widths = np.linspace(OVER, min(1.2, radius - 0.5), STEPS).tolist()
    for width, rows, meet in product(widths, range(int(radius) + 1), range(FEWEST_MEET, MOST_MEET + 1)):
        inner = radius - width
        middle = float(np.sqrt(meet / np.pi)) if rows else inner
        if rows and middle > inner - 0.5:
            continue
        edges = np.linspace(inner, middle, rows + 1)
        girth = np.pi * (edges[:-1] + edges[1:])
        counts = np.maximum(np.rint(girth), meet)
        pieces = np.array([around, *counts, meet])
        last = (2 * np.pi * radius * depth + np.pi * (radius**2 - inner**2)) / around
        rings = np.pi * (edges[:-1] ** 2 - edges[1:] ** 2) / counts
        size = np.array([last, *rings, np.pi * middle**2 / meet])
        tall = np.array([1.0, *(np.diff(-edges) * counts / girth), 1.0])
        cost = float((pieces * (np.log(size) ** 2 + np.log(tall) ** 2)).sum() / pieces.sum())
        counted = tuple(pieces.astype(int).tolist())
        cost += ASKEW * sum(a % b > 0 for a, b in pairwise(counted))
        levels = (1.0, *(edges / radius).tolist())
        found.append((cost, width, PolePlan(levels, counted[1:], False, _why(around))))
    return min(found, key=lambda one: one[:2])[2]


def _why(around: int) -> str:
    """Say why a ring's tiles don't run on to the pole."""
    if around < 2:
        return "one tile of the ring goes all around"
    return f"{around} wedges would meet" if around > MOST_MEET else "wedges would be too large"
