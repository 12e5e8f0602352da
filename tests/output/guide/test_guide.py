import re
import zlib

import numpy as np
import pytest
import shapely
from PIL import Image

from meshjig.errors import OutputError
from meshjig.mesh.measure import unit
from meshjig.output.guide.cameras import cameras, choose_cameras
from meshjig.output.guide.guide import write_guide
from meshjig.output.guide.pages import BOTTOM, LEFT, RIGHT, TOP, text_width, wrapped
from meshjig.output.guide.parts_pages import outlines, parts_pages
from meshjig.output.guide.place_labels import place_labels
from meshjig.output.guide.proxy import PlacedFaces, join_pieces, proxy_model
from meshjig.output.guide.step_picture import Frame, draw_step, silhouette
from meshjig.output.guide.table_pages import table_pages
from meshjig.output.order import assembly_order
from meshjig.output.pictures.scene import cast, scene_of
from meshjig.output.pictures.view import View
from meshjig.output.piece import Piece, concatenate
from tests.meshes import moved, sphere

RED = (0.9, 0.1, 0.1)


def balls(places, radius=6.0, n=500):
    return [
        Piece(f"piece_{k + 1:03d}", *moved(sphere(n, radius), place), RED)
        for k, place in enumerate(np.asarray(places, float).tolist())
    ]


def on_a_globe(n, radius=30.0):
    """Give the middles of n places spread over a sphere, from the bottom up, y upward."""
    y = (2 * np.arange(n) + 1) / n - 1
    turn = np.arange(n) * np.pi * (3 - np.sqrt(5))
    side = np.sqrt(1 - y * y)
    return radius * np.stack([side * np.cos(turn), y, side * np.sin(turn)], 1)


def report_of(pieces, near):
    return {
        "input": {"file": "/scans/globe.ply"},
        "options": {"thickness": 2.0, "clearance": 0.2},
        "pieces": [{"neighbours": sorted(x)} for x in near],
    }


def chain(n):
    return [[k for k in (i, i + 2) if 1 <= k <= n] for i in range(n)]


@pytest.fixture(scope="module")
def globe():
    pieces = balls(on_a_globe(40), 7.0)
    return pieces, chain(40)


@pytest.fixture(scope="module")
def few():
    pieces = balls(on_a_globe(12), 12.0, n=80)
    return pieces, chain(12)


def guide(path, pieces, report, plates=None):
    write_guide(path, pieces, report, plates=plates, cover=lambda: np.full((40, 60, 3), 128, np.uint8))
    return pages_of(path)


def pages_of(path):
    """Give for each page of a PDF all words that it shows, in the order in which they are written."""
    data = path.read_bytes()
    pages = []
    for stream in re.findall(rb"stream\r?\n(.*?)endstream", data, re.S):
        try:
            content = zlib.decompressobj().decompress(stream).decode("latin-1")
        except zlib.error:
            continue  # a picture
        if " Tj" in content:
            pages.append([_plain(words) for words in re.findall(r"\((.*?)\) Tj", content)])
    return pages


def _plain(words):
    words = re.sub(r"\\([0-7]{3})", lambda code: chr(int(code[1], 8)), words)
    return re.sub(r"\\(.)", r"\1", words)


class Paper:
    """Takes down what a page would show."""

    def __init__(self):
        self.words, self.shapes = [], []

    def text(self, x, y, words, size=9.0, *, strong=False, **_):
        self.words.append((x, y, words, size, strong))

    def shape(self, ring, **_):
        self.shapes.append(shapely.Polygon(ring))

    def line(self, *_, **__):
        pass

    def box(self, *_, **__):
        pass


def drawn(page):
    paper = Paper()
    page(paper)
    return paper


def prism(corners, height=2.0):
    """Give a prism over a triangle in the plane, counterclockwise."""
    low, high = (np.column_stack([corners, np.full(3, z)]) for z in (0.0, height))
    sides = [[i, (i + 1) % 3, j] for i in range(3) for j in (3 + (i + 1) % 3,)]
    sides += [[i, 3 + (i + 1) % 3, 3 + i] for i in range(3)]
    return np.vstack([low, high]), np.array([[2, 1, 0], [3, 4, 5], *sides])


