"""Pieces laid out for printing: a 3MF a plate, and a sheet that says what is where."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Literal

import numpy as np

from meshjig.errors import OutputError
from meshjig.mesh.types import Floats
from meshjig.output.piece import Piece
from meshjig.output.plates.footprint import convex_ring, footprint, least_rectangle, size_at
from meshjig.output.plates.pack import Spots, fits, pack
from meshjig.output.plates.pose import Pose, lying_pose
from meshjig.output.plates.printers import Plate
from meshjig.solid.printable import printable

__all__ = ["GAP", "Laid", "lay_out", "write_plates"]

GAP = 5.0  # mm; room for a brim


@dataclass(frozen=True)
class Laid:
    """One piece on its plate."""

    piece: Piece  # moved: it lies at z = 0, within the plate from (0, 0) on
    plate: int  # counted from 1
    pose: Pose
    outline: Any  # shapely.Polygon, mm, its shadow on the plate


def lay_out(
    pieces: Sequence[Piece],
    plate: Plate,
    *,
    gap: float = GAP,
    nest: Literal["fast", "tight"] = "fast",
    outer_normals: Floats | None = None,
    left_out: dict[str, str] | None = None,
) -> list[Laid]:
    """Lay pieces down on plates.

    Parameters
    ----------
    pieces : sequence of Piece
    plate : Plate
    gap : float, mm
        Between pieces, and to the border of the plate.
    nest : "fast" or "tight"
        Pack rectangles, or fit outlines into one another (see `meshjig.output.plates.nest.nest`).
    outer_normals : (n, 3) float64, optional
        Where the outer side of each piece faces; zero where that is not known.
    left_out : dict, optional
        Gets a sentence for the name of every piece that fits no plate; these are left out.

    Returns
    -------
    list of Laid, in the order of the pieces

    Raises
    ------
    OutputError
        A piece fits no plate, and there is no dict for it; the sentence names it.
    OptionError
        ``nest`` is tight, and spyrrow is not installed.
    """
    if not pieces:
        return []
    poses = [
        lying_pose(piece.V, piece.F, None if outer_normals is None else outer_normals[i])
        for i, piece in enumerate(pieces)
    ]
    lying = [_on_ground(piece.V @ pose.R.T) for piece, pose in zip(pieces, poses, strict=True)]
    right = [V[:, 2].max() <= plate.height and fits(V[:, :2], plate, gap) for V in lying]
    for i in [i for i, good in enumerate(right) if not good]:
        too_large = _too_large(pieces[i], lying[i], plate)
        if left_out is None:
            raise too_large
        left_out[pieces[i].name] = str(too_large)
    kept = [i for i, good in enumerate(right) if good]
    if not kept:
        return []
    pieces, lying, poses = [pieces[i] for i in kept], [lying[i] for i in kept], [poses[i] for i in kept]
    shadows = [footprint(V, piece.F) for piece, V in zip(pieces, lying, strict=True)]
    spots = _spots(lying, shadows, plate, gap, nest)
    return [
        _laid(pieces[i], lying[i], poses[i], shadows[i], spots.turn[i], spots.shift[i], int(spots.plate[i]))
        for i in range(len(pieces))
    ]


def write_plates(
    folder: Path,
    pieces: Sequence[Piece],
    plate: Plate,
    *,
    gap: float = GAP,
    nest: Literal["fast", "tight"] = "fast",
    outer_normals: Floats | None = None,
) -> list[dict[str, Any]]:
    """Write plates/plate_01.3mf and so on, plates.svg and plates.png.

    Parameters
    ----------
    folder : Path, which exists
    pieces, plate, gap, nest, outer_normals : see `lay_out`

    Returns
    -------
    list of dict, one a piece, in order
        name; plate, counted from 1; x_mm and y_mm, the middle of the piece on it; height_mm;
        overhang_share, of its surface; outer_up, or None where the outer side was not known. At the end
        those that fit no plate: name; plate, None; why, a sentence.

    Raises
    ------
    OptionError
        See `lay_out`.
    """
    from meshjig.output.files.threemf import write_3mf
    from meshjig.output.plates.plate_sheet import draw_plates

    left_out: dict[str, str] = {}
    laid = lay_out(pieces, plate, gap=gap, nest=nest, outer_normals=outer_normals, left_out=left_out)
    (folder / "plates").mkdir()
    n_plates = max((item.plate for item in laid), default=0)
    for number in range(1, n_plates + 1):
        path = folder / "plates" / f"plate_{number:02d}.3mf"
        title = f"meshjig plate {number} of {n_plates}"
        write_3mf(path, (item.piece for item in laid if item.plate == number), title)
    draw_plates(folder, laid, plate)
    too_large = [{"name": name, "plate": None, "why": why} for name, why in left_out.items()]
    return [_fact(item) for item in laid] + too_large


def _spots(lying: list[Floats], shadows: list[Any], plate: Plate, gap: float, nest: str) -> Spots:
    if nest == "tight":
        from meshjig.output.plates.nest import nest as nested

        return nested(shadows, plate, gap)
    return pack([V[:, :2] for V in lying], plate, gap)


def _on_ground(V: Floats) -> Floats:
    """Move a piece to z = 0, its middle to the origin: so its coordinates lose least when rounded."""
    low, high = V.min(axis=0), V.max(axis=0)
    return V - np.array([*(low + high)[:2] / 2, low[2]])


def _laid(piece: Piece, V: Floats, pose: Pose, shadow: Any, turn: float, shift: Floats, plate: int) -> Laid:
    from shapely import affinity

    cos, sin = float(np.cos(turn)), float(np.sin(turn))
    W = V @ np.array([[cos, sin, 0], [-sin, cos, 0], [0, 0, 1]]) + np.array([*shift, 0.0])
    W, F = printable(W, piece.F)
    same = np.array_equal(F, piece.F)
    moved = replace(piece, V=W, F=F, coat=piece.coat if same else None)
    outline = affinity.affine_transform(shadow, [cos, -sin, sin, cos, *shift])
    return Laid(moved, plate + 1, pose, outline)


def _too_large(piece: Piece, V: Floats, plate: Plate) -> OutputError:
    ring = convex_ring(V[:, :2])
    sides = *size_at(ring, np.array([least_rectangle(ring)]))[0], V[:, 2].max()
    size = " x ".join(f"{side:.0f}" for side in sides)
    return OutputError(
        f"{piece.name} ({size} mm) fits no plate of {plate}",
        hint="use a larger --plate, or ask for more pieces",
    )


def _fact(item: Laid) -> dict[str, Any]:
    x, y = (item.piece.V.min(axis=0) + item.piece.V.max(axis=0))[:2] / 2
    return {
        "name": item.piece.name,
        "plate": item.plate,
        "x_mm": float(x),
        "y_mm": float(y),
        "height_mm": item.pose.height,
        "overhang_share": item.pose.overhang,
        "outer_up": item.pose.outer_up,
    }
