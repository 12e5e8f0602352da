"""The pages of the guide that show, step by step, which pieces go where."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from meshjig.mesh.arrays import Floats
from meshjig.mesh.measure import unit
from meshjig.output.guide.arrows import Arrows, arrow_at, arrow_shape, arrows_on_paper
from meshjig.output.guide.cameras import Camera, cameras, choose_cameras
from meshjig.output.guide.pages import BOTTOM, LEFT, RIGHT, TOP, Document, Page, tag_size, text_width, wrapped
from meshjig.output.guide.place_labels import Label, place_labels
from meshjig.output.guide.proxy import JoinedPieces, PlacedFaces, proxy_model
from meshjig.output.guide.step_picture import Frame, draw_step, silhouette

__all__ = ["steps_pages"]

DrawWhole = Callable[[], NDArray[np.uint8]]  # gives (h, w, 3)

_GRIDS = ((2, 3), (3, 2))  # columns and rows of pictures on a page
_LINE, _NUMBER = 3.4, 15.0  # mm: a line of pieces, and room for the number of a step
_GAP = 6.0
_START = TOP - 6.0
_PIXELS = 5.0  # a mm
_TAG = 7.0  # points
_WORDS = 8.0
_MARGIN = 0.96  # of a picture, filled by what it shows
_BEHIND = 0.2  # cosine between an arrow and the line of sight from which on it comes from behind
_GREY = 0.6  # of such an arrow
_CLOSEST = 1.7  # how much larger first steps are drawn than the whole model


@dataclass(frozen=True)
class _Shot:
    """One picture of a step, and what is written on it."""

    step: int  # counted from 1
    part: str  # "", or a, b, ... where a step has more pictures
    new: list[int]  # pieces counted from 0
    place: str
    rgb: NDArray[np.uint8]
    labels: list[Label]
    along: dict[int, Floats]  # by piece: where from its arrow comes, (2,), pixels
    behind: list[int]  # pieces that go in from behind


@dataclass(frozen=True)
class _Grid:
    columns: int
    rows: int
    most: int  # pieces a step

    @property
    def caption(self) -> float:
        lines = wrapped(" ".join(["0000,"] * self.most), _WORDS, self.width - _NUMBER)
        return 5.2 + _LINE * max(len(lines), 2)

    @property
    def width(self) -> float:
        return (RIGHT - LEFT + _GAP) / self.columns - _GAP

    @property
    def height(self) -> float:
        return (BOTTOM - _START + _GAP) / self.rows - _GAP - self.caption


def steps_pages(
    joined: JoinedPieces,
    steps: Sequence[Sequence[int]],
    whole: DrawWhole,
    arrows: Arrows | None = None,
) -> list[Page]:
    """Draw all steps.

    Parameters
    ----------
    joined : JoinedPieces
    steps : sequence of sequence of int, pieces counted from 1
    whole : callable, gives a picture of the puzzle put together, for where the last page has room
    arrows : Arrows, optional
        How pieces go in.

    Returns
    -------
    list of callables, each draws a page
    """
    model = proxy_model(joined, steps)
    places = cameras(model, below=arrows is not None)
    extent = np.max([place.extent for place in places], axis=0)
    most = max(map(len, steps), default=0)
    grids = [_Grid(*grid, most) for grid in _GRIDS]
    scales = [min(grid.width / extent[0], grid.height / extent[1]) for grid in grids]
    grid, scale = max(zip(grids, scales, strict=True), key=lambda both: both[1])
    shots: list[_Shot] = []
    last = 0
    for number, step in enumerate(steps):
        if not step:
            continue
        placed, new = model.until(number), [piece - 1 for piece in step]
        points = model.V[: model.first_vertex[number + 1]]
        chosen = choose_cameras(model, placed, new, places, last, arrows)
        for part, (camera, mine) in enumerate(chosen):
            place = places[camera]
            shown = [points] if arrows is None else [points, arrows.start[mine]]
            frame = _frame(grid, _MARGIN * scale, place, np.concatenate(shown))
            ghost = silhouette(PlacedFaces(model.scene, len(model.scene.F)), place.view, frame)
            picture = draw_step(placed, place.view, frame, mine if part else new, ghost)
            sizes = [_tag_pixels(piece) for piece in mine]
            along: dict[int, Floats] = {}
            behind: list[int] = []
            if arrows is not None:
                along = dict(zip(mine, arrows_on_paper(arrows, mine, place.view, frame.scale), strict=True))
                behind = [piece for piece in mine if _goes_away(arrows, piece, place)]
            labels = place_labels(picture.piece, mine, sizes, list(along.values()) if along else None)
            name = "abcdefgh"[part % 8] if len(chosen) > 1 else ""
            shots.append(_Shot(number + 1, name, mine, place.words, picture.rgb, labels, along, behind))
        last = chosen[0][0]
    a_page = grid.columns * grid.rows
    pages = [shots[k : k + a_page] for k in range(0, len(shots), a_page)]
    return [partial(_draw, grid, page, whole if page is pages[-1] else None) for page in pages]


def _frame(grid: _Grid, scale: float, place: Camera, points: Floats) -> Frame:
    """Frame what is placed, and its arrows: not much larger than at a scale (mm a unit)."""
    plane = place.view.on_plane(points)
    low, high = plane.min(axis=0), plane.max(axis=0)
    least = np.minimum(place.view.centre - place.extent / 2, low)
    most = np.maximum(place.view.centre + place.extent / 2, high)
    size = np.array([grid.width, grid.height])
    fitting = _MARGIN * float((size / np.maximum(high - low, 1e-9)).min())
    scale = min(fitting, _CLOSEST * scale)
    room = np.maximum((most - least) / (2 * _MARGIN) - size / (2 * scale), 0)  # to stay within the model
    middle = np.clip((low + high) / 2, (least + most) / 2 - room, (least + most) / 2 + room)
    pixels = np.round(size * _PIXELS).astype(int).tolist()
    return Frame(pixels[0], pixels[1], scale * _PIXELS, (float(middle[0]), float(middle[1])))


def _goes_away(arrows: Arrows, piece: int, place: Camera) -> bool:
    return bool(unit(arrows.seat[piece] - place.view.eye) @ arrows.way[piece] > _BEHIND)


def _tag_pixels(piece: int) -> tuple[float, float]:
    width, height = tag_size(str(piece + 1), _TAG)
    return (width + 0.4) * _PIXELS, (height + 0.4) * _PIXELS


def _draw(grid: _Grid, shots: Sequence[_Shot], whole: DrawWhole | None, document: Document) -> None:
    for k, shot in enumerate(shots):
        row, column = divmod(k, grid.columns)
        x = LEFT + column * (grid.width + _GAP)
        y = _START + row * (grid.height + grid.caption + _GAP)
        _draw_shot(shot, x, y, grid, document)
    used = -(-len(shots) // grid.columns)
    if whole is not None and used < grid.rows:
        y = _START + used * (grid.height + grid.caption + _GAP)
        document.line(LEFT, y, RIGHT, y, width=0.3, grey=0.3)
        document.text(LEFT, y + 7, "Done", 17, strong=True)
        document.fitted(LEFT, y + grid.caption, RIGHT - LEFT, BOTTOM - y - grid.caption, whole())


def _draw_shot(shot: _Shot, x: float, y: float, grid: _Grid, document: Document) -> None:
    document.line(x, y, x + grid.width, y, width=0.3, grey=0.3)
    number = f"{shot.step}{shot.part}"
    document.text(x, y + 7, number, 17, strong=True)
    left = x + max(text_width(number, 17, strong=True) + 3, 11)
    lines = wrapped(", ".join(str(piece + 1) for piece in shot.new), _WORDS, x + grid.width - left)
    for k, words in enumerate(lines):
        document.text(left, y + 4 + _LINE * k, words, _WORDS)
    document.text(left, y + 4 + _LINE * len(lines), shot.place, 6.5, grey=0.4)
    top = y + grid.caption
    document.picture(x, top, grid.width, grid.height, shot.rgb)
    for label in shot.labels:
        if label.piece in shot.along:
            _draw_arrow(shot, label, x, top, document)
    for label in shot.labels:
        if label.tip is not None:
            end = x + label.tip[0] / _PIXELS, top + label.tip[1] / _PIXELS
            document.line(x + label.at[0] / _PIXELS, top + label.at[1] / _PIXELS, *end, width=0.25)
            document.dot(*end)
    for label in shot.labels:
        number = str(label.piece + 1)
        document.tag(x + label.at[0] / _PIXELS, top + label.at[1] / _PIXELS, number, _TAG)


def _draw_arrow(shot: _Shot, label: Label, x: float, y: float, document: Document) -> None:
    height, width = shot.rgb.shape[:2]
    found = arrow_at(label, _tag_pixels(label.piece), shot.along[label.piece], (width, height))
    if found is not None:
        start, tip = (np.array([x, y]) + at / _PIXELS for at in found)
        document.shape(
            arrow_shape(start.tolist(), tip.tolist()),
            width=0.2,
            grey=_GREY if label.piece in shot.behind else 1.0,
        )