def rotation(seed):
    Q, R = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))
    Q = Q * np.sign(np.diag(R))
    return Q * [1, 1, np.sign(np.linalg.det(Q))]


# ---- the whole


def test_the_guide_has_every_piece_in_its_list_once_in_a_step_and_in_its_table(tmp_path, few):
    pieces, near = few
    plates = {piece.name: 1 + (k > 6) for k, piece in enumerate(pieces)}
    cover, *pages = guide(tmp_path / "guide.pdf", pieces, report_of(pieces, near), plates)
    assert cover[0] == "globe"
    assert {"Size", "Thickness", "2 mm", "0.2 mm", "2 plates"} <= set(cover)
    assert cover[-1] == f"1 / {len(pages) + 1}"
    starts = {}
    by_chapter = {name: [] for name in ("What you have", "Putting it together", "Who borders on whom")}
    for number, page in enumerate(pages, 2):
        *words, chapter, title, footer = page
        assert (title, footer) == ("globe", f"{number} / {len(pages) + 1}")
        by_chapter[chapter] += words
        starts.setdefault(chapter, number)
    assert starts == {chapter: int(cover[cover.index(chapter) + 1]) for chapter in by_chapter}
    everyone = sorted(map(str, range(1, 13)))
    parts = by_chapter["What you have"]
    assert sorted(words for words in parts if words.isdigit()) == everyone
    assert {"Plate 1: 7 pieces", "Plate 2: 5 pieces"} <= set(parts)
    shown = by_chapter["Putting it together"]
    heads = [at for at, words in enumerate(shown) if words.startswith("from the")]
    assert sorted(shown[at - 1] for at in heads) == everyone
    for at, after in zip(heads, [*(at - 2 for at in heads[1:]), None], strict=True):
        assert shown[at - 1] in shown[at + 1 : after]  # its number is in its picture
    table = by_chapter["Who borders on whom"]
    assert {"2", "1, 3", "10, 12", "11"} <= set(table)


def test_equal_puzzles_give_equal_bytes_without_a_date(tmp_path, few):
    pieces, near = few
    for name in ("a.pdf", "b.pdf"):
        guide(tmp_path / name, pieces, report_of(pieces, near))
    data = (tmp_path / "a.pdf").read_bytes()
    assert data == (tmp_path / "b.pdf").read_bytes()
    assert set(re.findall(rb"D:(\d{8})", data)) <= {b"20000101"}


def test_a_puzzle_of_which_little_is_known_has_a_guide_too(tmp_path):
    write_guide(tmp_path / "guide.pdf", balls([[0, 0, 0]]), {"input": {"file": "猫 é.obj"}})
    cover, *pages = pages_of(tmp_path / "guide.pdf")
    assert cover[0] == "Mao é"
    assert "Who borders on whom" not in cover
    assert len(pages) == 2


@pytest.mark.parametrize("verified", [False, True])
def test_the_cover_says_whether_somebody_checked_the_order(tmp_path, few, verified):
    pieces, near = few
    plan = {"steps": [[12, 3], [k for k in range(1, 12) if k != 3]], "verified": verified}
    cover, *pages = guide(tmp_path / "guide.pdf", pieces, report_of(pieces, near) | {"assembly": plan})
    assert ("was checked" in " ".join(cover)) is verified
    assert ("Nobody has made sure" in " ".join(cover)) is not verified
    assert "12, 3" in pages[1]


def test_no_pieces_are_told(tmp_path):
    with pytest.raises(OutputError, match="without pieces"):
        write_guide(tmp_path / "guide.pdf", [], {})


# ---- steps


