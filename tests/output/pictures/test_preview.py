import colorsys

import numpy as np
import pytest
from PIL import Image

from meshjig.errors import OptionError
from meshjig.output.pictures.preview import preview
from meshjig.output.piece import Piece
from tests.meshes import RADIUS, sphere

HUES = [0, 60, 120, 180, 240, 300]


@pytest.fixture(scope="module")
def pieces():
    V, F = sphere(1000)
    angles = np.linspace(0, 2 * np.pi, 6, endpoint=False)
    return [
        Piece(
            f"p{k}",
            V + 2.2 * RADIUS * np.array([np.cos(a), np.sin(a), 0]),
            F,
            colorsys.hsv_to_rgb(k / 6, 0.8, 0.9),
        )
        for k, a in enumerate(angles)
    ]


def areas_by_hue(image):
    """Count pixels of each of six hues, but for pale and dark ones."""
    hsv = np.asarray(Image.fromarray(image).convert("HSV")).astype(int)
    hue = hsv[hsv[:, :, 1] > 120][:, 0] * 360 / 255
    return np.bincount(np.round(hue / 60).astype(int) % 6, minlength=6)


def test_the_sheet_shows_each_piece_in_its_colour_in_four_pictures_on_white(tmp_path, pieces):
    preview(pieces, tmp_path / "preview.png", up="y", size=400)
    sheet = np.asarray(Image.open(tmp_path / "preview.png"))
    assert sheet.shape == (400, 400, 3)
    for quarter in (sheet[:200, :200], sheet[:200, 200:], sheet[200:, :200], sheet[200:, 200:]):
        areas = areas_by_hue(quarter)
        assert areas.min() > 150
        assert areas.max() < 3 * areas.min()
        white = (quarter == 255).all(axis=2)
        assert white.mean() > 0.3
        assert white[:3].all()
        assert white[:, :3].all()


def test_exploded_pieces_are_apart(tmp_path, pieces):
    close = [Piece(p.name, p.V / 1.1 + 0 * p.V, p.F, p.colour) for p in pieces]
    preview(close, tmp_path / "preview.png", up="y", size=600)
    sheet = np.asarray(Image.open(tmp_path / "preview.png"))

    def patches(image):
        from scipy.ndimage import label

        return label((image != 255).any(axis=2))[1]

    assert patches(sheet[300:, :300]) == 6


def test_an_unknown_axis_is_told(tmp_path, pieces):
    with pytest.raises(OptionError, match="axis"):
        preview(pieces, tmp_path / "preview.png", up="north")
