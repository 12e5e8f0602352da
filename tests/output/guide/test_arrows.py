from dataclasses import replace

import numpy as np
import pytest
import shapely

from meshjig.mesh.measure import unit
from meshjig.output.guide.arrows import Arrows, arrow_at, arrow_shape, arrows_of, arrows_on_paper
from meshjig.output.guide.cameras import cameras, choose_cameras
from meshjig.output.guide.guide import write_guide
from meshjig.output.guide.place_labels import Label, place_labels
from meshjig.output.guide.proxy import join_pieces, proxy_model
from meshjig.output.guide.steps_pages import steps_pages
from meshjig.output.pictures.view import view_of
from tests.meshes import sphere
from tests.output.guide.test_guide import balls, chain, guide, on_a_globe, pages_of, report_of

UPWARD = np.array([0.0, 1.0, 0.0])


class Paper:
    """Takes down the arrows that a page would show."""

    def __init__(self):
        self.arrows, self.numbers = [], []

    def shape(self, ring, **_):
        self.arrows.append(ring)

    def tag(self, x, y, words, size):
        self.numbers.append((words, x, y))

    def __getattr__(self, _):
        return lambda *_, **__: None


def planned(n, steps, **more):
    ways = unit(on_a_globe(n))
    motions = {str(k + 1): {"axis": way.tolist(), "turn": None} for k, way in enumerate(ways)}
    return {"assembly": {"steps": steps, "motions": motions, "verified": True, **more}}


def test_arrows_begin_outside_their_piece_on_its_way_out():
    pieces = balls([[0, 0, 0], [40, 0, 0]], 10.0)
    ways = np.array([[0.0, 0, 1], [0, 0, 0]])
    arrows = arrows_of(join_pieces(pieces, UPWARD), ways)
    assert arrows.way == pytest.approx(ways)
    assert arrows.start[0, 2] > 12
    assert arrows.start[0, :2] == pytest.approx(arrows.seat[0, :2])
    assert np.linalg.norm(arrows.seat - [[0, 0, 0], [40, 0, 0]], axis=1).max() < 10


@pytest.mark.parametrize("seed", range(6))
@pytest.mark.parametrize("tip", [None, (60.0, 50.0)])
def test_an_arrow_comes_from_its_side_stops_before_the_number_and_stays_in_the_picture(seed, tip):
    rng = np.random.default_rng(seed)
    label, size = Label(3, tuple(rng.uniform([30, 30], [170, 90])), tip), (24.0, 16.0)
    along = rng.uniform(22, 300) * unit(rng.normal(size=2))
    start, end = arrow_at(label, size, along, (200, 120))
    assert unit(start - end) == pytest.approx(unit(along))
    assert ((start >= 0) & (start <= [200, 120])).all()
    x, y = label.at if tip is None else tip
    if tip is None:
        box = shapely.box(x - 12, y - 8, x + 12, y + 8)
        assert shapely.LineString([start, end]).distance(box) > 0.5
    assert np.linalg.norm(end - (x, y)) < 18


def test_an_arrow_that_points_at_the_eye_is_not_drawn():
    assert arrow_at(Label(0, (50.0, 50.0), None), (24.0, 16.0), np.zeros(2), (100, 100)) is None
    view = view_of(sphere(80, 10.0).V, UPWARD, 0.0, 0.0)
    ways = np.array([view.eye, [0, 1, 0], [1, 0, 0], view.eye + np.array([4.0, 0, 0])])
    arrows = Arrows(np.zeros((4, 3)), ways)
    along = arrows_on_paper(arrows, [0, 1, 2, 3], replace(view, eye=3 * view.eye), 500.0)
    assert along[0] == pytest.approx([0, 0])
    assert unit(along[1:3]) == pytest.approx(np.array([[0, -1], [1, 0]]))
    assert np.linalg.norm(along[1:], axis=1).min() > 10


@pytest.mark.parametrize("turn", [0.0, 1.0, 2.5])
@pytest.mark.parametrize("length", [2.0, 20.0])
def test_the_outline_of_an_arrow_ends_in_its_tip_and_is_widest_behind_it(turn, length):
    start = np.array([10.0, 20.0])
    way = np.array([np.cos(turn), np.sin(turn)])
    ring = arrow_shape(start.tolist(), (start + length * way).tolist())
    along, across = (ring - start) @ way, (ring - start) @ [-way[1], way[0]]
    assert shapely.Polygon(ring).is_valid
    assert along.max() == pytest.approx(length)
    assert across[along.argmax()] == pytest.approx(0)
    assert 0.3 * length < along[np.abs(across).argmax()] < length
    assert along.min() == pytest.approx(0)


