import html
import json
import re

import numpy as np
import pytest

from meshjig.errors import InputError, OutputError
from meshjig.output.viewer.page import open_viewer, viewer_html, write_viewer
from tests.output.viewer.browser import Browser
from tests.output.viewer.viewing import hue_of, needs_browser, opened, report_of, ring, text


@needs_browser
def test_a_title_and_names_cannot_break_out_of_the_page(desktop, tmp_path):
    evil = "</script><script>window.broken = 1</script><b>{{three}}"
    report = {"input": {"file": f"{evil}.obj"}, "pieces": []}
    write_viewer(tmp_path / "viewer.html", ring()[:1], report)
    page = opened(desktop, tmp_path / "viewer.html")
    assert page.value("window.broken") is None
    assert "{{three}}" in page.value("document.title")
    assert page.errors == []


@needs_browser
def test_the_frame_for_notebooks_shows_the_same_page(desktop, tmp_path):
    frame = viewer_html(ring(), report_of(ring()))
    assert re.fullmatch(r'<iframe [^<>]*srcdoc="[^"]*"></iframe>', frame)
    (tmp_path / "notebook.html").write_text(f"<!doctype html><body>{frame}", encoding="utf-8")
    desktop.said.clear()
    desktop.open(tmp_path / "notebook.html")
    desktop.wait_for("document.querySelector('iframe')?.contentDocument?.documentElement?.dataset.readyAfter")
    desktop.settle()
    assert (np.bincount(hue_of(desktop.picture()).ravel(), minlength=7)[1:] > 800).all()
    assert desktop.errors == []


@needs_browser
def test_a_browser_without_3d_is_told_so_in_words(wheel):
    with Browser(400, 400) as browser:
        none = "HTMLCanvasElement.prototype.getContext = () => null"
        browser.call("Page.addScriptToEvaluateOnNewDocument", source=none)
        browser.open(wheel)
        browser.wait_for("document.getElementById('message')?.textContent.includes(\"can't be shown\")")
        assert "WebGL" in text(browser, "message")


def test_equal_puzzles_give_equal_pages(tmp_path, wheel):
    write_viewer(tmp_path / "again.html", ring(), report_of(ring()), plates={"piece_002": 7})
    assert (tmp_path / "again.html").read_bytes() == wheel.read_bytes()


def test_the_page_names_no_other_place_to_load_from(wheel):
    text = html.unescape(wheel.read_text(encoding="utf-8"))
    assert re.findall(r"<(?:script|link|img|iframe)[^>]+(?:src|href)=", text) == []


def test_a_puzzle_without_pieces_is_refused(tmp_path):
    with pytest.raises(OutputError, match="pieces"):
        write_viewer(tmp_path / "viewer.html", [], {})


def test_view_opens_the_page_of_a_folder(tmp_path, monkeypatch):
    asked = []
    monkeypatch.setattr("webbrowser.open", lambda address: asked.append(address) or True)
    with pytest.raises(InputError, match=r"viewer\.html"):
        open_viewer(tmp_path)
    (tmp_path / "viewer.html").write_text("", encoding="utf-8")
    assert open_viewer(tmp_path) == (tmp_path / "viewer.html").resolve()
    assert asked == [(tmp_path / "viewer.html").resolve().as_uri()]
    monkeypatch.setattr("webbrowser.open", lambda address: False)
    with pytest.raises(OutputError, match="browser"):
        open_viewer(tmp_path)


def data_of(path):
    return json.loads(re.search(r'id="data">(.*?)</script>', path.read_text(encoding="utf-8"))[1])


def test_the_page_knows_how_each_piece_goes_out_and_how_far_apart_all_get(tmp_path, wheel):
    none = data_of(wheel)
    assert [piece["axis"] for piece in none["pieces"]] == [None] * 6
    assert none["grown"] == pytest.approx([none["wide"], none["high"]])
    axes = [[0, 0, 1], [0, 0, 2], None, [1, 0, 0], [0, 1, 0], [0, -1, 0]]
    motions = {str(k + 1): {"axis": axis} for k, axis in enumerate(axes)}
    plan = {"steps": [[k] for k in range(1, 7)], "motions": motions, "verified": True}
    write_viewer(tmp_path / "viewer.html", ring(), {**report_of(ring()), "assembly": plan})
    told = data_of(tmp_path / "viewer.html")
    for piece, axis, before in zip(told["pieces"], axes, none["pieces"], strict=True):
        if axis is None:
            assert (piece["axis"], piece["way"]) == (None, before["way"])
        else:
            assert piece["axis"] == pytest.approx(np.array(axis) / max(map(abs, axis)))
            along = np.dot(piece["way"], piece["axis"])
            assert along > 0
            assert piece["way"] == pytest.approx(along * np.array(piece["axis"]), abs=1e-3)
    lowest = [p.V @ [0, 1, 0] + q["way"][1] for p, q in zip(ring(), told["pieces"], strict=True)]
    low, high = min(map(min, lowest)), max(map(max, lowest))
    whole = np.concatenate([p.V for p in ring()])[:, 1]
    middle = (whole.min() + whole.max()) / 2
    assert told["high"] + told["grown"][1] == pytest.approx(max(high - middle, middle - low), rel=1e-3)


def test_the_puzzle_stands_as_its_report_says(tmp_path, wheel):
    write_viewer(tmp_path / "viewer.html", ring(), {**report_of(ring()), "up": [1.0, 0.0, 0.0]})
    assert '"up":[1.0,0.0,0.0]' not in wheel.read_text(encoding="utf-8")
    assert '"up":[1.0,0.0,0.0]' in (tmp_path / "viewer.html").read_text(encoding="utf-8")