@pytest.mark.parametrize("seed", range(3))
def test_each_new_piece_is_seen_from_where_it_is_shown(seed):
    away = np.random.default_rng(seed).permutation(on_a_globe(24, 40.0))
    pieces = balls([[0, 0, 0]], 30.0) + balls(away, 6.0)
    steps = [[1], *([k + 2, k + 3, k + 4] for k in range(0, 24, 3))]
    model = proxy_model(join_pieces(pieces), steps)
    places = cameras(model)
    for number, step in enumerate(steps[1:], 1):
        chosen = choose_cameras(model, model.until(number), [k - 1 for k in step], places, 0)
        assert sorted(piece for _, mine in chosen for piece in mine) == sorted(k - 1 for k in step)
        for camera, mine in chosen:
            eye = places[camera].view.eye
            for piece in mine:
                middle = away[piece - 1]
                nearest = np.linalg.norm(np.cross(middle, unit(middle - eye)))
                behind = unit(middle) @ unit(eye) < 0
                below = unit(middle)[1] < -0.8  # no place is below the ground
                assert below or not (behind and nearest < 24)


def test_pieces_on_opposite_sides_of_something_large_have_a_picture_each():
    V, F = prism(np.array([[-6.0, -4.0], [6.0, -4.0], [0.0, 8.0]]), 0.2)
    front = V + np.array([0, 0, 30])
    back = front * [-1, 1, -1]
    plates = [
        Piece(f"p{z}", W, F, RED, outer_normal=np.array([0, 0, z])) for W, z in ((front, 1), (back, -1))
    ]
    model = proxy_model(join_pieces([*balls([[0, 0, 0]], 30.0), *plates]), [[1], [2, 3]])
    chosen = choose_cameras(model, model.until(1), [1, 2], cameras(model), 0)
    assert sorted(mine for _, mine in chosen) == [[1], [2]]


def test_a_picture_is_that_of_the_placed_pieces_alone(globe):
    pieces, near = globe
    steps = assembly_order(pieces, near)
    model = proxy_model(join_pieces(pieces), steps)
    view = cameras(model)[2].view
    frame = Frame(240, 160, 160 / (2.2 * view.half), (float(view.centre[0]), float(view.centre[1])))
    for number in (0, 3, 7, len(steps) - 1):
        placed = [piece - 1 for step in steps[: number + 1] for piece in step]
        picture = draw_step(model.until(number), view, frame, placed[-2:], np.zeros((160, 240), bool))
        V, F, _, owner = concatenate([pieces[k] for k in placed])
        square = View(view.eye, view.axes, view.centre, 120 / frame.scale)
        row, column = (x.ravel() for x in np.mgrid[:160, :240])
        truth = cast(scene_of(V, F, np.ones((len(F), 3)), owner), square, 240, column + 0.5, row + 40.5).id
        truth = np.where(truth >= 0, np.array(placed)[truth], -1).reshape(160, 240)
        assert (truth >= 0).mean() > 0.005
        assert (picture.piece == truth).mean() > 0.985
        assert set(np.unique(picture.piece)) <= {-1, *placed}


def test_new_pieces_stand_out_in_black_and_white():
    pieces = balls([[-14, 0, 0], [14, 0, 0]], 12.0)
    model = proxy_model(join_pieces(pieces), [[1], [2]])
    view = cameras(model)[0].view
    frame = Frame(300, 200, 280 / (2.2 * view.half), (float(view.centre[0]), float(view.centre[1])))
    picture = draw_step(model.until(1), view, frame, [1], np.zeros((200, 300), bool))
    grey = np.asarray(Image.fromarray(picture.rgb).convert("L")).astype(float)
    old, new = (grey[picture.piece == k] for k in (0, 1))
    assert len(old) == pytest.approx(len(new), rel=0.3)
    assert new.mean() < old.mean() - 15
    inside = picture.piece == 1
    lines = np.abs(np.diff(grey, axis=1))[inside[:, 1:] & inside[:, :-1]]
    assert (lines > 15).mean() > 0.1  # the hatching
    assert (old < 60).mean() < 0.01
    assert (new < 60).mean() > 0.02  # the border
    assert (grey[picture.piece < 0] > 240).mean() > 0.9


