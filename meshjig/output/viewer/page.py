"""The viewer: one HTML file that shows a puzzle in 3D, with everything it needs inside."""

from __future__ import annotations

import base64
import html
import io
import json
import re
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np

from meshjig.errors import InputError, OutputError
from meshjig.mesh.arrays import Floats
from meshjig.mesh.measure import face_areas
from meshjig.mesh.mesh import concatenate
from meshjig.output.order import assembly_of, ways_out
from meshjig.output.pictures.view import up_of, view_of
from meshjig.output.piece import Piece, explosion
from meshjig.output.report import report_text, title_of
from meshjig.output.viewer.packed_mesh import pack

__all__ = ["open_viewer", "viewer_html", "write_viewer"]

FILE = "viewer.html"
_SCRIPTS = ("mesh.js", "shaders.js", "stage.js", "colours.js", "labels.js", "panel.js", "main.js")
_FRONT = (30.0, 18.0)  # azimuth and elevation of the first look, degrees
_MOST_PIXELS = 2048  # a side of the picture
_HEIGHT = 640  # of the frame in a notebook, pixels


def write_viewer(
    path: Path,
    pieces: Sequence[Piece],
    report: Mapping[str, Any],
    *,
    plates: Mapping[str, int] | None = None,
    core: Sequence[Piece] = (),
) -> None:
    """Write a page that shows a puzzle and works without a network.

    Parameters
    ----------
    path : Path
    pieces : sequence of Piece, at least one
    report : mapping
        ``input`` gives the title, ``pieces`` areas and neighbours, ``assembly`` the order and the motions,
        ``up`` which way it stands; what is missing is measured, left out, or made.
    plates : mapping, optional
        The plate that holds each piece, by the piece's name.
    core : sequence of Piece
        The parts of the body that the puzzle is built on.

    Raises
    ------
    OutputError
        There are no pieces.
    """
    path.write_text(_page(pieces, report, plates or {}, core), encoding="utf-8")


def viewer_html(pieces: Sequence[Piece], report: Mapping[str, Any], core: Sequence[Piece] = ()) -> str:
    """Give the viewer as a frame for notebooks, an HTML element that holds the whole page.

    Parameters
    ----------
    pieces, report, core
        As for ``write_viewer``.

    Returns
    -------
    str
    """
    page = html.escape(_page(pieces, report, {}, core))
    style = f"width:100%;height:{_HEIGHT}px;border:1px solid #8884;border-radius:8px"
    return f'<iframe title="Puzzle" style="{style}" srcdoc="{page}"></iframe>'


def open_viewer(directory: str | Path) -> Path:
    """Open the viewer of a puzzle's folder in the default browser.

    Parameters
    ----------
    directory : path, a folder that meshjig made

    Returns
    -------
    pathlib.Path, the page

    Raises
    ------
    InputError
        The folder holds no viewer.
    OutputError
        No browser was found.
    """
    import webbrowser

    page = (Path(directory) / FILE).resolve()
    if not page.is_file():
        raise InputError(f"{directory} holds no {FILE}", hint="give a folder that meshjig made")
    if not webbrowser.open(page.as_uri()):
        raise OutputError("no browser was found to show the puzzle", hint=f"open {page} yourself")
    return page


def _page(
    pieces: Sequence[Piece], report: Mapping[str, Any], plates: Mapping[str, int], core: Sequence[Piece]
) -> str:
    if not pieces:
        raise OutputError("a puzzle without pieces can't be shown", hint="make one first")
    packed = pack([*pieces, *core])
    data = _data(pieces, report, plates) | {"core": len(core), "mesh": asdict(packed.facts)}
    parts = {
        "title": html.escape(title_of(report)),
        "style": _file("viewer.css"),
        "data": _json(data),
        "mesh": base64.b64encode(packed.data).decode("ascii"),
        "three": _file("three.min.js"),
        "script": "".join(map(_file, _SCRIPTS)),
    }
    return re.sub(r"\{\{(\w+)\}\}", lambda found: parts[found[1]], _file("viewer.html"))


def _data(pieces: Sequence[Piece], report: Mapping[str, Any], plates: Mapping[str, int]) -> dict[str, object]:
    V, F, piece_of_vertex, _ = concatenate(pieces)
    up = up_of(report, V, F)
    view = view_of(V, up, *_FRONT)
    off = V - (V.min(axis=0) + V.max(axis=0)) / 2
    assembly, ways = assembly_of(pieces, report), ways_out(report, len(pieces))
    moves = explosion(V, piece_of_vertex, ways)
    wide, high = _extent(off, up)
    grown = (
        (wide, high) if ways is None else np.subtract(_extent(off + moves[piece_of_vertex], up), (wide, high))
    )
    listed = report.get("pieces", ())
    told = listed if len(listed) == len(pieces) else [{}] * len(pieces)
    return {
        "up": up,
        "eye": -view.axes[2],
        "radius": float(np.linalg.norm(np.ptp(V, axis=0))) / 2,
        "wide": wide,
        "high": high,
        "grown": [float(x) for x in grown],
        "steps": assembly.steps,
        "verified": assembly.verified,
        "picture": _picture(pieces),
        "pieces": [
            {
                "id": number,
                "colour": _hex(piece.colour),
                "way": move,
                "axis": None if axis is None or not axis.any() else axis,
                "area": entry.get("area_mm2", face_areas(piece.V, piece.F).sum() / 2),
                "neighbours": entry.get("neighbours", []),
                "plate": plates.get(piece.name),
            }
            for number, (piece, move, axis, entry) in enumerate(
                zip(pieces, moves, [None] * len(pieces) if ways is None else ways, told, strict=True), 1
            )
        ],
    }


def _extent(off: Floats, up: Floats) -> tuple[float, float]:
    """How far points (n, 3) are from the upward axis and from the middle's height at most, mm."""
    height = off @ up
    return float(np.linalg.norm(off - height[:, None] * up, axis=1).max()), float(np.abs(height).max())


def _picture(pieces: Sequence[Piece]) -> str | None:
    """The scan's image as a data address, no larger than screens can use."""
    from PIL import Image

    picture = next((p.texture.picture for p in pieces if p.texture is not None and p.texture.picture), None)
    if picture is None:
        return None
    small = Image.fromarray(picture.pixels)
    small.thumbnail((_MOST_PIXELS, _MOST_PIXELS))
    buffer = io.BytesIO()
    small.save(buffer, "JPEG", quality=88)
    return "data:image/jpeg;base64," + base64.b64encode(buffer.getvalue()).decode("ascii")


def _hex(colour: tuple[float, float, float]) -> str:
    return "#" + "".join(f"{round(255 * x):02x}" for x in np.clip(colour, 0, 1))


def _json(data: Mapping[str, object]) -> str:
    """Give JSON on one line that can't end the script element that it stands in."""
    compact = json.dumps(json.loads(report_text(data)), separators=(",", ":"))
    return compact.replace("<", "\\u003c")


def _file(name: str) -> str:
    return (files("meshjig.output.viewer") / name).read_text(encoding="utf-8")
