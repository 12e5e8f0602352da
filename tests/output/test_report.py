import json
from pathlib import Path

import numpy as np
import pytest

from meshjig.errors import InputError
from meshjig.output.report import (
    Expectations,
    read_expectations,
    read_missing,
    read_report,
    title_of,
    write_report,
)

PIECES = [{"id": 1, "neighbours": [2, 3]}, {"id": 2, "neighbours": [1]}, {"id": 3, "neighbours": [1]}]
NAMES = ["piece_001", "piece_002", "piece_003"]


def test_report_is_plain_json_in_the_order_given(tmp_path):
    report = {
        "meshjig": "0.1.0",
        "z": np.int64(3),
        "a": np.float32(0.1),
        "nested": {"bad": float("nan"), "worse": np.inf, "yes": np.bool_(True), "none": None},
        "rows": np.array([[1.0, np.nan]]),
        "many": ({2, 1}, (Path("x") / "y",)),
        3: 1 / 3,
        "tiny": 1.23456789e-12,
        "text": "Büste",
    }
    write_report(tmp_path / "report.json", report)
    read = json.loads((tmp_path / "report.json").read_text(encoding="utf-8"))
    assert list(read) == ["meshjig", "z", "a", "nested", "rows", "many", "3", "tiny", "text"]
    assert read["z"] == 3
    assert read["a"] == 0.1
    assert read["nested"] == {"bad": None, "worse": None, "yes": True, "none": None}
    assert read["rows"] == [[1.0, None]]
    assert read["many"] == [[1, 2], ["x/y"]]
    assert read["3"] == 0.3333333
    assert read["tiny"] == 1.234568e-12
    assert read["text"] == "Büste"


def test_a_report_tells_what_was_asked_for_and_who_are_neighbours():
    report = dict(
        options={"thickness": 3.0, "clearance": 0.1, "min_wall": 0.8, "seed": 5},
        pieces=PIECES,
        exempt_pieces=["piece_002"],
        through={"pieces": ["piece_003"], "model_thin": {"piece_001": 0.25}},
    )
    asked = [(0, 1), (0, 2)], 3.0, 0.1, 0.8, ("piece_002",), ("piece_003",), {"piece_001": 0.25}
    assert read_expectations(report, NAMES) == Expectations(*asked)
    assert read_expectations(report, NAMES[::-1]).neighbours == [(0, 2), (1, 2)]  # in the order of the files
    assert read_expectations(report, NAMES[:2]).neighbours == [(0, 1)]  # a piece was lost


def test_pieces_by_other_names_have_no_known_neighbours():
    report = {"options": {}, "pieces": PIECES}
    assert read_expectations(report, ["left", "right"]) == Expectations()


def test_files_without_a_report_tell_nothing():
    assert read_expectations(None, NAMES) == Expectations()
    assert read_missing(None, NAMES) == []


@pytest.mark.parametrize("report", [{"pieces": []}, {"options": {}, "pieces": [{"id": 1}]}])
def test_a_damaged_report_gets_one_sentence(report):
    with pytest.raises(InputError, match="damaged: remove it"):
        read_expectations(report, NAMES)


ASKED = {"options": {"thickness": 3.0}, "pieces": PIECES, "exempt_pieces": []}


@pytest.mark.parametrize(
    "changed",
    [
        {"options": {"thickness": "thick"}},
        {"options": {"clearance": -1}},
        {"options": {"min_wall": [1]}},
        {"options": {"min_wall": True}},
        {"options": {"thickness": 10**400}},
        {"options": {"thickness": float("nan")}},
        {"options": [1]},
        {"pieces": 3},
        {"pieces": [{"id": "x", "neighbours": []}]},
        {"pieces": [{"id": 1, "neighbours": 3}]},
        {"exempt_pieces": 3},
        {"through": 3},
        {"through": {"pieces": 3}},
        {"through": {"model_thin": [0.1]}},
        {"through": {"model_thin": {"piece_001": 1.5}}},
        {"through": {"model_thin": {"piece_001": True}}},
        {"core": 3},
        {"core": {"parts": "x"}},
        {"core": {"parts": 10**12}},
    ],
)
def test_a_report_that_says_nonsense_is_damaged(changed):
    def read(report):
        return read_expectations(report, NAMES), read_missing(report, NAMES)

    assert read(ASKED)
    with pytest.raises(InputError, match="damaged: remove it to judge the pieces by themselves"):
        read(ASKED | changed)


@pytest.mark.parametrize("text", ["[" * 100_000, '{"a": ' + "9" * 5000 + "}"])
def test_a_report_that_hurts_its_parser_is_damaged(tmp_path, text):
    (tmp_path / "report.json").write_text(text)
    with pytest.raises(InputError, match="no valid JSON, or damaged"):
        read_report(tmp_path / "report.json")


def test_a_name_that_is_no_text_is_escaped(tmp_path):
    name = "b\udcff.ply"  # as the system gives the byte 255
    write_report(tmp_path / "report.json", {"input": {"file": name}})
    read = json.loads((tmp_path / "report.json").read_text(encoding="utf-8"))
    assert read["input"]["file"] == r"b\udcff.ply"
    assert title_of({"input": {"file": name}}) == r"b\udcff"