def test_the_silhouette_is_the_shadow_of_all(globe):
    pieces, _ = globe
    model = proxy_model(join_pieces(pieces), [[k + 1 for k in range(40)]])
    view = cameras(model)[0].view
    frame = Frame(200, 200, 200 / (2.2 * view.half), (float(view.centre[0]), float(view.centre[1])))
    shadow = silhouette(PlacedFaces(model.scene, len(model.scene.F)), view, frame)
    picture = draw_step(model.until(0), view, frame, [], shadow)
    assert (shadow[picture.piece >= 0]).mean() > 0.97
    assert 0.3 < shadow.mean() < 0.9


def test_the_proxy_is_lighter_but_of_the_same_shape():
    pieces = balls([[0, 0, 0], [60, 0, 0], [0, 60, 0]], 25.0, n=60_000)
    model = proxy_model(join_pieces(pieces), [[3], [1, 2]])
    assert len(model.scene.F) < 0.5 * sum(len(piece.F) for piece in pieces)
    assert model.scene.id[0] == 2
    assert set(model.scene.id[: model.first_face[1]]) == {2}
    for k, piece in enumerate(pieces):
        off = model.V[model.scene.F[model.scene.id == k]].reshape(-1, 3) - piece.V.mean(axis=0)
        assert np.linalg.norm(off, axis=1) == pytest.approx(25, abs=1.0)


# ---- numbers


def scattered(seed, n=14, size=(200, 260)):
    rng = np.random.default_rng(seed)
    row, column = np.mgrid[: size[0], : size[1]]
    piece = np.full(size, -1)
    for k in range(n):
        y, x, r = rng.uniform(10, size[0] - 10), rng.uniform(10, size[1] - 10), rng.uniform(3, 22)
        piece[np.hypot(row - y, column - x) < r] = k
    return piece


@pytest.mark.parametrize("seed", range(6))
def test_numbers_overlap_nothing_and_point_at_their_pieces(seed):
    piece = scattered(seed)
    new = list(range(0, 14, 2))
    sizes = [(24.0, 16.0)] * len(new)
    labels = place_labels(piece, new, sizes)
    seen = [k for k in new if np.count_nonzero(piece == k) >= 24]
    assert [label.piece for label in labels] == seen
    assert any(label.tip is None for label in labels)
    boxes = [shapely.box(x - 12, y - 8, x + 12, y + 8) for x, y in (label.at for label in labels)]
    for i, box in enumerate(boxes):
        assert box.within(shapely.box(-2, -2, 262, 202))
        assert all(box.intersection(other).area < 1e-6 for other in boxes[:i])
    for label in labels:
        x, y = label.at if label.tip is None else label.tip
        assert piece[int(y), int(x)] == label.piece


def test_a_piece_that_is_not_seen_has_no_number():
    piece = np.full((50, 50), -1)
    piece[10:12, 10:12] = 3
    assert place_labels(piece, [3, 4], [(10.0, 8.0)] * 2) == []


# ---- what there is


@pytest.mark.parametrize("seed", range(4))
def test_outlines_are_true_in_size_and_not_mirrored(seed):
    corners = np.array([[0.0, 0.0], [30.0, 0.0], [8.0, 12.0]])
    V, F = prism(corners)
    R = rotation(seed)
    piece = Piece("p", V @ R.T + [3.0, -8.0, 1.0], F, RED, outer_normal=R[:, 2] * 180)
    (outline,) = outlines(join_pieces([piece]))
    assert outline.size == pytest.approx([30, 12], abs=0.3)
    ring = shapely.Polygon(outline.ring)
    assert ring.area == pytest.approx(180, abs=1.0)
    points = shapely.get_coordinates(shapely.orient_polygons(ring.convex_hull))[:-1]
    to, back = np.roll(points, -1, axis=0) - points, np.roll(points, 1, axis=0) - points
    points = points[np.einsum("ij,ij->i", unit(to), unit(back)) > -0.99]  # corners, not where it began
    sides = np.linalg.norm(np.roll(points, -1, axis=0) - points, axis=1)
    assert np.roll(sides, -int(sides.argmax())) == pytest.approx(
        [30, np.hypot(22, 12), np.hypot(8, 12)], abs=0.3
    )


