"""The library as a programmer meets it."""

from pathlib import Path

import numpy as np
import pytest
import trimesh

import meshjig
from meshjig.output.files.read_pieces import read_pieces
from tests.meshes import open_cup, sphere, two_components


@pytest.fixture(scope="module")
def cup():
    return meshjig.make_puzzle(open_cup(3000), pieces=30)


def test_a_puzzle_has_its_pieces_and_report(cup):
    assert len(cup.pieces) == len(cup.report["pieces"]) == pytest.approx(30, abs=3)
    assert isinstance(cup.pieces[0].mesh, trimesh.Trimesh)
    assert all(piece.mesh.is_watertight for piece in cup.pieces)
    assert [piece.id for piece in cup.pieces] == [row["id"] for row in cup.report["pieces"]]
    assert cup.report["checks"]["area_error"] < 1e-6


def test_no_knob_leaves_the_open_border(cup):
    # the knobs on a piece at the rim join neighbours: none is cut off by the rim to be a piece of its own
    area = np.array([piece["area_mm2"] for piece in cup.report["pieces"]])
    assert area.min() > 0.25 * area.mean()
    assert cup.report["stitching"]["tiny_left"] == 0


def test_saving_and_loading_gives_the_same_puzzle(cup, tmp_path):
    again = meshjig.Puzzle.load(cup.save(tmp_path / "cup", formats=("stl",), preview=False))
    assert len(again.pieces) == len(cup.pieces)
    for a, b in zip(again.pieces, cup.pieces, strict=True):
        assert (a.id, a.name) == (b.id, b.name)
        assert a.mesh.volume == pytest.approx(b.mesh.volume, rel=1e-6)
    neighbours = [[piece["neighbours"] for piece in p.report["pieces"]] for p in (again, cup)]
    assert neighbours[0] == neighbours[1]


def test_what_is_asked_to_be_up_is_up_in_files_that_have_a_way_up(tmp_path):
    V, F = sphere(500)
    puzzle = meshjig.make_puzzle((V * [1, 1, 2], F), size=60, pieces=6, up="z")
    assert puzzle.report["up"] == [0, 0, 1]
    folder = puzzle.save(tmp_path / "egg", formats=("glb", "ply"), preview=False, viewer=False, guide=False)
    low, high = trimesh.load_scene(folder / "puzzle.glb").bounds
    np.testing.assert_allclose(1000 * (high - low), [30, 60, 30], rtol=0.02)
    (_, W, G), *_ = read_pieces(folder / "puzzle.glb")
    np.testing.assert_allclose(
        W[G].mean(axis=(0, 1)), puzzle.pieces[0].mesh.triangles.mean(axis=(0, 1)), atol=1e-3
    )


@pytest.mark.parametrize("source", ["arrays", "trimesh", "path"])
def test_meshes_come_as_arrays_objects_and_files(source, tmp_path):
    V, F = sphere(1000)
    mesh = trimesh.Trimesh(V, F, process=False)
    if source == "path":
        mesh.export(tmp_path / "ball.ply")
    given = {"arrays": (V, F), "trimesh": mesh, "path": tmp_path / "ball.ply"}[source]
    assert len(meshjig.make_puzzle(given, pieces=10, assembly="off").pieces) == pytest.approx(10, abs=1)


@pytest.mark.parametrize(("layout", "second"), [("cells", "cells"), ("tiles", "charts")])
def test_progress_names_the_stages(layout, second):
    heard = []

    def hear(stage, event):
        heard.append((stage, event))

    meshjig.make_puzzle(sphere(1000), pieces=8, layout=layout, progress=hear)
    started = [stage for stage, event in heard if event == "start"]
    assert started[:2] == ["scan", second]
    assert started[-1] == "check"
    assert len(heard) == 2 * len(started)


def test_components_become_separate_pieces():
    puzzle = meshjig.make_puzzle(two_components(2000), pieces=20, assembly="off")
    neighbours = {p["id"]: p["neighbours"] for p in puzzle.report["pieces"]}
    seen, todo = set(), [1]
    while todo:
        piece = todo.pop()
        if piece not in seen:
            seen.add(piece)
            todo += neighbours[piece]
    assert 0 < len(seen) < len(puzzle.pieces)


@pytest.mark.parametrize("charts", ["lscm", "arap", "slim", "xatlas"])
def test_every_way_to_make_charts_makes_a_puzzle(charts):
    puzzle = meshjig.make_puzzle(sphere(2000), pieces=20, charts=charts, assembly="off")
    assert puzzle.report["charts"]["method"] == charts
    assert puzzle.report["checks"]["closed"] is True
    assert puzzle.report["checks"]["area_error"] < 1e-6


def test_rectangular_tiles_make_a_puzzle():
    puzzle = meshjig.make_puzzle(sphere(2000), pieces=20, tile="rectangular")
    assert puzzle.report["checks"]["head_neck"]["median"] > 1.4


def test_zero_clearance_cuts_without_a_gap():
    puzzle = meshjig.make_puzzle(sphere(1000), pieces=8, clearance=0.0)
    shell = 4 / 3 * np.pi * (50**3 - 48**3)
    assert sum(piece.mesh.volume for piece in puzzle.pieces) == pytest.approx(shell, rel=0.03)


def test_unknown_keywords_are_refused():
    with pytest.raises(meshjig.OptionError, match="color"):
        meshjig.make_puzzle(sphere(500), color="red")


def test_an_atlas_maps_points_and_curves():
    atlas = meshjig.build_atlas(meshjig.read_scan(sphere(1000), size=100).mesh)
    middle = atlas.uv[atlas.F_uv[0]].mean(0)
    face, bary, xyz = atlas.lift(int(atlas.chart_of_face[0]), middle[None])
    assert face.tolist() == [0]
    np.testing.assert_allclose(bary, 1 / 3)
    np.testing.assert_allclose(xyz[0], atlas.mesh.V[atlas.mesh.F[0]].mean(0))
    far = atlas.uv[atlas.F_uv[atlas.chart_of_face == atlas.chart_of_face[0]]].reshape(-1, 2).mean(0)
    lines = atlas.curve(int(atlas.chart_of_face[0]), np.array([middle, far]))
    np.testing.assert_allclose(lines[0][0], xyz[0], atol=1e-9)
    length = sum(np.linalg.norm(np.diff(line, axis=0), axis=1).sum() for line in lines)
    assert length == pytest.approx(np.linalg.norm(far - middle), rel=0.3)
    assert len(atlas.trimming_curves()) > 1


@pytest.mark.parametrize(
    ("method", "measure", "least"), [("solid", "gap_mm", 0.995), ("stretch", "gap_outer_mm", 0.99)]
)
def test_the_vase_keeps_its_gap(method, measure, least):
    vase = Path(__file__).parent.parent.parent / "data" / "vase.ply"
    puzzle = meshjig.make_puzzle(vase, size=150, pieces=60, clearance_method=method)
    assert puzzle.report["checks"][measure]["within_10pct"] > least
    if method == "solid":
        assert puzzle.report["failures"] == {}
