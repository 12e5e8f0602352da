"""Which piece goes where on which plate: outlines fitted into one another, by spyrrow."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from meshjig.errors import OptionError
from meshjig.mesh.arrays import Floats, Ints
from meshjig.output.plates.pack import Placements, pack
from meshjig.output.plates.printers import Plate

__all__ = ["nest"]

SECONDS = 10  # for a plate, once
TRIES = 2  # sets of pieces tried for a plate
DENSE = 0.82  # share of a plate that outlines can fill, from above
_SMOOTH = 0.05  # mm
_CHORDS = 6  # a quarter of a circle


def nest(outlines: Sequence[Any], plate: Plate, gap: float, seed: int = 0) -> Placements:
    """Nest outlines onto plates, the largest first, a plate at a time.

    Parameters
    ----------
    outlines : sequence of shapely.Polygon, mm; their holes stay empty
    plate : Plate
    gap : float, mm, see `meshjig.output.plates.pack.pack`
    seed : int

    Returns
    -------
    Placements
        On no more plates than `meshjig.output.plates.pack.pack` needs: its packing where nesting saves none.

    Raises
    ------
    OptionError
        spyrrow is not installed.
    OutputError
        An outline fits no plate; ``ids`` names it.

    Notes
    -----
    Takes 10 to 30 seconds a plate. The search stops by the clock, so that results differ a little from
    run to run.

    References
    ----------
    Gardeyn, Vanden Berghe and Wauters, "An open-source heuristic to reboot 2D nesting research", 2025.
    """
    try:
        import spyrrow  # noqa: F401
    except ImportError:
        raise OptionError(
            "nest: tight needs the package spyrrow", hint="pip install meshjig[nest], or use --nest fast"
        ) from None
    plain = pack([np.array(outline.exterior.coords) for outline in outlines], plate, gap)
    wide = [_widened(outline, gap) for outline in outlines]
    area = np.array([outline.area for outline in wide])
    left = np.argsort(-area, kind="stable")
    bed = np.array(plate[:2]) - gap
    number, turn, shift = np.zeros(len(wide), np.int64), np.zeros(len(wide)), np.zeros((len(wide), 2))
    for k in range(plain.n_plates - 1):
        if area[left].sum() > DENSE * bed.prod() * (plain.n_plates - 1 - k):
            break  # no plate will be saved
        chosen, placed = _fill(wide, area, left, bed, seed)
        number[chosen], turn[chosen], shift[chosen] = k, placed[:, 0], placed[:, 1:] + gap / 2
        left = left[~np.isin(left, chosen)]
        if not len(left):
            return Placements(number, turn, shift)
    return plain


def _widened(outline: Any, gap: float) -> Any:
    """Grow an outline by half the gap at least, and drop what does not matter; no holes."""
    import shapely

    whole = shapely.Polygon(outline.exterior)
    chord = np.cos(np.pi / 4 / _CHORDS)
    return whole.buffer(gap / 2 / chord + _SMOOTH, quad_segs=_CHORDS).simplify(_SMOOTH)


def _fill(wide: Sequence[Any], area: Floats, left: Ints, bed: Floats, seed: int) -> tuple[Ints, Floats]:
    """Choose of the pieces that are left some that fit a plate, (k,), and place them: turn, shift, (k, 3)."""
    full = float(DENSE * bed.prod())
    best: tuple[float, Ints, Floats] = (0.0, left[:0], np.zeros((0, 3)))
    for _ in range(TRIES):
        n = int(np.searchsorted(np.cumsum(area[left]), full, side="right"))
        if n == 0:
            break
        placed, right = _strip([wide[i] for i in left[:n]], float(bed[1]), seed)
        inside = right <= bed[0]
        best = max(best, (float(area[left[:n][inside]].sum()), left[:n][inside], placed[inside]), key=_first)
        if inside.all():
            break
        full *= float(bed[0] / right.max())
    return best[1:]


def _first(choice: tuple[float, Ints, Floats]) -> float:
    return choice[0]


def _strip(wide: Sequence[Any], depth: float, seed: int) -> tuple[Floats, Floats]:
    """Nest into a strip: turn and shift of every outline, (n, 3), and how far right it reaches, (n,)."""
    import spyrrow

    items = [
        spyrrow.Item(str(i), [(x, y) for x, y in outline.exterior.coords[:-1]], 1, None)
        for i, outline in enumerate(wide)
    ]
    config = spyrrow.StripPackingConfig(total_computation_time=SECONDS, seed=seed)
    found = spyrrow.StripPackingInstance("plate", depth, items).solve(config)
    placed, right = np.zeros((len(wide), 3)), np.zeros(len(wide))
    for item in found.placed_items:
        i = int(item.id)
        turn = np.radians(item.rotation)
        placed[i] = turn, *item.translation
        x, y = np.array(wide[i].exterior.coords).T
        right[i] = (np.cos(turn) * x - np.sin(turn) * y).max() + item.translation[0]
    return placed, right
