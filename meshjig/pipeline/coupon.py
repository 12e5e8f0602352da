"""The coupon: pairs of tiles with a knob between them, at several clearances, to find a printer's own."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from meshjig.extras.text import text_outline
from meshjig.mesh.measure import mesh_volume
from meshjig.mesh.types import Floats, Ints
from meshjig.options import Options
from meshjig.output.folder import replace_folder
from meshjig.output.pictures.colours import colours
from meshjig.output.piece import Piece
from meshjig.output.report import Report
from meshjig.runtime.version import meshjig_version
from meshjig.solid.printable import printable
from meshjig.tiling.template import classic

__all__ = ["coupon_clearances", "make_coupon", "save_coupon"]

EDGE = 25.0  # mm, of a tile
BELOW, ABOVE = 2, 4  # clearances tried below and above the process's own
STEP = 0.25  # of that clearance, between two that are tried
SPACE = 5.0  # mm between any two tiles
COLUMNS = 2  # pairs side by side
ENGRAVED = 0.3  # of the thickness
TEXT, PEN = 5.5, 0.9  # mm, height of the text and width of its lines
_KNOB = classic(24)
_ROUND = 16  # segments a quarter of a circle where the border is widened to the gap

HOW_TO = (
    "Print the tiles flat, as they lie, with the settings meant for the puzzle. The number on a tile is "
    "the gap of its pair in mm. Push each pair together from above: the right one goes in by hand, holds "
    "when lifted by one tile, and comes apart without force. Give its number to --clearance."
)


def coupon_clearances(clearance: float) -> list[float]:
    """Give the gaps worth trying around a process's own, whole gaps in mm, in steps of 0.01 or more."""
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
        A male and a female a clearance, named after it, side by side on the plane z = 0. Each is closed,
        and has its clearance engraved on the upper side. A pair put together leaves that gap free all
        along its border.
    """
    gaps = coupon_clearances(options.clearance)
    edge = max(EDGE, (options.min_neck + max(gaps)) / _KNOB.neck_width)
    apart = _KNOB.height * edge + SPACE
    pieces = []
    for k, gap in enumerate(gaps):
        row, column = divmod(k, COLUMNS)
        place = np.array([column * (2 * edge + apart + SPACE), -row * (edge + SPACE), 0.0])
        text = f"{gap:.3f}" if round(gap, 2) != gap else f"{gap:.2f}"
        for name, outline, middle, shift in zip(
            ("male", "female"),
            _pair(edge, gap),
            (edge / 2, edge * (1.5 + _KNOB.height / 2)),
            (0.0, apart),
            strict=True,
        ):
            V, F = _tile(outline, text, np.array([middle, edge / 2]), options.thickness)
            solid = printable(V + place + (shift, 0.0, 0.0), F)
            pieces.append((f"clearance_{text}_{name}", *solid))
    tints = colours(len(gaps), np.zeros((0, 2), np.int64)).tolist()
    return [Piece(name, V, F, tuple(tints[i // 2])) for i, (name, V, F) in enumerate(pieces)]


def save_coupon(directory: str | Path, options: Options) -> Report:
    """Write coupon.3mf, a STL a tile, preview.png and report.json to a folder.

    Parameters
    ----------
    directory : path
        An existing folder is replaced only when meshjig made it.
    options : Options, see `make_coupon`

    Returns
    -------
    dict, the report as written; "how_to" says how the coupon is used

    Raises
    ------
    OutputError
        The folder can't be written, or holds something else.
    """
    from meshjig.output.files.mesh_files import write_stl
    from meshjig.output.files.threemf import write_3mf
    from meshjig.output.report import write_report

    pieces = make_coupon(options)
    size = np.ptp(np.concatenate([piece.V for piece in pieces]), axis=0)
    report = {
        "meshjig": meshjig_version(),
        "kind": "coupon",
        "coupon": coupon_clearances(options.clearance),
        "how_to": HOW_TO,
        "size_mm": size,
        "volume_mm3": sum(mesh_volume(piece.V, piece.F) for piece in pieces),
        "options": {"process": options.process},
        "pieces": [{"id": i + 1, "name": piece.name, "neighbours": []} for i, piece in enumerate(pieces)],
        "ok": True,
    }
    with replace_folder(directory, "coupon") as folder:
        (folder / "pieces").mkdir()
        for piece in pieces:
            write_stl(folder / "pieces" / f"{piece.name}.stl", piece.V, piece.F, piece.name)
        write_3mf(folder / "coupon.3mf", pieces, "meshjig coupon")
        _draw(pieces, folder / "preview.png")
        write_report(folder / "report.json", report)
    return report


def _pair(edge: float, gap: float) -> tuple[Any, Any]:
    """Outline a male tile and the female to its right, put together; shapely.Polygon, mm."""
    import shapely

    border = np.stack([edge * (1 + _KNOB.points[:, 1]), edge * _KNOB.points[:, 0]], 1)
    ends = border[[0, -1]] + ((0, -2 * gap), (0, 2 * gap))
    cut = shapely.LineString(np.concatenate([ends[:1], border, ends[1:]]))
    cut = cut.buffer(gap / 2, quad_segs=_ROUND, cap_style="flat")
    male = shapely.Polygon([(0, 0), *border, (0, edge)])
    female = shapely.Polygon([(2 * edge, edge), *border[::-1], (2 * edge, 0)])
    return male - cut, female - cut


def _tile(outline: Any, text: str, middle: Floats, thickness: float) -> tuple[Floats, Ints]:
    """Extrude an outline from z = 0, with a text engraved around a point of its upper side."""
    from shapely import affinity

    depth = ENGRAVED * thickness
    label = affinity.translate(text_outline(text, TEXT, PEN), *middle)
    groove = _extruded(label, 2 * depth).translate((0, 0, thickness - depth))
    mesh = (_extruded(outline, thickness) - groove).to_mesh64()
    return np.array(mesh.vert_properties, np.float64)[:, :3], np.array(mesh.tri_verts, np.int64)


def _extruded(shape: Any, height: float) -> Any:
    """Give the prism over a polygon as a manifold3d.Manifold."""
    import manifold3d
    import shapely

    parts = shapely.get_parts(shape)
    rings = [np.array(ring.coords)[:-1] for part in parts for ring in (part.exterior, *part.interiors)]
    plane = manifold3d.CrossSection(rings, manifold3d.FillRule.EvenOdd)
    return manifold3d.Manifold.extrude(plane, height)


def _draw(pieces: list[Piece], path: Path) -> None:
    """Draw the tiles as they lie, from above."""
    from PIL import Image

    from meshjig.mesh.mesh import concatenate
    from meshjig.output.pictures.render import render
    from meshjig.output.pictures.scene import scene_of
    from meshjig.output.pictures.view import view_of

    V, F, _, of_face = concatenate(pieces)
    colour = np.array([piece.colour for piece in pieces])[of_face]
    view = view_of(V, np.array([0.0, 0.0, 1.0]), 0.0, 65.0)
    view = replace(view, half=1.05 * view.half)
    Image.fromarray(render(scene_of(V, F, colour, of_face), view, 1200)).save(path)
