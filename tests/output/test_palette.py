"""Colours of faces become places in a picture, each in the middle of its colour."""

import numpy as np

from meshjig.output.palette import by_palette
from meshjig.output.piece import Piece
from meshjig.output.texture import Texture
from tests.meshes import sphere

V, F = sphere(1000)


def piece(rgb):
    return Piece("a", V, F, (0, 0, 0), texture=Texture(np.ones(len(F), bool), rgb))


def colours(seed):
    rgb = np.random.default_rng(seed).integers(0, 256, (len(F), 1, 3)) / 255
    return np.repeat(rgb, 3, axis=1)


def test_each_face_shows_its_colour():
    pieces = by_palette([piece(colours(0)), piece(colours(1))])
    assert pieces[0].texture.picture is pieces[1].texture.picture
    pixels = pieces[0].texture.picture.pixels
    height, width = pixels.shape[:2]
    for k, made in enumerate(pieces):
        x, y = np.moveaxis(made.texture.uv * (1, -1) + (0, 1), -1, 0)
        shown = pixels[(y * height).astype(int), (x * width).astype(int)]
        np.testing.assert_array_equal(shown, np.rint(255 * np.repeat(colours(k)[:, :1], 3, axis=1)))
        assert np.ptp(made.texture.uv, axis=1).max() == 0


def test_faces_that_show_several_colours_stay_as_they_are():
    smooth = colours(0)
    smooth[0, 1] = 0.5
    pieces = [piece(colours(0)), piece(smooth)]
    assert by_palette(pieces) is pieces
    plain = [Piece("a", V, F, (0, 0, 0))]
    assert by_palette(plain) is plain