def test_numbers_leave_the_arrows_of_others_room():
    piece = np.full((120, 300), -1)
    piece[30:90, 20:80], piece[30:90, 200:260] = 0, 1
    sizes, along = [(24.0, 16.0)] * 2, [np.array([180.0, 0.0]), np.array([0.0, -60.0])]
    alone = place_labels(piece, [0, 1], sizes)
    assert all(label.tip is None for label in alone)
    first, second = place_labels(piece, [0, 1], sizes, along)
    assert first == alone[0]
    assert second.tip is not None
    start, end = arrow_at(first, sizes[0], along[0], (300, 120))
    x, y = second.at
    outer = shapely.LineString([(start + end) / 2, start])
    assert outer.distance(shapely.box(x - 12, y - 8, x + 12, y + 8)) > 0


def test_pieces_that_go_in_from_below_are_shown_from_below_and_others_from_where_their_arrow_is_seen():
    pieces = balls([[0, 0, 0], [0, -34, 0], [34, 0, 0]], 30.0) + balls([[0, 40, 0]], 3.0)
    ways = np.array([[0.0, 1, 0], [0, -1, 0], [1, 0, 0], [0, 1, 0]])
    joined = join_pieces(pieces, UPWARD)
    model, arrows = proxy_model(joined, [[1], [2], [3], [4]]), arrows_of(joined, ways)
    places = cameras(model, below=True)
    for number, piece in ((1, 1), (2, 2)):
        (camera, _), *_ = choose_cameras(model, model.until(number), [piece], places, 0, arrows)
        toward_eye = unit(places[camera].view.eye - arrows.seat[piece])
        assert 0 < toward_eye @ ways[piece] < 0.9
    assert "below" in places[choose_cameras(model, model.until(1), [1], places, 0, arrows)[0][0]].words
    assert all(place.elevation > 0 for place in cameras(model))


def test_every_piece_of_a_step_has_an_arrow_beside_its_number():
    pieces = balls(on_a_globe(12), 12.0, n=80)
    joined = join_pieces(pieces, UPWARD)
    arrows = arrows_of(joined, unit(on_a_globe(12)))
    steps = [[k + 1, k + 2] for k in range(0, 12, 2)]
    paper = Paper()
    for page in steps_pages(joined, steps, lambda: np.full((4, 4, 3), 9, np.uint8), arrows):
        page(paper)
    assert sorted(int(words) for words, _, _ in paper.numbers) == list(range(1, 13))
    assert len(paper.arrows) == 12
    without = Paper()
    for page in steps_pages(joined, steps, lambda: np.full((4, 4, 3), 9, np.uint8)):
        page(without)
    assert without.arrows == []


@pytest.mark.parametrize("verified", [True, False])
def test_the_cover_says_what_was_tried(tmp_path, verified):
    pieces = balls(on_a_globe(4), 12.0, n=80)
    report = report_of(pieces, chain(4)) | planned(4, [[1], [2], [3], [4]], verified=verified, proved=3)
    cover = " ".join(guide(tmp_path / "guide.pdf", pieces, report)[0])
    assert "arrow shows how" in cover
    assert ("Every piece was tried" in cover) is verified
    assert ("3 of 4 pieces" in cover) is not verified
    assert "Nobody has made sure" not in cover


def test_a_plan_of_many_pieces_has_thirty_steps_with_the_numbers_of_the_assembly(tmp_path):
    pieces = balls(on_a_globe(62), 6.0, n=40)
    report = report_of(pieces, chain(62)) | planned(62, [[k + 1] for k in range(62)])
    write_guide(tmp_path / "guide.pdf", pieces, report, cover=lambda: np.full((4, 4, 3), 9, np.uint8))
    words = {word for page in pages_of(tmp_path / "guide.pdf") for word in page}
    assert len(words & {f"{k}, {k + 1}, {k + 2}" for k in range(1, 60, 3)}) > 5
    assert words & {"21", "21a"}
    assert not words & {"63", "22a"}
