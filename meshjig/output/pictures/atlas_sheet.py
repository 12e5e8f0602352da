"""An atlas as pictures: charts in colour on the model and in the plane, stretch as a heat map."""

import base64
import io
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.boundary_loops import closed_loops
from meshjig.mesh.halfedges import border_halfedges, edges, next_halfedge
from meshjig.mesh.measure import singular_values
from meshjig.mesh.types import Atlas
from meshjig.output.pictures.colours import colours
from meshjig.output.pictures.render import render
from meshjig.output.pictures.scene import draw_lines, scene_of
from meshjig.output.pictures.view import View, guess_up, view_of

__all__ = ["MOST", "cuts", "draw_atlas", "heat", "stretch"]


_SIDES = ((30.0, 18.0), (210.0, 18.0))  # azimuth and elevation, degrees
_FRAME = 1.05
_STRIP = 0.08  # of the lower pictures' height, free for the legend

MOST = 1.5  # the darkest colour; tiles this much longer, or shorter, look wrong at a glance

_STOPS = np.array([1.0, 1.1, 1.25, MOST])
_COLOURS = np.array([(0.93, 0.95, 0.97), (0.98, 0.87, 0.55), (0.91, 0.45, 0.20), (0.55, 0.05, 0.15)])


def draw_atlas(atlas: Atlas, folder: Path, size: int = 1600) -> None:
    """Write atlas.png and atlas.svg.

    The PNG is a square sheet of four: above, the model from two sides with its charts in colour; below,
    the plane with the same colours, and with the stretch. The SVG has the plane alone, in mm: the charts
    as paths, and beside them the stretch as a picture within their outlines.

    Parameters
    ----------
    atlas : Atlas
    folder : Path, which exists
    size : int, pixels along each side of the sheet
    """
    from PIL import Image

    of_chart = colours(atlas.n_charts, _touching(atlas))
    of_face = of_chart[atlas.chart_of_face]
    worst = heat(stretch(atlas))
    half = size // 2
    flat = _flat_view(atlas)
    pictures = [
        *_seen(atlas, of_face, half),
        _plane(atlas, of_face, flat, half),
        _plane(atlas, worst, flat, half),
    ]
    sheet = np.vstack([np.hstack(pictures[:2]), np.hstack(pictures[2:])])
    image = Image.fromarray(sheet)
    _legend(image, half)
    image.save(folder / "atlas.png", compress_level=6)
    _write_svg(folder / "atlas.svg", atlas, of_chart, _plane(atlas, worst, flat, size), flat)


