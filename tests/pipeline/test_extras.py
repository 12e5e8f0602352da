"""Labels and a core, from the options to the files and back."""

import json
import shutil

import pytest
from PIL import Image

from meshjig import Puzzle, make_puzzle
from meshjig.extras.core import CoreFacts
from meshjig.mesh.measure import mesh_volume
from meshjig.mesh.mesh import Mesh
from meshjig.mesh.pieces import Pieces
from meshjig.options import Options
from meshjig.output.piece import Piece
from meshjig.pipeline.check_folder import check_folder
from meshjig.pipeline.extras import Core, verify_core
from tests.meshes import moved, sphere

N = 20
ASKED = {"pieces": N, "size": 90, "clearance": 0.3}


@pytest.fixture(scope="module")
def plain():
    return make_puzzle(sphere(3000), **ASKED)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    puzzle = make_puzzle(sphere(3000), **ASKED, labels=True, core=True, turntable=True, plate="72x72")
    return puzzle.save(tmp_path_factory.mktemp("out") / "ball", ("stl", "glb"), viewer=False, preview=False)


@pytest.fixture(scope="module")
def report(folder):
    return json.loads((folder / "report.json").read_text())


def test_labels_take_material_and_break_no_promise(plain, report):
    assert report["ok"]
    assert report["failures"] == {}
    assert report["labels"]["engraved"] + len(report["labels"]["skipped"]) == N
    assert report["labels"]["engraved"] > N / 2
    bare = sum(mesh_volume(piece.V, piece.F) for piece in plain.pieces)
    lettered = sum(piece["volume_mm3"] for piece in report["pieces"])
    assert 0.95 * bare < lettered < 0.9999 * bare
    assert "labels" not in plain.report


def test_core_is_written_in_parts_that_fit_and_keeps_its_gap(folder, report):
    parts = sorted(path.name for path in (folder / "core").iterdir())
    assert parts == [f"core_{i + 1}.stl" for i in range(report["core"]["parts"])]
    assert len(parts) > 1  # 90 mm on a plate of 72
    assert report["core"]["gap_mm"] >= 0.95 * 0.3
    assert report["core"]["overlap_mm3"] == 0


def test_files_are_judged_with_their_core(folder):
    found = check_folder([folder], {})
    assert found["ok"], found["failures"]
    assert found["core"]["gap_mm"] >= 0.95 * 0.3
    stricter = check_folder([folder], {"clearance": 0.8})
    assert any(name.startswith("core_") for name in stricter["failures"]["gap_mm"])


def test_turntable_turns(folder):
    with Image.open(folder / "turntable.gif") as picture:
        assert picture.n_frames > 20
        first = picture.convert("RGB").tobytes()
        picture.seek(picture.n_frames // 4)
        assert picture.convert("RGB").tobytes() != first


def test_exploded_scene_is_larger(folder):
    import trimesh

    whole, apart = (trimesh.load(folder / f"{name}.glb").extents for name in ("puzzle", "exploded"))
    assert (apart > 1.3 * whole).all()


def test_a_puzzle_keeps_its_core_when_loaded_and_saved(folder, report, tmp_path):
    again = Puzzle.load(folder).save(tmp_path / "again", ("stl",), viewer=False, preview=False, guide=False)
    assert len(list((again / "core").iterdir())) == report["core"]["parts"]


def test_what_the_report_lists_and_no_file_holds_is_missing(folder, tmp_path):
    copy = tmp_path / "copy"
    shutil.copytree(folder, copy)
    (copy / "pieces/piece_003.stl").unlink()
    (copy / "core/core_1.stl").unlink()
    found = check_folder([copy], {})
    assert not found["ok"]
    assert found["failures"]["missing"] == ["core_1", "piece_003"]


def test_a_core_yields_where_a_piece_comes_too_near():
    near = Mesh(*moved(sphere(800, 10.0), [19.9, 0, 0]))  # it reaches 0.1 mm into the core
    V, F = sphere(800, 10.0)
    part = Piece("core_1", V, F, (0.6, 0.6, 0.6))
    facts = CoreFacts(1, float(mesh_volume(V, F)), 0, 0, 0.0, 0.0)
    core = verify_core(Core([part], facts), Pieces(("piece_001",), (near,)), Options.of(), [])
    assert core.failures == {}
    assert core.checks.gap_mm >= 0.95 * 0.2
    assert core.facts.volume_mm3 < facts.volume_mm3
    assert core.facts.volume_mm3 == pytest.approx(mesh_volume(core.parts[0].V, core.parts[0].F))
