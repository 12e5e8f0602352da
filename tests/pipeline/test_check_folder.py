"""What a folder's report says of thin parts is allowed for, and no more."""

import json

import pytest

from meshjig.output.files.mesh_files import write_stl
from meshjig.pipeline.check_folder import check_folder
from tests.check.pieces import box


@pytest.fixture
def folder(tmp_path):
    """Two plates 1 mm thick and one of 4, and a report of a model that is thin below the first one."""
    (tmp_path / "pieces").mkdir()
    for i, thick in enumerate((1, 1, 4)):
        write_stl(tmp_path / f"pieces/piece_{i + 1:03d}.stl", *box([30 * i, 0, 0], [30 * i + 20, 20, thick]))
    report = {
        "options": {"min_wall": 1.2},
        "pieces": [{"id": i, "neighbours": []} for i in (1, 2, 3)],
        "through": {"pieces": ["piece_003"], "model_thin": {"piece_001": 1.0}},
    }
    (tmp_path / "report.json").write_text(json.dumps(report))
    return tmp_path


def test_what_is_thin_because_the_model_is_breaks_no_promise(folder):
    assert check_folder([folder], {})["failures"] == {"thin_walls": ["piece_002"]}


def test_what_was_found_with_another_least_wall_is_not_allowed_for(folder):
    failures = check_folder([folder], {"min_wall": 1.1})["failures"]
    assert failures == {"thin_walls": ["piece_001", "piece_002"]}


def test_pieces_that_reach_through_need_not_be_as_thick_as_others(folder):
    thickness = check_folder([folder], {"thickness": 1.0})["checks"]["thickness_mm"]
    assert thickness["median"] == pytest.approx(1.0)
    assert thickness["p1"] == pytest.approx(1.0)
