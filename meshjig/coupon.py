"""The coupon: pairs of tiles with a knob between them, at several clearances, to find a printer's own."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from meshjig.options import Options
from meshjig.output.colours import colours
from meshjig.output.estimate import estimate
from meshjig.output.folder import replace_folder
from meshjig.output.piece import Piece
from meshjig.output.printable import printable
from meshjig.output.report import write_report
from meshjig.output.stl import write_stl
from meshjig.output.threemf import write_3mf
from meshjig.report import meshjig_version
from meshjig.tiling.classic import classic

__all__ = ["coupon_clearances", "make_coupon", "save_coupon"]

EDGE = 25.0  # mm, of a tile
NECK = 0.13  # of the edge, a classic knob's
BELOW, ABOVE = 2, 4  # steps below and above the process's own clearance
STEP = 0.25  # of that clearance
SPACE = 5.0  # mm between any two tiles
COLUMNS = 2  # pairs side by side
ENGRAVED = 0.3  # of the thickness
STROKE, TEXT = 0.9, 5.0  # mm, width of a line and height of a digit
_FINE = 24  # points a cubic of the knob

HOW_TO = (
    "Print the tiles flat, as they lie, with the settings meant for the puzzle. The number on a tile is "
    "the gap of its pair in mm. Push each pair together from above: the right one goes in by hand, holds "
    "when lifted by one tile, and comes apart without force. Give its number to --clearance."
)


def coupon_clearances(clearance: float) -> list[float]:
    """Give the gaps that are worth trying around a process's own, mm, in steps of a hundredth."""
    step = max(round(STEP * clearance, 2), 0.01) if clearance else 0.05
    tried = (round(clearance + k * step, 3) for k in range(-BELOW, ABOVE + 1))
    return [gap for gap in tried if gap > 0]


def make_coupon(options: Options) -> list[Piece]:
    """Make pairs of flat tiles that share a border with a classic knob.

    Parameters
    ----------
    options : Options
        Thickness, clearance and min_neck count.

    Returns
    -------
    list of Piece
        A male and a female a clearance, named after it, side by side on the plane z = 0; each is closed,
        and the clearance is engraved on its upper side. The gap between a pair that is put together is
        its clearance all along the border.
    """
    gaps = coupon_clearances(options.clearance)
    edge = max(EDGE, (options.min_neck + max(gaps)) / NECK)
    border = classic(_FINE).points * edge
    reach = float(border[:, 1].max())
    solids = []
    for k, gap in enumerate(gaps):
        across = (k % COLUMNS) * (2 * edge + reach + 2 * SPACE)
        along = -(k // COLUMNS) * (edge + SPACE)
        male, female = _pair(border, edge, gap)
        text = f"{gap:.2f}" if round(gap, 2) == gap else f"{gap:.3f}"
        depth = ENGRAVED * options.thickness
        for shape, name, shift in ((male, "male", 0.0), (female, "female", reach + SPACE)):
            middle = (edge / 2 + (0.0 if name == "male" else edge + 0.12 * edge), edge * 0.12 + TEXT / 2)
            solid = _extruded(shape, options.thickness, _digits(text, middle), depth)
            V = solid[0] + (across + shift, along, 0.0)
            solids.append((f"clearance_{text}_{name}", *printable(V, solid[1])))
    tints = colours(len(solids), np.zeros((0, 2), np.int64)).tolist()
    return [Piece(name, V, F, tuple(tints[i])) for i, (name, V, F) in enumerate(solids)]
