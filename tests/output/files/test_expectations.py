import pytest

from meshjig.errors import InputError
from meshjig.output.files.expectations import Asked, read_asked, read_missing

PIECES = [{"id": 1, "neighbours": [2, 3]}, {"id": 2, "neighbours": [1]}, {"id": 3, "neighbours": [1]}]
NAMES = ["piece_001", "piece_002", "piece_003"]


def test_a_report_tells_what_was_asked_for_and_who_are_neighbours():
    report = dict(
        options={"thickness": 3.0, "clearance": 0.1, "min_wall": 0.8, "seed": 5},
        pieces=PIECES,
        exempt_pieces=["piece_002"],
    )
    assert read_asked(report, NAMES) == Asked([(0, 1), (0, 2)], 3.0, 0.1, 0.8, ("piece_002",))
    assert read_asked(report, NAMES[::-1]).neighbours == [(0, 2), (1, 2)]  # in the order of the files
    assert read_asked(report, NAMES[:2]).neighbours == [(0, 1)]  # a piece was lost


def test_pieces_by_other_names_have_no_known_neighbours():
    report = {"options": {}, "pieces": PIECES}
    assert read_asked(report, ["left", "right"]) == Asked()


def test_files_without_a_report_tell_nothing():
    assert read_asked(None, NAMES) == Asked()
    assert read_missing(None, NAMES) == []


@pytest.mark.parametrize("report", [{"pieces": []}, {"options": {}, "pieces": [{"id": 1}]}])
def test_a_damaged_report_gets_one_sentence(report):
    with pytest.raises(InputError, match="damaged: remove it"):
        read_asked(report, NAMES)
