import colorsys

import numpy as np
import pytest
from PIL import Image

from meshjig.errors import OptionError, OutputError
from meshjig.output.pictures.preview import write_preview, write_turntable
from meshjig.puzzle import Piece, Puzzle
from tests.meshes import RADIUS, moved, sphere

HUES = [0, 60, 120, 180, 240, 300]

UP = np.array([0.0, 1, 0])
RED, BLUE = (0.9, 0.15, 0.1), (0.1, 0.2, 0.9)
PAIR = [
    Piece("piece_001", *moved(sphere(300, 20.0), [0, 0, 60]), RED),
    Piece("piece_002", *moved(sphere(300, 20.0), [0, 0, -60]), BLUE),
]

RED_AND_BLUE = [(0.9, 0.1, 0.1), (0.1, 0.1, 0.9)]


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
    write_preview(tmp_path / "preview.png", pieces, up=UP, size=400)
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
    write_preview(tmp_path / "preview.png", close, up=UP, size=600)
    sheet = np.asarray(Image.open(tmp_path / "preview.png"))

    def patches(image):
        from scipy.ndimage import label

        return label((image != 255).any(axis=2))[1]

    assert patches(sheet[300:, :300]) == 6


def test_pieces_part_along_their_ways_where_these_are_known(tmp_path, pieces):
    up_and_down = np.outer((-1.0) ** np.arange(len(pieces)), UP)
    write_preview(tmp_path / "preview.png", pieces, up=UP, size=400, ways=up_and_down)
    shown = (np.asarray(Image.open(tmp_path / "preview.png")) != 255).any(axis=2)
    whole, apart = (
        np.ptp(np.flatnonzero(half.any(axis=1))) / np.ptp(np.flatnonzero(half.any(axis=0)))
        for half in (shown[:200, :200], shown[200:, :200])
    )
    assert apart > 1.25 * whole  # taller, and no wider


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


def pair():
    return [
        Piece(f"p{k}", *moved(sphere(300, 20.0), [50.0 * k, 0, 0]), hue, k + 1)
        for k, hue in enumerate(RED_AND_BLUE)
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
