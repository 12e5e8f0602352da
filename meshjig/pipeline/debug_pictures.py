"""A picture of each stage, for whoever looks for a fault in it; the documentation shows the same."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from meshjig.errors import OutputError, write_error
from meshjig.layout.layout import Layout
from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.mesh import Mesh, concatenate
from meshjig.mesh.types import Atlas
from meshjig.output.pictures.colours import colours
from meshjig.output.pictures.render import render
from meshjig.output.pictures.scene import scene_of
from meshjig.output.pictures.view import View, guess_up, view_of
from meshjig.output.piece import Piece, exploded
from meshjig.solid import Shell

__all__ = ["STAGES", "StagePictures"]

STAGES = ("1_layout.png", "2_outlines.png", "3_cut.png", "4_shell.png", "5_solids.png")
_SIDES = ((30.0, 18.0), (210.0, 18.0))  # azimuth and elevation, degrees
_SIZE = 700  # pixels, height of a picture; it is twice as wide
_FRAME = 1.05
_WINDOW = 0.15  # half of what is shown in large, roots of the area
_APART = 0.5  # how far apart solids are in the right half
_PALE, _CUTS, _INSIDE = (0.93, 0.92, 0.89), (40, 40, 40), (0.85, 0.62, 0.45)
_THIN, _THICK = np.array([0.80, 0.20, 0.16]), np.array([0.78, 0.86, 0.93])

Picture = NDArray[np.uint8]
Look = tuple[Floats, Ints, Floats, Ints]  # V, F, and for faces colours and numbers that lines part


class StagePictures:
    """Draws what each stage has made into a folder, which holds nothing else; without one it does nothing."""

    def __init__(self, folder: str | os.PathLike[str] | None) -> None:
        self.folder = None if folder is None else Path(folder)
        self.up: Floats | None = None  # guessed where nobody sets it
        if self.folder is None:
            return
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
            held = {path.name for path in self.folder.iterdir()}
        except OSError as error:
            raise write_error(f"the folder {folder}", error, "choose another with --debug-dir") from None
        if not held <= set(STAGES):
            raise OutputError(f"{folder} holds something else than pictures of stages", hint="name a new one")

    def atlas(self, atlas: Atlas) -> None:
        """Draw charts, or cells, on the model and in the plane."""
        if self.folder is not None:
            tint = colours(atlas.n_charts, _touching(atlas.mesh, atlas.chart_of_face))[atlas.chart_of_face]
            on_model = (atlas.mesh.V, atlas.mesh.F, tint, atlas.chart_of_face)
            flat = (_raised(atlas.uv), atlas.F_uv, tint, atlas.chart_of_face)
            self._save(0, self._seen(on_model), self._drawn(flat, _above(flat[0])))

    def layout(self, layout: Layout) -> None:
        """Draw the outlines over the charts and over a few of them in large, and the pieces on the model."""
        if self.folder is None:
            return
        atlas, piece = layout.atlas, layout.piece_of_face
        lines = layout.outlines.points[layout.outlines.segments]
        whole, near = _above(_raised(atlas.uv)), _above(_raised(_middle_part(atlas)))
        flat = (_raised(atlas.uv), atlas.F_uv, np.tile(_PALE, (len(atlas.F_uv), 1)), atlas.chart_of_face)
        self._save(1, *(_over(self._drawn(flat, view), lines, view) for view in (whole, near)))
        cut = Mesh(layout.cut.V, layout.cut.F)
        tint = colours(layout.stitching.n_pieces, _touching(cut, piece))[piece]
        look = (cut.V, cut.F, tint, piece)
        self._save(2, self._seen(look), self._seen(look, 1))

    def shell(self, mesh: Mesh, sheets: Shell) -> None:
        """Draw how thick the wall is, red where it is thin, and the far half of both sheets."""
        if self.folder is None:
            return
        V = sheets.outer
        thick = np.linalg.norm(sheets.D, axis=1)[mesh.F].mean(1)
        share = np.clip(thick / max(float(np.median(thick)), 1e-9), 0, 1)[:, None]
        whole = (V, mesh.F, _THIN + share * (_THICK - _THIN), np.zeros(len(mesh.F), np.int64))
        view = self._view(V, mesh.F)
        depth = V @ view.axes[2]
        F = mesh.F[depth[mesh.F].mean(1) > np.median(depth)]
        side = np.repeat([0, 1], len(F))
        both = np.concatenate([F, F[:, ::-1] + len(V)])
        far = (np.concatenate([V, V + sheets.D]), both, np.array([_THICK, _INSIDE])[side], side)
        self._save(3, self._drawn(whole, view), self._drawn(far, view))

    def pieces(self, pieces: Sequence[Piece]) -> None:
        """Draw the pieces in their places, and apart."""
        if self.folder is not None:
            V, F, of_vertex, of_face = concatenate(pieces)
            tint = np.array([piece.colour for piece in pieces])[of_face]
            looks = [(W, F, tint, of_face) for W in (V, exploded(V, of_vertex, _APART))]
            self._save(4, *map(self._seen, looks))

    def _view(self, V: Floats, F: Ints, side: int = 0) -> View:
        return view_of(V, guess_up(V, F) if self.up is None else self.up, *_SIDES[side])

    def _seen(self, look: Look, side: int = 0) -> Picture:
        return self._drawn(look, self._view(look[0], look[1], side))

    def _drawn(self, look: Look, view: View) -> Picture:
        return render(scene_of(*look), replace(view, half=_FRAME * view.half), _SIZE)

    def _save(self, stage: int, *halves: Picture) -> None:
        from PIL import Image

        if self.folder is not None:
            Image.fromarray(np.hstack(halves)).save(self.folder / STAGES[stage], compress_level=6)


def _touching(mesh: Mesh, label: Ints) -> Ints:
    """List the pairs of labels that share an edge, (k, 2)."""
    pairs = np.stack([label.repeat(3), label[mesh.edges.twin // 3]], 1)
    return np.unique(np.sort(pairs[(pairs[:, 0] != pairs[:, 1]) & (pairs.min(1) >= 0)], axis=1), axis=0)


def _raised(uv: Floats) -> Floats:
    return np.pad(uv, ((0, 0), (0, 1)))


def _above(V: Floats) -> View:
    return view_of(V, np.array([0.0, 1.0, 0.0]), 0.0, 0.0)


def _middle_part(atlas: Atlas) -> Floats:
    """Give two corners of a window on the largest chart, (2, 2), mm."""
    largest = np.bincount(atlas.chart_of_face).argmax()
    middle = np.median(atlas.uv[atlas.F_uv[atlas.chart_of_face == largest].ravel()], axis=0)
    return middle + _WINDOW * np.sqrt(atlas.mesh.areas.sum()) * np.array([[-1.0], [1.0]])


def _over(picture: Picture, lines: Floats, view: View) -> Picture:
    """Draw segments (k, 2, 2) of the plane over a picture of it."""
    from PIL import Image, ImageDraw

    image: Any = Image.fromarray(picture)
    pen = ImageDraw.Draw(image)
    at = ((_raised(lines.reshape(-1, 2)) - view.eye) @ view.axes.T)[:, :2] / view.eye[2]
    pixel = ((at - view.centre) / (_FRAME * view.half) * [1, -1] + 1) * len(picture) / 2
    for line in pixel.reshape(-1, 4).tolist():
        pen.line(line, fill=_CUTS, width=2)
    return np.asarray(image)
