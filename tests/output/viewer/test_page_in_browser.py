"""What the viewer does when it is looked at and played with."""

import json
import re

import numpy as np
import pytest

from meshjig.output.piece import Piece
from meshjig.output.viewer.page import write_viewer
from tests.meshes import sphere
from tests.output.viewer.browser import Browser
from tests.output.viewer.viewing import (
    BIG,
    click_on,
    hue_of,
    needs_browser,
    opened,
    pixels_of,
    report_of,
    ring,
    seen,
    shown,
    text,
)


@needs_browser
def test_the_page_opens_from_disk_without_network_and_shows_every_piece_in_its_colour(page):
    assert (pixels_of(page) > 1500).all()
    assert set(page.asked_for) <= {"file", "data", "blob"}
    assert page.value("document.title") == "wheel"
    assert text(page, "summary") == "6 pieces"


@needs_browser
def test_taking_apart_moves_all_pieces_away_from_each_other(page):
    from scipy.ndimage import label

    def patches():
        return label(hue_of(shown(page)[0]) > 0, np.ones((3, 3)))[1]

    assert patches() < 6
    page.press("e")
    assert page.wait_for("$('apart').textContent == '60 %'")
    assert patches() == 6
    page.press("e")
    assert patches() < 6


@needs_browser
def test_a_number_searched_for_is_chosen_faced_and_told(page):
    before = shown(page)[0]
    for key in ("/", "2", "Enter"):
        page.press(key)
    assert re.search(
        r"Piece 2\s+Plate\s+7\s+Size\s+400 mm²\s+Step\s+\d\s+Touches\s+1\s+3", text(page, "card")
    )
    assert (shown(page)[0] != before).any(axis=2).mean() > 0.02
    labels = (
        "[...document.querySelectorAll('#labels span')].map((mark) => [mark.className, mark.textContent])"
    )
    page.wait_for(f"{labels}.length")
    marks = {name: kind for kind, name in page.value(labels)}
    assert marks["2"] == "chosen"
    assert {name for name, kind in marks.items() if kind == "near"} <= {"1", "3"}
    page.press("Escape")
    assert page.value("$('card').hidden")


@needs_browser
@pytest.mark.parametrize("typed", ["7", "x"])
def test_a_number_that_no_piece_has_is_said_so(page, typed):
    page.press("/")
    for key in [*typed, "Enter"]:
        page.press(key)
    assert "from 1 to 6" in text(page, "missing")
    assert page.value("$('card').hidden")


@needs_browser
@pytest.mark.parametrize("piece", [1, 6])
def test_a_click_chooses_the_piece_under_it_and_one_beside_lets_go(page, piece):
    click_on(page, piece)
    assert text(page, "card").startswith(f"Piece {piece}\n")
    near = sorted({(piece - 2) % 6 + 1, piece % 6 + 1})
    assert page.value("[...document.querySelectorAll('.chips button')].map((b) => +b.textContent)") == near
    _, (left, top) = shown(page)
    page.click(left + 5, top + 5)
    assert page.value("$('card').hidden")


@needs_browser
def test_the_rest_is_hidden_step_by_step(page):
    click_on(page, 3)
    page.press("h")
    assert seen(page) == {2, 3, 4}
    page.press("h")
    assert seen(page) == {3}
    assert pixels_of(page)[[0, 1, 3, 5]].max() < 100
    page.press("Escape")
    assert (pixels_of(page) > 1500).all()


@needs_browser
def test_steps_go_through_the_order_of_assembly(page):
    order = [piece for step in page.value("JSON.parse($('data').textContent).steps") for piece in step]
    assert sorted(order) == [1, 2, 3, 4, 5, 6]
    for back in range(6):
        page.press(",")
        placed, hidden = order[: 6 - back], order[6 - back :]
        visible = seen(page)
        assert visible <= set(placed)
        assert placed[-1] in visible
        assert text(page, "adds").endswith(f"adds {placed[-1]}.")
        assert not visible & set(hidden)
    page.press(",")
    assert "Step 1 of 6" in text(page, "adds")
    assert page.value("getComputedStyle($('unverified')).display") != "none"


@needs_browser
def test_colours_show_size_and_number_of_neighbours(page):
    page.press("c")
    assert page.value("document.querySelector('[name=colour]:checked').value") == "size"
    assert re.search(r"400 mm²\s*900 mm²", text(page, "legend"))
    rgb = shown(page)[0].astype(int)
    yellow = (rgb[..., 0] > 150) & (rgb[..., 1] > 130) & (rgb[..., 2] < 100)
    height, width = rgb.shape[:2]
    ids = np.array(page.value(f"[...window.viewer.stage.ids({width}, {height})]")).reshape(height, -1)[::-1]
    assert yellow[ids == BIG].mean() > 0.6
    assert yellow[(ids != BIG) & (ids > 0)].mean() < 0.02
    page.press("c")
    assert text(page, "legend").split() == ["2"]


@needs_browser
def test_light_and_dark_and_help_by_keyboard(page):
    light = shown(page)[0][5, 5]
    page.press("t")
    dark = shown(page)[0][5, 5]
    assert light.min() > 200
    assert dark.max() < 70
    page.press("?")
    assert page.value("$('keys').open")
    assert "Find a number" in text(page, "keys")
    page.press("Enter")
    page.value("$('keys').close()")


@needs_browser
def test_every_control_has_a_name(page):
    unnamed = page.value(
        """[...document.querySelectorAll('button, input')].filter((control) => !(control.ariaLabel
            || control.labels?.[0]?.textContent.trim() || control.textContent.trim())
            ).map((c) => c.outerHTML)"""
    )
    assert unnamed == []


