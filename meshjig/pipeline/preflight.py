"""What can be refused before any work is done."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from meshjig.errors import OptionError
from meshjig.mesh.components import components
from meshjig.mesh.halfedges import border_halfedges
from meshjig.mesh.types import Ints, Mesh
from meshjig.options import OptionKeywords, Options
from meshjig.output.plates.lay_out import GAP
from meshjig.output.plates.printers import parse_plate
from meshjig.tiling.registry import get_family
from meshjig.tiling.unit import edge_ends

__all__ = [
    "checked_options",
    "piece_size",
    "refuse_hollow_piece",
    "refuse_small_plate",
    "refuse_too_small_pieces",
    "refuse_unknown_names",
]

FEWEST = 2  # pieces that a puzzle can have
NARROWEST = 0.5  # of a piece's size: pieces as narrow as that are rare
CELL_NECK = 0.13  # of a cell's size; its knobs can be smaller than those of a tile, but not much


def piece_size(mesh: Mesh, options: Options) -> float:
    """Give the edge of a square as large as a piece, mm."""
    return options.piece_size or float(np.sqrt(mesh.areas.sum() / options.pieces))


def checked_options(options: Any, keywords: OptionKeywords) -> Options:
    """Give the options of a call: those that are given as such, else those of its keywords.

    Raises
    ------
    OptionError
        They are no Options, or a keyword is unknown or out of range.
    """
    if options is None:
        return Options.of(**keywords)
    if not isinstance(options, Options):
        raise OptionError(
            f"options: a {type(options).__name__} is no Options",
            hint="make them with Options.of(pieces=30), or give keywords in place of options",
        )
    return options


def refuse_too_small_pieces(size: float, area: float, options: Options) -> None:
    """Refuse pieces whose knobs the clearance would cut off.

    Parameters
    ----------
    size : float, mm, edge of a square as large as a piece
    area : float, of the surface, mm2
    options : Options

    Raises
    ------
    OptionError
        The sentence says what would do.
    """
    neck = CELL_NECK if options.layout == "cells" else _neck_of_tiles(options)
    if neck is None:
        return
    smallest = (2 * options.clearance + 0.1) / neck  # half of the neck is left
    if size >= smallest:
        return
    most, widest = int(area / smallest**2), _two_digits(neck * size / 2 - 0.05, math.floor)
    larger = f"at most {most} pieces"
    if options.piece_size:
        larger = f"pieces of at least {_two_digits(smallest, math.ceil):g} mm"
    ways = [f"a clearance of at most {widest:g} mm"] * (widest > 0) + [larger] * (most >= FEWEST)
    raise OptionError(
        f"pieces of {size:.2g} mm have knobs with a neck of {neck * size:.2g} mm, "
        f"too narrow for a clearance of {options.clearance:g} mm",
        hint=f"use {' or '.join(ways) or 'a larger --size'}",
    )


def refuse_small_plate(size: float, options: Options) -> None:
    """Refuse a plate on which no piece will fit.

    Parameters
    ----------
    size : float, mm, edge of a square as large as a piece
    options : Options

    Raises
    ------
    OptionError
        The sentence says what would do.
    """
    if options.plate is None:
        return
    plate = parse_plate(options.plate)
    if min(plate.width, plate.depth) - 2 * GAP < NARROWEST * size:
        raise OptionError(
            f"plate: pieces of about {size:.2g} mm fit no plate of {plate}, with {GAP:g} mm around each",
            hint="use a larger --plate, or ask for more pieces",
        )


def refuse_hollow_piece(mesh: Mesh, piece: Ints, options: Options) -> None:
    """Refuse to make the model's main part, where it is closed, a single piece: it would be hollow.

    Parameters
    ----------
    mesh : Mesh
    piece : (m,) int64, of every face
    options : Options

    Raises
    ------
    OptionError
        It would be.
    """
    n, component = components(mesh.F)
    main = component == np.bincount(component, mesh.areas, n).argmax()
    open_parts = component[border_halfedges(mesh.F) // 3]
    if np.ptp(piece[main]) == 0 and not np.isin(component[main][:1], open_parts).any():
        joined = options.min_piece > Options.model_fields["min_piece"].default
        hint = f"use a smaller --min-piece than {options.min_piece:g}" if joined else "ask for more pieces"
        raise OptionError("the model would be a single hollow piece", hint=hint)


def refuse_unknown_names(options: Options) -> None:
    """Refuse a tiling or a printer that nobody knows.

    Raises
    ------
    OptionError
        The sentence lists those that are known.
    """
    if options.layout == "tiles":
        get_family(options.tile, options.seed)
    if options.plate is not None:
        parse_plate(options.plate)


def _two_digits(value: float, rounding: Callable[[float], int]) -> float:
    """Round to two digits that count, down or up, so that what is printed still holds; 0 for nothing."""
    if value <= 0:
        return 0.0
    decimals = 1 - math.floor(math.log10(value))
    return round(rounding(value * 10.0**decimals) / 10.0**decimals, max(decimals, 0))


def _neck_of_tiles(options: Options) -> float | None:
    """Give the width of a tile's neck, in sizes of the tile; None where tiles interlock by their shape."""
    unit = get_family(options.tile, options.seed)
    if unit.template is None:
        return None
    ends = edge_ends(unit)
    return unit.template(8).neck_width * float(np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).min())
