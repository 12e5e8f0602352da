"""The page on the report names every field that reports have."""

import json
import re

import pytest

import meshjig
from meshjig.pipeline.coupon import save_coupon
from tests.docs.blocks import ROOT
from tests.meshes import open_cup, sphere

# what is below has names of other things
FREE = {"options", "files", "failures", "exempt", "skipped", "motions", "laid_out_mm3", "held_by"}

PAGE = (ROOT / "docs" / "report.md").read_text(encoding="utf-8")
TOLD = set(re.findall(r"`([a-z_0-9]+)`", PAGE))


def fields(report):
    """List the names of all fields, at any depth."""
    if isinstance(report, list):
        return set().union(*map(fields, report))
    if not isinstance(report, dict):
        return set()
    return set(report).union(*(fields(value) for key, value in report.items() if key not in FREE))


@pytest.mark.slow
def test_every_field_is_explained(tmp_path):
    vase, ball, cup = ROOT / "data" / "vase.ply", sphere(600), open_cup(1500)
    full = meshjig.make_puzzle(ball, pieces=6, core=True, plate="220x220", format="stl")
    full.save(tmp_path / "full", viewer=False, guide=False, preview=False)
    reports = [json.loads((tmp_path / "full" / "report.json").read_text())]
    reports.append(meshjig.make_puzzle(cup, pieces=6, charts="periodic", assembly="off").report)
    reports.append(meshjig.make_puzzle(cup, pieces=6, layout="tiles", clearance_method="stretch").report)
    reports.append(meshjig.make_puzzle(vase, pieces=12, faces=3000, labels=True, unique=True).report)
    reports.append(save_coupon(tmp_path / "coupon", meshjig.Options()))
    missing = set().union(*map(fields, reports)) - TOLD
    assert not missing
    assert set(reports[0]["assembly"]["motions"]["1"]) <= TOLD
    assert "poles" in fields(reports[1]["stitching"])


def test_fields_that_come_seldom_are_explained():
    seldom = (
        "cell_mm off_mm capped_area_share lost_area_share join_cell joined_share why thin_limbs turntable"
    )
    assert set(seldom.split()) <= TOLD