@needs_browser
def test_arrow_keys_turn_and_plus_comes_closer(page):
    before = pixels_of(page)
    for _ in range(11):
        page.press("ArrowRight")
    assert pixels_of(page).sum() < 0.6 * before.sum()  # the wheel is seen from its edge
    page.press("0")
    for _ in range(2):
        page.press("+")
    assert pixels_of(page).sum() > 1.3 * before.sum()


@needs_browser
def test_on_a_phone_everything_fits_and_a_tap_chooses(wheel):
    with Browser(390, 844, phone=True) as phone:
        opened(phone, wheel)
        assert phone.value("document.documentElement.scrollWidth") <= 390
        box = json.loads(phone.value("JSON.stringify($('view').getBoundingClientRect())"))
        assert box["height"] > 0.5 * 844
        picture = phone.picture()[::2, ::2][: round(box["height"])]
        hues = hue_of(picture)
        assert (np.bincount(hues.ravel(), minlength=7)[1:] > 500).all()
        assert not hues[:, [0, -1]].any()
        row, column = np.argwhere(hues == 5).mean(0)
        for kind, points in (("touchStart", [{"x": column, "y": row}]), ("touchEnd", [])):
            phone.call("Input.dispatchTouchEvent", type=kind, touchPoints=points)
        phone.wait_for("$('card').innerText.startsWith('Piece 5')")
        assert phone.errors == []


@pytest.fixture(scope="module")
def planned(tmp_path_factory):
    """The ring, of which every piece goes out to the side on which it is."""
    pieces = ring()
    motions = {str(k + 1): {"axis": (p.V.mean(axis=0) / 50).tolist()} for k, p in enumerate(pieces)}
    motions["6"]["axis"] = None
    plan = {"steps": [[1], [2, 3], [4], [5], [6]], "motions": motions, "verified": True}
    path = tmp_path_factory.mktemp("planned") / "viewer.html"
    write_viewer(path, pieces, {**report_of(pieces), "assembly": plan})
    return path


def middle_of(page, piece):
    page.settle()
    ids = np.array(page.value("[...window.viewer.stage.ids(300, 240)]")).reshape(240, 300)
    return np.argwhere(ids == piece).mean(axis=0)


@needs_browser
def test_a_piece_of_a_plan_comes_in_along_its_way_and_nobody_doubts_the_order(desktop, planned):
    page = opened(desktop, planned)
    assert page.value("getComputedStyle($('unverified')).display") == "none"
    page.value("window.viewer.step(2)")
    page.settle()
    seats = {k: middle_of(page, k) for k in (1, 2, 3)}
    new = "[2, 3].map((id) => window.viewer.data.pieces[id - 1])"
    page.value(f"window.viewer.stage.slide({new}, 0.25)")  # the first of two is half in
    off = {k: middle_of(page, k) - seats[k] for k in (1, 2, 3)}
    assert np.linalg.norm(off[1]) < 1
    assert 10 < np.linalg.norm(off[2]) < 0.7 * np.linalg.norm(off[3])
    assert off[2] @ off[3] > 0  # neighbours in a ring, and both go outward
    assert off[3] @ (seats[3] - seats[1]) > 0
    page.value(f"window.viewer.stage.slide({new}, 1)")
    for k in (2, 3):
        assert np.linalg.norm(middle_of(page, k) - seats[k]) < 1
    assert page.errors == []


@needs_browser
def test_a_step_forward_lets_its_pieces_slide_in_and_one_back_does_not(desktop, planned):
    page = opened(desktop, planned)
    moving = {"name": "prefers-reduced-motion", "value": "no-preference"}
    page.call("Emulation.setEmulatedMedia", features=[moving])
    try:
        lifted = "window.viewer.stage.lifted.map((piece) => piece.id)"
        page.value("window.viewer.step(1)")
        page.wait_for(f"!{lifted}.length")
        page.press(".")
        assert page.wait_for(f"{lifted}.length && {lifted}") == [2, 3]
        page.wait_for(f"!{lifted}.length")
        assert page.value("window.viewer.stage.slides.image.data.every((x) => x === 0)")
        page.press(",")
        assert page.value(lifted) == []
        page.value("window.viewer.step(5)")  # a piece of which nobody knows how it goes in
        assert page.value(lifted) == []
    finally:
        page.call("Emulation.setEmulatedMedia", features=[])
    assert page.errors == []


@needs_browser
def test_a_plan_that_was_not_proved_is_called_planned(desktop, planned, tmp_path):
    page = planned.read_text(encoding="utf-8").replace('"verified":true', '"verified":false')
    (tmp_path / "viewer.html").write_text(page, encoding="utf-8")
    told = text(opened(desktop, tmp_path / "viewer.html"), "unverified")
    assert "was planned" in told
    assert "Nobody" not in told


@needs_browser
def test_the_core_stays_in_the_middle_is_no_piece_and_can_be_hidden(desktop, tmp_path):
    core = Piece("core_1", *sphere(500, 20.0), (0.6, 0.6, 0.6))
    write_viewer(tmp_path / "viewer.html", ring(), report_of(ring()), core=[core])
    page = opened(desktop, tmp_path / "viewer.html")
    assert seen(page) == {1, 2, 3, 4, 5, 6, 7}
    assert text(page, "summary") == "6 pieces"
    picture, (left, top) = shown(page)
    middle = np.argwhere(hue_of(picture) > 0).mean(0)
    page.click(left + middle[1], top + middle[0])
    assert page.value("$('card').hidden")
    page.press("k")
    assert seen(page) == {1, 2, 3, 4, 5, 6}
    page.press("k")
    click_on(page, 3)
    page.press("h")
    assert seen(page) == {2, 3, 4}
    assert page.errors == []
