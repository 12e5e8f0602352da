"""What would lock a puzzle of cells that have few knobs: tried on the cells themselves."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from meshjig.cells import knob_outlines
from meshjig.mesh.types import Atlas

if TYPE_CHECKING:
    from meshjig.cells import KnobLayout

__all__ = ["FEW_LOCKED", "LockAdvice", "lock_advice"]

FEW_LOCKED = 0.5  # of the length of all borders: less than that holds no puzzle together
_WELL = 0.7  # what has to be locked where cells keep their place: they will not quite
_LARGER = (1.0, 1.15, 1.3, 1.5, 1.75, 2.0, 2.5, 3.0, 4.0, 6.0, 8.0)
_KNOBS = (1.25, 1.5, 2.0)  # sizes of knobs


@dataclass(frozen=True)
class LockAdvice:
    """What would do, each by itself; None where nothing that was tried does."""

    larger: float | None  # times as large as they are, cells lock
    knob_size: float | None  # with knobs of that size they do


def lock_advice(atlas: Atlas, *, size: float, knob_size: float, least_neck: float, seed: int) -> LockAdvice:
    """Find out what would put knobs on most of the borders of cells.

    Cells that are k times as large have room for the same knobs as these have if necks may be k times as
    narrow.

    Parameters
    ----------
    atlas : Atlas, each chart a cell
    size : float, mm, edge of a square as large as a cell
    knob_size : float, relative
    least_neck : float, mm
    seed : int

    Returns
    -------
    LockAdvice

    Notes
    -----
    Draws all knobs some times; meant for where that is better than to leave a maker without advice.
    """

    def locks(knobs: float, larger: float) -> bool:
        made = knob_outlines(atlas, size=size, knob_size=knobs, min_neck=least_neck / larger, seed=seed)
        return _locked(made) >= _WELL

    return LockAdvice(
        next((k for k in _LARGER if locks(knob_size, k)), None),
        next((k for k in _KNOBS if k > knob_size and locks(k, 1.0)), None),
    )


def _locked(knobs: KnobLayout) -> float:
    """Give the share of the length of all borders that belongs to those with a knob."""
    total = float(knobs.length.sum())
    return float(knobs.length[knobs.knob_of_border >= 0].sum()) / total if total else 0.0
