import numpy as np
import pytest

from meshjig.errors import OptionError, OutputError
from meshjig.puzzle import Piece, Puzzle
from tests.meshes import moved, sphere

HUES = [(0.9, 0.1, 0.1), (0.1, 0.1, 0.9)]


def pair():
    return [
        Piece(f"p{k}", *moved(sphere(300, 20.0), [50.0 * k, 0, 0]), hue, k + 1) for k, hue in enumerate(HUES)
    ]


def test_a_plot_shows_all_pieces_in_their_colours_on_white():
    picture = np.asarray(Puzzle(pair(), {}).plot(200)).astype(int)
    assert picture.shape == (200, 200, 3)
    red = picture[..., 0] - picture[..., 2] > 60
    blue = picture[..., 2] - picture[..., 0] > 60
    assert red.sum() == pytest.approx(blue.sum(), rel=0.3)
    assert red.mean() > 0.05
    assert np.nonzero(red)[1].mean() < np.nonzero(blue)[1].mean()  # x is to the right
    assert (picture[[0, -1]] == 255).all()


def test_nothing_to_plot_is_told():
    with pytest.raises(OutputError, match="without pieces"):
        Puzzle([], {}).plot()
    with pytest.raises(OptionError, match="3 pixels"):
        Puzzle(pair(), {}).plot(3)
