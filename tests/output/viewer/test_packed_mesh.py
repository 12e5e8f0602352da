"""What the viewer draws is the puzzle: its geometry and its picture."""

import numpy as np
import pytest
from PIL import Image

from meshjig.mesh.measure import unit
from meshjig.output.piece import Piece
from meshjig.output.scan_picture import Picture
from meshjig.output.texture import Texture
from meshjig.output.viewer.packed_mesh import pack
from meshjig.output.viewer.page import write_viewer
from tests.meshes import creased_box, moved, sphere, torus
from tests.output.viewer.viewing import HUES, hue_of, needs_browser, opened, shown


def dressed(textured):
    """Give a sphere that shows red above and blue below outside, and a plain one beside it."""
    V, F = moved(sphere(2000), [0, 0, 0])
    height = V[F][..., 1] / 100 + 0.5
    outer = np.ones(len(F), bool)
    image = Image.new("RGB", (64, 64), (20, 30, 230))
    image.paste((230, 30, 20), (0, 0, 64, 32))
    above = (height > 0.5)[..., None]
    rgb = np.where(above, [0.9, 0.12, 0.08], [0.08, 0.12, 0.9])
    uv = np.stack([np.full(height.shape, 0.3), height], 2)
    texture = Texture(outer, rgb, uv, Picture(np.asarray(image))) if textured else Texture(outer, rgb)
    return [
        Piece("piece_001", V, F, (0.1, 0.8, 0.1), texture=texture),
        Piece("piece_002", *moved(sphere(500, 20.0), [60, 0, -60]), (0.1, 0.8, 0.1)),
    ]


@needs_browser
@pytest.mark.parametrize("textured", [True, False])
def test_the_picture_of_a_scan_lies_the_right_way_up(desktop, tmp_path, textured):
    write_viewer(tmp_path / "viewer.html", dressed(textured), {})
    page = opened(desktop, tmp_path / "viewer.html")
    assert page.value("document.querySelector('[name=colour]:checked').value") == "picture"
    hue = hue_of(shown(page)[0])
    red, blue = np.argwhere(hue == 1), np.argwhere(hue == 5)
    assert min(len(red), len(blue)) > 4000
    assert red[:, 0].mean() + 60 < blue[:, 0].mean()
    page.press("c")
    page.press("c")
    page.press("c")
    assert page.value("document.querySelector('[name=colour]:checked').value") == "piece"
    hue = hue_of(shown(page)[0])
    assert (hue == 3).sum() > 8000
    assert not np.isin(hue, (1, 5)).any()
    assert page.errors == []


def unpacked(page):
    """Read the geometry as the page's own script does: position, normal, piece of vertex, index."""
    page.value(
        """(async () => { const facts = JSON.parse($('data').textContent).mesh;
        window.unpacked = await unpackMesh($('mesh').textContent, facts); })()"""
    )
    position, normal, piece, index = (
        np.array(page.value(f"[...window.unpacked.{name}]"))
        for name in ("position", "normal", "piece", "index")
    )
    return position.reshape(-1, 3), normal.reshape(-1, 4)[:, :3], piece, index.reshape(-1, 3)


@needs_browser
def test_the_true_geometry_is_in_the_page_with_smooth_faces_smooth_and_creases_sharp(desktop, tmp_path):
    shapes = [sphere(2000), moved(creased_box(300), [130, 0, 0]), moved(torus(500), [0, 160, 0])]
    pieces = [Piece(f"piece_{k + 1:03d}", *shape, HUES[k]) for k, shape in enumerate(shapes)]
    write_viewer(tmp_path / "viewer.html", pieces, {})
    position, normal, piece, index = unpacked(opened(desktop, tmp_path / "viewer.html"))
    V = np.concatenate([piece.V for piece in pieces])
    corners = np.concatenate([piece.V[piece.F] for piece in pieces])
    step = np.ptp(V, axis=0).max() / 65535
    middle = (V.min(0) + V.max(0)) / 2
    np.testing.assert_allclose(position[index] + middle, corners, atol=0.6 * step)
    owner = np.repeat(np.arange(3), [len(piece.F) for piece in pieces])
    assert (piece_of := piece[index]).tolist() == np.repeat(owner[:, None], 3, 1).tolist(), piece_of
    normal = unit(normal.astype(float))
    ball = piece == 0
    radial = unit(position[ball] + middle)
    assert np.degrees(np.arccos(np.einsum("ij,ij->i", normal[ball], radial).clip(-1, 1))).max() < 5
    assert ball.sum() == len(pieces[0].V)  # nothing is doubled where nothing is sharp
    flat = np.sort(np.abs(normal[piece == 1]), axis=1)
    assert flat[:, 2].min() > 0.99  # a corner of a box has three normals, each along an axis
    assert flat[:, 1].max() < 0.05


@needs_browser
def test_what_slow_machines_draw_while_it_moves_is_much_less_and_close_to_the_truth(desktop, tmp_path):
    shapes = [sphere(20_000), moved(creased_box(12_000), [130, 0, 0])]
    pieces = [Piece(f"piece_{k + 1:03d}", *shape, HUES[k]) for k, shape in enumerate(shapes)]
    write_viewer(tmp_path / "viewer.html", pieces, {})
    page = opened(desktop, tmp_path / "viewer.html")
    position, _, piece, index = unpacked(page)
    rough = np.array(page.value("[...roughCorners(window.unpacked, 5)]")).reshape(-1, 3)
    assert 200 < len(rough) < 0.25 * len(index)
    assert (piece[rough] == piece[rough][:, :1]).all()
    ball = rough[piece[rough[:, 0]] == 0]
    middle = position[piece == 0].mean(0)
    assert np.linalg.norm(position[ball].mean(1) - middle, axis=1).min() > 50 - 5


def test_faces_take_few_bytes():
    """A puzzle of 300 pieces has some 800,000 faces, and its page is to stay below 25 MB."""
    pieces = [Piece("piece_001", *sphere(50_000), HUES[0])]
    assert len(pack(pieces).data) * 4 / 3 / len(pieces[0].F) < 20