def _touching(atlas: Atlas) -> Ints:
    """List the pairs of charts that share a seam, (k, 2)."""
    twin = edges(atlas.mesh.F).twin
    pairs = np.stack([atlas.chart_of_face.repeat(3), atlas.chart_of_face[twin // 3]], 1)
    return np.unique(np.sort(pairs[pairs[:, 0] != pairs[:, 1]], axis=1), axis=0)


def _seen(atlas: Atlas, colour: Floats, size: int) -> list[NDArray[np.uint8]]:
    """Draw the model from two sides, its cuts as lines: a chart that meets itself shows where."""
    from PIL import Image

    V, F = atlas.mesh.V, atlas.mesh.F
    scene = scene_of(V, F, colour, atlas.chart_of_face)
    up = guess_up(V, F)
    views = [view_of(V, up, *side) for side in _SIDES]
    widest = _FRAME * max(view.half for view in views)
    pictures = []
    for v in views:
        view = View(v.eye, v.axes, v.centre, widest)
        image = Image.fromarray(render(scene, view, size))
        draw_lines(image, scene, view, V[cuts(atlas)], size)
        pictures.append(np.asarray(image))
    return pictures


def _flat_view(atlas: Atlas) -> View:
    """Look straight down on the plane of the charts."""
    view = view_of(_raised(atlas.uv), np.array([0.0, 1.0, 0.0]), 0.0, 0.0)
    half = _FRAME * view.half
    return View(view.eye, view.axes, view.centre - [0, _STRIP * half], (1 + _STRIP) * half)


def _plane(atlas: Atlas, colour: Floats, view: View, size: int) -> NDArray[np.uint8]:
    return render(scene_of(_raised(atlas.uv), atlas.F_uv, colour, atlas.chart_of_face), view, size)


def _raised(uv: Floats) -> Floats:
    return np.column_stack([uv, np.zeros(len(uv))])


def _legend(image: Any, half: int) -> None:
    """Say what the colours of the heat map mean, in its lower right corner."""
    from PIL import ImageDraw

    pen = ImageDraw.Draw(image)
    marks = (1.0, 1.1, 1.25, MOST)
    left, top, width, height = 2 * half - 330, 2 * half - 46, 300, 14
    ramp = heat(np.linspace(1, MOST, width))
    for x, colour in enumerate((255 * ramp).astype(int).tolist()):
        pen.line([(left + x, top), (left + x, top + height)], fill=tuple(colour))
    for mark in marks:
        at = left + (mark - 1) / (MOST - 1) * width
        pen.text((at, top + height + 2), f"{mark:g}", fill=(60, 60, 60), anchor="ma")
    pen.text((left, top - 4), "stretch", fill=(60, 60, 60), anchor="ls")


def _write_svg(path: Path, atlas: Atlas, of_chart: Floats, picture: NDArray[np.uint8], view: View) -> None:
    from PIL import Image

    buffer = io.BytesIO()
    Image.fromarray(picture).save(buffer, "PNG")
    distance = float(view.eye[2])
    half = view.half * distance
    left, top = view.eye[:2] + view.centre * distance + np.array([-half, half])
    low, high = atlas.uv.min(0) - 5, atlas.uv.max(0) + 5
    width, height = (high - low).tolist()
    paths = [
        f'<path d="{d}" fill="{_hex(colour)}" stroke="#333" stroke-width="0.3" fill-rule="evenodd"/>'
        for d, colour in zip(_outlines(atlas), of_chart, strict=True)
    ]
    image = (
        f'<image x="{left:.3f}" y="{-top:.3f}" width="{2 * half:.3f}" height="{2 * half:.3f}" '
        f'href="data:image/png;base64,{base64.b64encode(buffer.getvalue()).decode()}"/>'
    )
    path.write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{2 * width:.3f}mm" height="{height:.3f}mm" '
        f'viewBox="{low[0]:.3f} {-high[1]:.3f} {2 * width:.3f} {height:.3f}">\n'
        f"<title>charts, and their stretch from 1 (pale) to {MOST:g} (dark)</title>\n"
        f'<g id="charts">\n{chr(10).join(paths)}\n</g>\n'
        f'<svg x="{low[0] + width:.3f}" y="{-high[1]:.3f}" width="{width:.3f}" height="{height:.3f}" '
        f'viewBox="{low[0]:.3f} {-high[1]:.3f} {width:.3f} {height:.3f}"><g id="stretch">{image}</g></svg>\n'
        "</svg>\n",
        encoding="utf-8",
    )


def _hex(colour: Floats) -> str:
    return "#" + bytes(np.rint(255 * colour).astype(np.uint8)).hex()


def _outlines(atlas: Atlas) -> list[str]:
    """The border of every chart as SVG path data; the y of SVG runs downward."""
    corner, h = atlas.F_uv.ravel(), border_halfedges(atlas.F_uv)[::-1]
    data = [""] * atlas.n_charts
    for loop in closed_loops(corner[h], corner[next_halfedge(h)]):
        points = atlas.uv[corner[h[loop]]] * (1, -1)
        path = "M" + "L".join(f"{x:.3f} {y:.3f}" for x, y in points.tolist()) + "Z"
        data[atlas.chart_of_face[h[loop[0]] // 3]] += path
    return data


def stretch(atlas: Atlas) -> Floats:
    """Give how much longer or shorter a length may become in each face, (m,) float64, at least 1."""
    s = singular_values(atlas.mesh.V, atlas.mesh.F, atlas.uv, atlas.F_uv)
    return np.maximum(np.maximum(s[:, 0], 1 / np.maximum(s[:, 1], 1e-9)), 1.0)


def heat(value: Floats) -> Floats:
    """Give the colours (m, 3), sRGB, 0 to 1, of stretches (m,)."""
    return np.stack([np.interp(value, _STOPS, _COLOURS[:, k]) for k in range(3)], 1)


def cuts(atlas: Atlas) -> Ints:
    """List the edges (k, 2), vertices of the mesh, over which an atlas is cut open; borders are none."""
    F, G = atlas.mesh.F.ravel(), atlas.F_uv.ravel()
    twin = edges(atlas.mesh.F).twin
    h = np.flatnonzero(twin > np.arange(len(twin)))
    after = next_halfedge(h)
    apart = (G[h] != G[next_halfedge(twin[h])]) | (G[after] != G[twin[h]])
    return np.stack([F[h[apart]], F[after[apart]]], 1)
