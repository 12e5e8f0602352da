"""From a clean mesh in its file's units to what is used of it, in mm."""

from __future__ import annotations

from typing import NamedTuple

from meshjig.errors import InputError
from meshjig.mesh.arrays import Floats, Ints
from meshjig.scan.contacts import draw_apart
from meshjig.scan.floor import AXES, FloorFacts, cut_floor, height_above
from meshjig.scan.keep import keep_largest
from meshjig.scan.preparation import Preparation
from meshjig.scan.scale import Scaled, choose_scale, in_millimetres
from meshjig.scan.source import Source

__all__ = ["Sized", "to_size"]


class Sized(NamedTuple):
    """What is used of a model."""

    scaled: Scaled  # its vertices, in mm
    F: Ints  # (m, 3)
    floor: FloorFacts | None  # None when none was cut off
    notes: list[str]  # what was left out or moved, a sentence each


def to_size(V: Floats, F: Ints, source: Source, size: float | None, asked: Preparation) -> Sized:
    """Leave out what is not wanted of a model, and scale the rest to mm.

    Heights to cut at are in mm of the finished model, and its size is that of what is left.

    Parameters
    ----------
    V : (n, 3) float64, in the units of the source
    F : (m, 3) int64, clean
    source : Source, which says its unit and which way is up
    size : float, mm, the largest extent; None: see `to_millimetres`
    asked : Preparation

    Returns
    -------
    Sized

    Raises
    ------
    InputError
        Nothing is left above the floor, or a base that is to stand can't be closed.
    """
    notes = []
    V, F, left_out, share = keep_largest(V, F, asked.keep)
    if left_out:
        n = asked.keep if isinstance(asked.keep, int) else 1
        notes.append(
            f"of {left_out + n} connected parts the largest {f'{n} are' if n > 1 else 'is'} kept: "
            f"{left_out} with {share:.1%} of the area {'are' if left_out > 1 else 'is'} left out"
        )
    scale, words = choose_scale(V, size, asked.unit, source.unit)
    floor = None
    if asked.floor:
        axis = asked.floor.up(source)
        height, mm = height_above(V, asked.floor, axis, scale, size)
        V, F, closed, left_open = cut_floor(
            V, F, axis, float(V[:, axis].min()) + height, stays_open=asked.floor.open
        )
        floor = FloorFacts(AXES[axis], mm, closed, left_open)
        if asked.floor.stands and not asked.floor.open and (left_open or not closed):
            raise InputError(
                f"the model is open where it is cut, {mm:.4g} mm above its lowest point along {AXES[axis]}, "
                "so that its base can't be closed",
                hint="cut at another height, along another axis (--up), or let the base open (--open-base)",
            )
        notes.append(_told(floor, asked.floor.open))
        scale, words = choose_scale(V, size) if size is not None else (scale, words)
    scaled = in_millimetres(V, scale, words)
    contacts = draw_apart(scaled.V, F, asked.apart)
    if contacts.n_vertices:
        where = ", ".join(f"{x:.4g}" for x in contacts.at)
        notes.append(
            f"parts of the surface touch each other (first at ({where}) mm): there each is drawn back by "
            f"{asked.apart / 2:g} mm, so that pieces keep the clearance"
        )
        scaled = scaled._replace(V=contacts.V)
    return Sized(scaled, F, floor, notes)


def _told(floor: FloorFacts, stays_open: bool) -> str:
    """Say what was cut off, and what became of the cut."""
    if stays_open:
        rest = "the base is left open"
    elif not floor.closed and not floor.left_open:
        rest = "nothing had to be closed"
    else:
        rest = f"a plane closes the cut ({_outlines(floor.closed)})" if floor.closed else "the cut stays open"
        rest += f", but not where the model is open ({_outlines(floor.left_open)})" * bool(floor.left_open)
    return f"cut off below {floor.above_lowest_mm:.4g} mm above the lowest point along {floor.axis}; {rest}"


def _outlines(n: int) -> str:
    return f"{n} outline{'s' * (n != 1)}"
