"""The outside judge of thin parts finds what is wrong with a plate that was cut by hand."""

import json
import re
import subprocess
import sys

import numpy as np
import pytest
import trimesh

from meshjig.mesh.mesh import Mesh
from tests.docs.blocks import ROOT
from tests.thin.trial import Model, lost_volume, thin_share, uncovered

GAP, THICK = 0.2, 3.0
ASKED = {"size": 60.0, "side": "in", "thickness": 2.0, "clearance": GAP, "min_wall": 1.2}


def box(low, high):
    solid = trimesh.creation.box(bounds=[low, high]).subdivide().subdivide()
    return Mesh(np.asarray(solid.vertices, float), np.asarray(solid.faces, np.int64))


def pieces(bottom=0.0, top=THICK, gap=GAP):
    """Cut a plate of 60 x 40 x 3 mm into six; each reaches from one height to another."""
    g = gap / 2
    return [
        box([x + g * (x > 0), y + g * (y > 0), bottom], [x + 20 - g * (x < 40), y + 20 - g * (y < 20), top])
        for x in (0, 20, 40)
        for y in (0, 20)
    ]


@pytest.fixture(scope="module")
def plate(tmp_path_factory):
    path = tmp_path_factory.mktemp("plate") / "plate.ply"
    whole = box([0, 0, 0], [60, 40, THICK])
    trimesh.Trimesh(whole.V, whole.F, process=False).export(path)
    return path


@pytest.fixture(scope="module")
def model(plate):
    made = Model.of(plate, ASKED)
    assert np.allclose(np.ptp(made.mesh.V, axis=0), [60, 40, THICK])
    return made


def test_pieces_that_reach_through_are_right(model):
    cut = pieces()
    thin = thin_share(model, cut, 1.2)
    assert thin.share == 0
    assert thin.pardoned == 0
    assert uncovered(model, cut, GAP).share == 0
    lost = lost_volume(model, cut, GAP, 5.0)
    assert lost.share == 0
    assert lost.samples == 20_000
    assert lost.part == pytest.approx(4800 / 5400)


def test_two_skins_are_thin_and_lose_what_is_between_them(model):
    skins = [*pieces(top=0.5), *pieces(bottom=2.5)]
    thin = thin_share(model, skins, 1.2)
    assert thin.sheets > 0.9
    assert thin.flat == thin.share
    assert thin.thinnest == pytest.approx(0.5, abs=1e-3)
    beside = 200 * (2 - 2 * 0.75 * GAP) / 5400  # on the plate's narrow sides
    assert uncovered(model, skins, GAP).share == pytest.approx(beside, rel=0.1)
    assert lost_volume(model, skins, GAP, 5.0).share == pytest.approx(2 / 3, abs=0.02)


def test_what_is_thin_beside_a_sharp_edge_is_told_from_a_skin(model):
    outline = [[0, 0], [40, 0], [40, THICK], [THICK, THICK]]  # y, z: 45 degrees at the origin
    solid = trimesh.convex.convex_hull([[x, *corner] for x in (0, 60) for corner in outline])
    found = thin_share(model, [Mesh(np.asarray(solid.vertices), np.asarray(solid.faces, np.int64))], 1.2)
    assert found.sheets == pytest.approx(2 * 60 * 1.08 / solid.area, rel=0.1)
    assert found.flat < 1e-3  # at the very edge, rays start outside


def test_a_skin_thinner_than_rays_can_tell_counts_too(model):
    assert thin_share(model, pieces(top=2e-5), 1.2).sheets > 0.9


def test_a_lamella_inside_touches_no_surface(model):
    found = thin_share(model, [*pieces(), *pieces(1.0, 1.3)], 1.2)
    assert found.sheets == 0
    assert found.inside > 0.3


def test_what_the_model_has_thin_itself_is_pardoned(model):
    found = thin_share(model, pieces(), 4.0)  # as if 4 mm were the least
    assert found.share == 0
    assert found.pardoned > 0.7
    skins = thin_share(model, pieces(top=2.5), 3.2)  # the model is as thin, but not the last half of a mm
    assert skins.share == 0


def test_a_piece_that_is_missing_is_missed(model):
    found = uncovered(model, pieces()[1:], GAP)
    assert found.share == pytest.approx(1 / 6, abs=0.02)
    assert 8 < found.farthest < 25
    assert lost_volume(model, pieces()[1:], GAP, 5.0).share == pytest.approx(1 / 6, abs=0.015)


def test_a_gap_that_is_too_wide_is_no_gap(model):
    apart = pieces(gap=0.7)
    assert uncovered(model, apart, GAP).share == pytest.approx(0.022, rel=0.1)  # strips of 0.4 mm
    assert lost_volume(model, apart, GAP, 5.0).share == pytest.approx(0.0404, rel=0.15)  # of 0.7 mm


def test_a_folder_is_judged_and_drawn(plate, tmp_path):
    (tmp_path / "made" / "pieces").mkdir(parents=True)
    cut = pieces()[1:]
    for i, piece in enumerate(cut):
        name = f"piece_{i + 1:03d}.stl"
        trimesh.Trimesh(piece.V, piece.F, process=False).export(tmp_path / "made" / "pieces" / name)
    report = {"meshjig": "0", "options": ASKED, "ok": True, "failures": {}, "checks": {"thin_walls": 0}}
    report |= {"input": {"file": str(plate)}, "pieces": [{"id": i + 1} for i in range(len(cut))]}
    report |= {"through": {"limit_mm": 5.0}}
    (tmp_path / "made" / "report.json").write_text(json.dumps(report), encoding="utf-8")
    command = [sys.executable, str(ROOT / "scripts/thin_trial.py"), str(tmp_path / "made")]
    command += ["--pictures", str(tmp_path / "drawn")]
    said = subprocess.run(command, capture_output=True, encoding="utf-8", check=False)
    assert said.returncode == 1, said.stderr  # a sixth is lost
    assert said.stdout.startswith("made ")
    assert "ok; 5 pieces, 0 with thin walls" in said.stdout
    assert "thin 0.000%" in said.stdout
    assert float(re.search(r"uncovered (.*?)%", said.stdout)[1]) == pytest.approx(100 / 6, abs=2)
    assert (tmp_path / "drawn" / "made.png").stat().st_size > 10_000
