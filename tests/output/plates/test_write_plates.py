import re

import numpy as np
import pytest
import shapely

from meshjig.check import is_closed_as_stl
from meshjig.errors import OptionError
from meshjig.mesh.measure import mesh_volume
from meshjig.output.files.read_pieces import read_pieces
from meshjig.output.piece import Piece
from meshjig.output.plates.lay_out import lay_out
from meshjig.output.plates.printers import Plate
from meshjig.output.plates.write_plates import number_of, write_plates
from meshjig.output.texture import Texture
from tests.output.plates.tiles import bent, turned

PLATE, GAP = Plate(90, 80, 50), 4.0
UP = np.array([0.0, 0.0, 1.0])


def puzzle(n=14):
    rng = np.random.default_rng(1)
    pieces = []
    for i in range(n):
        side = rng.uniform(12, 34, 2)
        (V, F), R = turned(bent(*side, *rng.uniform(-0.03, 0.03, 2), n=9), i)
        pieces.append(Piece(f"piece_{i + 1:03d}", V, F, (0.5, 0.6, i / n), outer_normal=R @ UP))
    return pieces


PIECES = puzzle()


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("puzzle")
    facts = write_plates(folder, PIECES, PLATE, gap=GAP)
    return folder, facts


def plates(folder):
    return [read_pieces(path) for path in sorted((folder / "plates").iterdir())]


def test_every_piece_is_on_the_plate_that_the_facts_name(folder):
    folder, facts = folder
    names = [[name for name, _, _ in plate] for plate in plates(folder)]
    assert [fact.name for fact in facts] == [piece.name for piece in PIECES]
    for fact in facts:
        assert fact.name in names[fact.plate - 1]
    assert sum(len(plate) for plate in names) == len(PIECES)


def test_pieces_keep_their_shape_and_stay_closed(folder):
    original = {piece.name: piece for piece in PIECES}
    for plate in plates(folder[0]):
        for name, V, F in plate:
            assert is_closed_as_stl(V, F)
            assert mesh_volume(V, F) == pytest.approx(
                mesh_volume(original[name].V, original[name].F), rel=1e-4
            )
            edge = np.linalg.norm(V[F[:, 0]] - V[F[:, 1]], axis=1)
            before = original[name].V[original[name].F]
            np.testing.assert_allclose(
                np.sort(edge)[-5:],
                np.sort(np.linalg.norm(before[:, 0] - before[:, 1], axis=1))[-5:],
                atol=1e-4,
            )


def test_pieces_rest_on_the_plate_within_it_and_apart(folder):
    for plate in plates(folder[0]):
        shadows = []
        for _, V, F in plate:
            assert V[:, 2].min() == pytest.approx(0, abs=1e-5)
            assert V[:, 2].max() <= PLATE.height
            assert (V[:, :2].min(axis=0) >= GAP - 1e-4).all()
            assert (V[:, :2].max(axis=0) <= np.array(PLATE[:2]) - GAP + 1e-4).all()
            triangles = shapely.polygons(V[F][..., :2])
            shadows.append(shapely.union_all(triangles[shapely.area(triangles) > 1e-9]))
        for i, shadow in enumerate(shadows):
            assert all(shadow.distance(other) >= GAP - 1e-3 for other in shadows[:i])


def test_no_piece_stands_on_an_edge_and_outer_sides_are_up(folder):
    for fact in folder[1]:
        assert fact.height_mm < 17
        assert fact.outer_up
        assert 0 <= fact.overhang_share < 0.5


def test_the_sheet_shows_every_number_once_within_its_outline(folder):
    folder, facts = folder
    text = (folder / "plates.svg").read_text()
    numbers = re.findall(r'text-anchor="middle">(\w+)</text>', text)
    assert sorted(map(int, numbers)) == [int(fact.name[-3:]) for fact in facts]
    assert text.count("<rect") == max(fact.plate for fact in facts)
    pattern = r'<path d="([^"]+)".*?/><text x="([\d.]+)" y="([\d.]+)" font-size="([\d.]+)"'
    for data, x, y, size in re.findall(pattern, text):
        outline = shapely.Polygon([tuple(map(float, p.split())) for p in data.split("Z")[0][1:].split("L")])
        assert outline.contains(shapely.Point(float(x), float(y) - 0.36 * float(size)))


def test_the_picture_is_grey_white_and_black_only(folder):
    from PIL import Image

    picture = np.array(Image.open(folder[0] / "plates.png"))
    assert picture.ndim == 2
    for tone in (0, 220, 255):
        assert (picture == tone).mean() > 0.001
    grey = (picture == 220).sum() / (4.0 * 4.0)  # mm2
    shadows = sum(item.outline.area for item in lay_out(PIECES, PLATE, gap=GAP)[0])
    assert grey == pytest.approx(shadows, rel=0.15)


def test_a_piece_too_large_for_the_plate_is_named_with_its_size(tmp_path):
    large = Piece("piece_099", *bent(120, 60), (0, 0, 0))
    sentence = r"piece_099 \(120 x 60 x 2 mm\).*90 x 80 x 50 mm.*--plate"
    *others, left_out = write_plates(tmp_path, [*PIECES, large], PLATE)
    assert left_out.name == "piece_099"
    assert left_out.plate is None
    assert re.search(sentence, left_out.why)
    assert [fact.name for fact in others] == [piece.name for piece in PIECES]


def test_a_piece_too_high_for_the_printer_is_named():
    high = Piece("piece_007", *bent(30, 30, 0.05, 0.05), (0, 0, 0))
    flat = Piece("piece_008", *bent(30, 30), (0, 0, 0))
    placed, left_out = lay_out([high, flat], Plate(200, 200, 5))
    assert [one.piece.name for one in placed] == ["piece_008"]
    assert [one.name for one in left_out] == ["piece_007"]


@pytest.mark.parametrize("side", [12, 20, 38, 39.9])
def test_a_plate_on_which_no_piece_fits_is_refused_before_anything_is_written(tmp_path, side):
    pieces = [Piece(f"piece_{k}", *bent(30, 30 + k), (0, 0, 0)) for k in range(3)]
    with pytest.raises(OptionError, match=r"no piece fits a plate of .* the smallest is 30 x 30 x 2 mm"):
        write_plates(tmp_path, pieces, Plate(side, side))
    assert list(tmp_path.iterdir()) == []
    assert [fact.plate for fact in write_plates(tmp_path, pieces, Plate(40.1, 40.1))] == [1, None, None]


def test_the_colours_of_a_scan_come_along():
    V, F = bent(20, 20, n=9)
    texture = Texture(np.ones(len(F), bool), np.random.default_rng(0).uniform(size=(len(F), 3, 3)))
    placed, _ = lay_out([Piece("piece_001", V, F, (0, 0, 0), texture=texture)], PLATE)
    np.testing.assert_array_equal(placed[0].piece.texture.rgb, texture.rgb)
    np.testing.assert_array_equal(placed[0].piece.F, F)


def test_no_pieces_need_no_plates():
    assert lay_out([], PLATE) == ([], [])


@pytest.mark.parametrize(
    ("name", "text"), [("piece_007", "7"), ("piece_120", "120"), ("core_1", "core 1"), ("p0", "0")]
)
def test_a_piece_is_called_by_its_number(name, text):
    assert number_of(name) == text
