"""Labels: text engraved into the inner side of pieces, or into a wall where both sides are seen."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from meshjig.extras.groove import groove
from meshjig.extras.label_ground import LabelGround
from meshjig.extras.label_place import LabelPlace, label_places
from meshjig.extras.text import text_outline
from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.booleans import Body, arrays, body, sound
from meshjig.mesh.components import components
from meshjig.mesh.measure import area_vectors, barycentric, unit
from meshjig.mesh.types import Mesh

__all__ = ["LETTERING", "LabelFacts", "Lettering", "engrave"]

_MOST = 0.35  # of the wall, that is taken away
_LEAST = 0.6  # of the depth that was asked for; what is shallower can't be read
_SIZES = 3  # tried, from the height to the least height
_TAPER = 0.62  # of its depth, by which a stroke narrows on either side: over 30 degrees are no wall
_SHARPEST = 0.45  # of a stroke
_STEEPEST = 0.6  # cosine between the plane of a text and any face under it
_FINE = 1.2  # mm; edges of the text's body, which follows the sheet
_FLAT = 0.02  # mm; a sheet that is less uneven under a text is flat
_NO_ROOM = "it reaches through the model, and neither an inner side nor a wall of it has room"
_AS_EXPECTED = (0.7, 1.3)  # of the text's area times its depth


class Lettering(NamedTuple):
    """What text a process can make, all in mm."""

    height: float
    least_height: float
    stroke: float
    depth: float


LETTERING = {
    "fdm": Lettering(5.0, 4.0, 0.8, 0.4),
    "sla": Lettering(3.0, 2.4, 0.4, 0.3),
    "polyjet": Lettering(3.0, 2.4, 0.4, 0.3),
    "foam": Lettering(10.0, 7.0, 1.5, 1.0),
}


@dataclass(frozen=True)
class LabelFacts:
    """What the report says of the labels."""

    engraved: int
    least_height_mm: float | None  # of the smallest text, None without any
    skipped: dict[str, str]  # label: why
    on_walls: tuple[str, ...] = ()  # labels that stand on a wall between pieces: both sides of these are seen


def engrave(
    pieces: Iterable[Mesh | tuple[Floats, Ints]],
    labels: Sequence[str],
    grounds: Sequence[LabelGround],
    lettering: Lettering,
    *,
    min_wall: float = 0.0,
) -> tuple[list[tuple[Floats, Ints]], LabelFacts]:
    """Engrave a label into the inner side of every piece where it fits, else into a wall that may have it.

    The text lies where the ground is widest and nearly flat, follows its curvature, and is evenly deep.
    It takes no more than 35 % of what is behind it, and leaves at least the least wall.

    Parameters
    ----------
    pieces : list of (V, F)
        V (n, 3) float64, mm; F (m, 3) int64, closed and oriented outward.
    labels : list of str, one a piece
    grounds : list of LabelGround, one a piece
    lettering : Lettering
    min_wall : float, mm, what the process can make

    Returns
    -------
    pieces : list of (V, F)
        In the same order; those that got no label are as they were.
    facts : LabelFacts

    Raises
    ------
    OptionError
        A label can't be written in this lettering.
    """
    shallowest = _LEAST * lettering.depth
    needed = max(shallowest / _MOST, shallowest + min_wall)
    made, skipped, heights, on_walls = [], {}, [], []
    for (V, F), label, (inner, side) in zip(pieces, labels, grounds, strict=True):
        for behind in (inner,) if side is None else (inner, side):
            ground = np.flatnonzero(behind >= needed)
            done = _engraved(Mesh(V, F), ground, behind, label, lettering, min_wall) if len(ground) else None
            if done is not None:
                made.append(done[0])
                heights.append(done[1])
                on_walls += [label] if behind is side else []
                break
        else:
            made.append((V, F))
            skipped[label] = _why(V, F, inner, needed) if side is None else _NO_ROOM
    return made, LabelFacts(len(heights), min(heights, default=None), skipped, tuple(on_walls))


def _why(V: Floats, F: Ints, wall: Floats, needed: float) -> str:
    if not wall.any():
        return "it has no inner side"
    area = np.linalg.norm(area_vectors(V, F), axis=1)
    if area[wall >= needed].sum() < area[wall > 0].sum() / 2:
        return f"its wall is under {needed:.2g} mm"
    return "its inner side is too small or too curved"


def _engraved(
    piece: Mesh, ground: Ints, wall: Floats, label: str, lettering: Lettering, min_wall: float
) -> tuple[tuple[Floats, Ints], float] | None:
    """Engrave one piece; give it with the height of its text, or None where there is no place."""
    whole, V, sheet, wall = body(*piece), piece.V, piece.F[ground], wall[ground]
    heights = np.linspace(lettering.height, lettering.least_height, _SIZES).tolist()
    outlines = [text_outline(label, height, lettering.stroke) for height in heights]
    sizes = [2 * np.array(outline.bounds[2:]) for outline in outlines]
    inset = min(_TAPER * lettering.depth, _SHARPEST * lettering.stroke)
    for i, place in label_places(V, sheet, sizes, lettering.stroke / 2 + inset):
        least = float(wall[place.ground].min())
        depth = min(lettering.depth, _MOST * least, least - min_wall)
        carver = _carver(V, sheet[place.ground], place, outlines[i], inset, depth)
        if carver is None or not sound(rest := whole - carver):
            continue
        expected = depth * (outlines[i].area - inset * outlines[i].length / 2)
        made = arrays(rest)
        share = (whole.volume() - rest.volume()) / expected
        if _AS_EXPECTED[0] < share < _AS_EXPECTED[1] and components(made[1])[0] == 1:
            return made, heights[i]
    return None


def _carver(V: Floats, F: Ints, place: LabelPlace, outline: Any, inset: float, depth: float) -> Body | None:
    """Give the body of a text that reaches evenly deep into a sheet, None where a fold is in its way."""
    local = (V - place.origin) @ place.axes.T
    text = groove(outline, inset)
    corners = local[F]
    within = (np.abs(corners[..., :2]).min(axis=1) <= np.array(outline.bounds[2:])).all(axis=1)
    flat_text = arrays(text)[0][:, :2]
    heights = corners[within, :, 2] if within.any() else _sheet_at(local, F, flat_text)[0]
    if np.ptp(heights) > _FLAT:
        text = text.refine_to_length(_FINE)
    points = arrays(text)[0]
    height, slant = _sheet_at(local, F, points[:, :2])
    if slant.min() < _STEEPEST:
        return None
    below = np.where(points[:, 2] < 0, depth / slant, depth)
    points[:, 2] = height + below * points[:, 2]
    return text.warp_batch(lambda _: points @ place.axes + place.origin)


def _sheet_at(local: Floats, F: Ints, points: Floats) -> tuple[Floats, Floats]:
    """Give the height of a sheet above a plane, and how it leans, as a cosine; both (k,)."""
    import igl

    flat = np.column_stack([local[:, :2], np.zeros(len(local))])
    face = igl.point_mesh_squared_distance(np.column_stack([points, np.zeros(len(points))]), flat, F)[1]
    bary = barycentric(local[:, :2], F, face, points)
    height = np.einsum("kj,kj->k", bary, local[F[face], 2])
    return height, unit(area_vectors(local, F))[face, 2]
