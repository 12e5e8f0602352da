"""Pieces on plates: how each lies, and where."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np

from meshjig.errors import OptionError
from meshjig.mesh.arrays import Floats
from meshjig.mesh.mesh import Mesh
from meshjig.output.piece import Piece
from meshjig.output.plates.pack import (
    Placements,
    convex_ring,
    fits,
    footprint,
    least_rectangle,
    pack,
    size_at,
)
from meshjig.output.plates.pose import Pose, axis_poses, lying_pose
from meshjig.output.plates.printers import Nesting, Plate
from meshjig.output.texture import carried
from meshjig.solid.printable import printable

__all__ = ["GAP", "LeftOut", "PlacedPiece", "lay_out"]

GAP = 5.0  # mm; room for a brim
_ADVICE = "use a larger --plate, or ask for more pieces"


@dataclass(frozen=True)
class PlacedPiece:
    """One piece on its plate."""

    piece: Piece  # moved: it lies at z = 0, within the plate from (0, 0) on
    plate: int  # counted from 1
    pose: Pose
    outline: Any  # shapely.Polygon, mm, its shadow on the plate


@dataclass(frozen=True)
class LeftOut:
    """A piece that fits no plate, as the report's ``plates`` have it."""

    name: str
    plate: None
    why: str  # a sentence


class _Lying(NamedTuple):
    """A piece as it lies, its middle at the origin."""

    piece: Piece
    V: Floats  # (n, 3), mm
    pose: Pose


def lay_out(
    pieces: Sequence[Piece], plate: Plate, *, gap: float = GAP, nest: Nesting = "fast"
) -> tuple[list[PlacedPiece], list[LeftOut]]:
    """Lay pieces down on plates.

    Parameters
    ----------
    pieces : sequence of Piece
    plate : Plate
    gap : float, mm
        Between pieces, and to the border of the plate.
    nest : "fast" or "tight"
        Pack rectangles, or fit outlines into one another (see `meshjig.output.plates.nest.nest`).

    Returns
    -------
    placed : list of PlacedPiece, in the order of the pieces
    left_out : list of LeftOut

    Raises
    ------
    OptionError
        No piece fits; or ``nest`` is tight, and spyrrow is not installed.
    """
    lying, left_out = [], []
    sides: list[tuple[float, ...]] = []  # of those left out
    for piece in pieces:
        found = []
        for pose in _poses(piece):
            V = _on_ground(piece.V @ pose.R.T)
            found.append(_sides(V))
            if V[:, 2].max() <= plate.height and fits(V[:, :2], plate, gap):
                lying.append(_Lying(piece, V, pose))
                break
        else:
            sides.append(found[0])
            left_out.append(LeftOut(piece.name, None, _too_large(piece.name, sides[-1], plate)))
    if not lying:
        if left_out:
            raise _none_fits(min(sides), plate, gap)
        return [], []
    shadows = [footprint(one.V, one.piece.F) for one in lying]
    if nest == "tight":
        from meshjig.output.plates.nest import nest as nested

        where = nested(shadows, plate, gap)
    else:
        where = pack([one.V[:, :2] for one in lying], plate, gap)
    placed = [
        _placed(one, shadow, where, i) for i, (one, shadow) in enumerate(zip(lying, shadows, strict=True))
    ]
    return placed, left_out


def _poses(piece: Piece) -> Iterator[Pose]:
    """Give poses in which a piece may lie; a block of a core also along the axes, should it not fit."""
    yield lying_pose(piece.V, piece.F, piece.outer_normal)
    if piece.name.startswith("core_"):
        yield from axis_poses(piece.V, piece.F)


def _on_ground(V: Floats) -> Floats:
    """Move a piece to z = 0, its middle to the origin: so its coordinates lose least when rounded."""
    low, high = V.min(axis=0), V.max(axis=0)
    return V - np.array([*(low + high)[:2] / 2, low[2]])


def _placed(lying: _Lying, shadow: Any, where: Placements, i: int) -> PlacedPiece:
    """Move a piece, and its shadow, to where the i-th goes."""
    from shapely import affinity

    piece, V, pose = lying
    turn, shift = where.turn[i], where.shift[i]
    cos, sin = float(np.cos(turn)), float(np.sin(turn))
    W = V @ np.array([[cos, sin, 0], [-sin, cos, 0], [0, 0, 1]]) + np.array([*shift, 0.0])
    before, texture = Mesh(W, piece.F), piece.texture
    W, F = printable(W, piece.F)
    if texture is not None and not np.array_equal(F, piece.F):
        texture = carried(texture, before, Mesh(W, F))
    moved = replace(piece, V=W, F=F, texture=texture)
    outline = affinity.affine_transform(shadow, [cos, -sin, sin, cos, *shift])
    return PlacedPiece(moved, int(where.plate[i]) + 1, pose, outline)


def _sides(V: Floats) -> tuple[float, ...]:
    """Give the sides of the least box around a piece as it lies, mm, the longer of the lower two first."""
    ring = convex_ring(V[:, :2])
    return *sorted(size_at(ring, np.array([least_rectangle(ring)]))[0], reverse=True), float(V[:, 2].max())


def _size(sides: tuple[float, ...]) -> str:
    return " x ".join(f"{side:.0f}" for side in sides)


def _too_large(name: str, sides: tuple[float, ...], plate: Plate) -> str:
    return f"{name} ({_size(sides)} mm) fits no plate of {plate}: {_ADVICE}"


def _none_fits(smallest: tuple[float, ...], plate: Plate, gap: float) -> OptionError:
    return OptionError(
        f"plate: no piece fits a plate of {plate}, with {gap:g} mm around each; "
        f"the smallest is {_size(smallest)} mm",
        hint=_ADVICE,
    )
