"""A plan says beforehand what the puzzle comes to."""

import pytest

from meshjig import make_puzzle
from meshjig.errors import OptionError, SolidError
from meshjig.options import Options
from meshjig.pipeline.plan import plan_puzzle
from tests.meshes import disc, joined, moved, sphere

ASKED = {"pieces": 24, "size": 100, "plate": "120x120"}


def test_plan_is_near_to_what_is_made(tmp_path):
    plan = plan_puzzle(sphere(3000), Options.of(**ASKED))
    report = make_puzzle(sphere(3000), **ASKED, assembly="off").report
    assert plan["pieces"] == pytest.approx(len(report["pieces"]), abs=1)
    assert plan["model"]["area_mm2"] == pytest.approx(sum(p["area_mm2"] for p in report["pieces"]), rel=1e-3)
    volume = sum(piece["volume_mm3"] for piece in report["pieces"])
    assert plan["material"]["volume_mm3"] == pytest.approx(volume, rel=0.1)
    assert max(plan["model"]["size_mm"]) == pytest.approx(100)


def test_smaller_plates_are_more():
    counts = [
        plan_puzzle(sphere(2000), Options.of(**ASKED | {"plate": p}))["plates"] for p in ("90x90", "300x300")
    ]
    assert counts[0] > counts[1] >= 1


def test_what_would_be_refused_is_refused():
    with pytest.raises(OptionError, match="too narrow"):
        plan_puzzle(sphere(2000), Options.of(pieces=9000, size=40))
    for plate in ("nowhere", "5x5", "4x200"):
        with pytest.raises(OptionError, match="plate"):
            plan_puzzle(sphere(2000), Options.of(plate=plate))


def test_core_and_units_are_told_and_count():
    bare, with_core = (plan_puzzle(sphere(2000), Options.of(**ASKED, core=core)) for core in (False, True))
    assert "mm" in bare["model"]["units"]
    assert "core" not in bare
    core = with_core["core"]["volume_mm3"]
    assert core > 0
    grown = with_core["material"]["volume_mm3"] - bare["material"]["volume_mm3"]
    assert grown == pytest.approx(core, rel=1e-6)
    assert with_core["plates"] > bare["plates"]


def test_what_has_no_room_is_refused():
    with pytest.raises(SolidError, match="too thick"):
        plan_puzzle(sphere(2000), Options.of(thickness=50))
    with pytest.raises(SolidError, match="core"):
        plan_puzzle(disc(400), Options.of(pieces=8, core=True))


def test_a_plan_tells_the_notes_of_the_scan_and_that_one_body_has_the_core():
    two = joined(sphere(800), moved(sphere(800, 30.0), [100.0, 0.0, 0.0]))
    plan = plan_puzzle(tuple(two), Options.of(pieces=8, core=True))
    assert any("core is made for the largest of 2 bodies" in note for note in plan["notes"])
    assert not plan_puzzle(tuple(two), Options.of(pieces=8))["notes"]


def test_there_are_no_more_plates_than_pieces():
    V, F = sphere(800)
    plan = plan_puzzle((V, F), Options.of(pieces=12, size=300.0, plate="150x150"))
    assert plan["plates"] <= plan["pieces"]
