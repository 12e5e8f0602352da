import numpy as np
import pytest
from PIL import Image

from meshjig.errors import OptionError, OutputError
from meshjig.output.pictures.turntable import write_turntable
from meshjig.output.piece import Piece
from tests.meshes import moved, sphere

RED, BLUE = (0.9, 0.15, 0.1), (0.1, 0.2, 0.9)
PAIR = [
    Piece("piece_001", *moved(sphere(300, 20.0), [0, 0, 60]), RED),
    Piece("piece_002", *moved(sphere(300, 20.0), [0, 0, -60]), BLUE),
]


def frames(path):
    with Image.open(path) as picture:
        for k in range(picture.n_frames):
            picture.seek(k)
            yield np.asarray(picture.convert("RGB")).astype(int)


def side_of(frame, strong, weak):
    """Tell how far right of the middle a colour is, -1 to 1."""
    columns = np.nonzero(frame[..., strong] - frame[..., weak] > 60)[1]
    return columns.mean() / frame.shape[1] * 2 - 1


def test_two_pieces_go_once_around_each_other(tmp_path):
    write_turntable(tmp_path / "turn.gif", PAIR, frames=8, size=120)
    red = [side_of(frame, 0, 2) for frame in frames(tmp_path / "turn.gif")]
    blue = [side_of(frame, 2, 0) for frame in frames(tmp_path / "turn.gif")]
    assert len(red) == 8
    turn = np.radians(30 + 45 * np.arange(8))  # the red one starts in front; the eye goes to its right
    np.testing.assert_allclose(red, -max(np.abs(red)) * np.sin(turn), atol=0.15)
    np.testing.assert_allclose(blue, -np.array(red), atol=0.15)
    assert max(red) > 0.5


def test_nothing_leaves_the_frame_and_the_ground_is_pale_and_still(tmp_path):
    write_turntable(tmp_path / "turn.gif", PAIR, frames=6, size=100)
    for frame in frames(tmp_path / "turn.gif"):
        rim = np.concatenate([frame[0], frame[-1], frame[:, 0], frame[:, -1]])
        assert rim.min() > 245


def test_it_runs_forever_in_the_size_asked(tmp_path):
    write_turntable(tmp_path / "turn.gif", PAIR, frames=4, size=64)
    with Image.open(tmp_path / "turn.gif") as picture:
        assert picture.size == (64, 64)
        assert picture.info["loop"] == 0
        assert picture.info["duration"] > 0


@pytest.mark.parametrize(("number", "size"), [(1, 100), (8, 4)])
def test_what_cannot_turn_is_told(tmp_path, number, size):
    with pytest.raises(OptionError, match="turntable"):
        write_turntable(tmp_path / "turn.gif", PAIR, frames=number, size=size)


def test_no_pieces_are_told(tmp_path):
    with pytest.raises(OutputError, match="pieces"):
        write_turntable(tmp_path / "turn.gif", [])