def test_every_piece_has_its_own_outline(globe):
    pieces = balls(on_a_globe(6, 60.0), 5.0) + balls([[0, 0, 0]], 11.0)
    for piece, outline in zip(pieces, outlines(join_pieces(pieces)), strict=True):
        diameter = float(np.ptp(piece.V, axis=0).max())
        assert outline.size == pytest.approx([diameter] * 2, rel=0.06)


@pytest.mark.parametrize(("n", "n_plates", "pages"), [(1, 1, 1), (100, 0, 1), (100, 3, 1), (300, 4, 3)])
def test_outlines_lie_apart_within_the_page_under_their_plate(n, n_plates, pages):
    rng = np.random.default_rng(n)
    V, F = prism(np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]), 0.02)
    pieces = [Piece("p", V * [*rng.uniform(15, 40, 2), 1], F, RED, outer_normal=V[3]) for _ in range(n)]
    shapes = outlines(join_pieces(pieces))
    plates = [None] * n if n_plates == 0 else (1 + rng.permutation(n) % n_plates).tolist()
    made = [drawn(page) for page in parts_pages(shapes, plates)]
    assert len(made) <= pages
    assert sum(len(paper.shapes) for paper in made) == n
    paper_area = shapely.box(LEFT - 0.1, TOP, RIGHT + 0.1, BOTTOM + 0.1)
    heading = None
    for paper in made:
        tree = shapely.STRtree(paper.shapes)
        assert tree.query(paper.shapes, "intersects").shape[1] == len(paper.shapes)
        assert all(shape.within(paper_area) for shape in paper.shapes)
        for _, _, words, _, _ in paper.words:
            if "pieces" in words:
                heading = words
            elif words.isdigit() and n_plates:
                assert heading is None or heading.startswith(f"Plate {plates[int(words) - 1]}:")


# ---- the table


@pytest.mark.parametrize("n", [3, 100, 300])
def test_the_table_tells_each_pieces_step_plate_and_neighbours(n):
    rng = np.random.default_rng(n)
    near = [sorted(rng.choice(n, rng.integers(0, min(n, 30)), replace=False) + 1) for _ in range(n)]
    steps = [[k + 1 for k in range(i, min(i + 7, n))] for i in range(0, n, 7)]
    plates = rng.integers(1, 4, n).tolist()
    found = {}
    for page in table_pages(near, steps, plates):
        for x, y, words, size, strong in drawn(page).words:
            assert x >= LEFT
            assert x + text_width(words, size, strong=strong) <= RIGHT + 0.1
            assert y <= BOTTOM + 0.1
            if strong:
                row = found.setdefault(int(words), [])
            elif size == 7.5:
                row.append(words)
    assert list(found) == list(range(1, n + 1))
    for piece, (step, plate, *lines) in found.items():
        assert piece in steps[int(step) - 1]
        assert int(plate) == plates[piece - 1]
        told = " ".join(lines).split(", ")
        assert told == ([str(k) for k in near[piece - 1]] or ["none"])


@pytest.mark.parametrize("width", [5.0, 20.0, 60.0])
def test_lines_are_no_wider_than_asked_and_lose_nothing(width):
    words = " ".join(str(7**k) for k in range(14))
    lines = wrapped(words, 8, width)
    assert " ".join(lines) == words
    assert all(text_width(line, 8) <= width or " " not in line for line in lines)


def test_steps_are_seen_with_up_where_the_puzzle_says(globe):
    pieces, _ = globe
    model = proxy_model(join_pieces(pieces, np.array([0.0, 0, 1])), [[k + 1 for k in range(len(pieces))]])
    for place in cameras(model):
        assert place.view.axes[1] @ [0, 0, 1] > 0.5
