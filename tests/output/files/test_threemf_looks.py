"""Textures and colours of a scan are in the 3MF, at the corners where they were."""

import numpy as np
import pytest

from meshjig.output.files import threemf_looks
from meshjig.output.files.threemf import write_3mf
from meshjig.output.piece import Piece
from meshjig.output.texture import Texture
from meshjig.scan.files.attachments import PictureReader
from meshjig.scan.files.three_mf import read_3mf_source
from tests.meshes import sphere
from tests.output.files.test_glb import dressed


@pytest.mark.parametrize("textured", [True, False])
def test_what_corners_show_is_read_back(tmp_path, textured):
    piece = dressed(textured)
    plain = Piece("piece_002", *sphere(300, 20.0), (1.0, 0.5, 0.0))
    write_3mf(tmp_path / "a.3mf", [piece, plain])
    source, notes = read_3mf_source(tmp_path / "a.3mf", PictureReader())
    assert notes == []
    n = len(piece.F)
    np.testing.assert_allclose(source.vertices[source.faces[:n]], piece.V[piece.F], atol=1e-4)
    if not textured:
        np.testing.assert_allclose(source.look.rgb[:n], 255 * piece.texture.rgb, atol=0.6)
        assert (source.look.rgb[n:] == (255, 128, 0)).all()
        return
    height, width = source.look.picture.shape[:2]
    x, y = np.moveaxis(source.look.uv * (1, -1) + (0, 1), -1, 0) * np.array([[[width]], [[height]]])
    shown = source.look.picture[np.clip(y, 0, height - 1).astype(int), np.clip(x, 0, width - 1).astype(int)]
    np.testing.assert_allclose(shown[:n] / 255, piece.texture.rgb, atol=0.01)
    assert np.abs(shown[n:].astype(int) - (255, 128, 0)).max() <= 4  # a swatch of few levels


def test_more_colours_than_a_file_should_name_are_rounded(tmp_path, monkeypatch):
    monkeypatch.setattr(threemf_looks, "_MOST_COLOURS", 800)
    V, F = sphere(300)
    rgb = np.random.default_rng(0).random((len(F), 3, 3))
    write_3mf(tmp_path / "a.3mf", [Piece("a", V, F, (0, 0, 0), texture=Texture(np.ones(len(F), bool), rgb))])
    source, _ = read_3mf_source(tmp_path / "a.3mf", PictureReader())
    assert len(np.unique(source.look.rgb)) <= 32  # levels of a channel
    np.testing.assert_allclose(source.look.rgb / 255, rgb, atol=0.02)
