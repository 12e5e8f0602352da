"""Facts for people: four digits, words for what was not done, and no codes for the terminal."""

from meshjig.cli.lines import as_lines


def test_numbers_are_rounded_and_written_out():
    facts = {
        "a": 147.926603063042,
        "b": 20106.19,
        "c": 0.2,
        "d": 100.0,
        "e": 0.00012345,
        "f": 1e-9,
        "g": 12345,
    }
    shown = [line.split(": ")[1] for line in as_lines(facts).splitlines()]
    assert shown == ["147.9", "20110", "0.2", "100", "0.0001234", "1e-09", "12345"]
    assert as_lines({"size_mm": [80.00001, 2.0, 30.55555]}) == "size_mm: 80, 2, 30.56"


def test_what_was_not_done_is_no():
    assert as_lines({"resurfaced": None, "knobs": True, "notes": [], "core": {}}) == (
        "resurfaced: no\nknobs: yes\nnotes: none\ncore: none"
    )
    assert as_lines({"a": {"b": None}}, missing="not measured") == "a:\n  b: not measured"


def test_somebody_elses_text_moves_no_cursor():
    assert as_lines({"file": "a\x1b[31m\nb\u202e\x9b.stl"}) == r"file: a\x1b[31m\nb\u202e\x9b.stl"
    assert as_lines({"file": "模型-Ελλάδα"}) == "file: 模型-Ελλάδα"
