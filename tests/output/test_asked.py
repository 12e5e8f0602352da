import json

import pytest

from meshjig.errors import InputError
from meshjig.output.asked import Asked, read_asked

PIECES = [{"id": 1, "neighbours": [2, 3]}, {"id": 2, "neighbours": [1]}, {"id": 3, "neighbours": [1]}]
NAMES = ["piece_001", "piece_002", "piece_003"]


def folder_of(path, **report):
    (path / "report.json").write_text(json.dumps(report))
    return path


def test_a_report_tells_what_was_asked_for_and_who_are_neighbours(tmp_path):
    folder = folder_of(
        tmp_path,
        options={"thickness": 3.0, "clearance": 0.1, "min_wall": 0.8, "seed": 5},
        pieces=PIECES,
        exempt_pieces=["piece_002"],
    )
    assert read_asked(folder, NAMES) == Asked([(0, 1), (0, 2)], 3.0, 0.1, 0.8, ("piece_002",))
    assert read_asked([folder], NAMES[::-1]).neighbours == [(0, 2), (1, 2)]  # in the order of the files
    assert read_asked(folder, NAMES[:2]).neighbours == [(0, 1)]  # a piece was lost


def test_pieces_by_other_names_have_no_known_neighbours(tmp_path):
    folder = folder_of(tmp_path, options={}, pieces=PIECES)
    assert read_asked(folder, ["left", "right"]) == Asked()


def test_files_without_a_report_tell_nothing(tmp_path):
    assert read_asked(tmp_path, NAMES) == Asked()
    assert read_asked([tmp_path / "a.stl", tmp_path / "b.stl"], ["a", "b"]) == Asked()


@pytest.mark.parametrize("text", ["", "[]", '{"pieces": []}', '{"options": {}, "pieces": [{"id": 1}]}'])
def test_a_damaged_report_gets_one_sentence(text, tmp_path):
    (tmp_path / "report.json").write_text(text)
    with pytest.raises(InputError, match="damaged: remove it"):
        read_asked(tmp_path, NAMES)
