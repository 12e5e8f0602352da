"""What comes after the solids knows pieces that reach through: both their sides are seen."""

from types import SimpleNamespace

import numpy as np
import pytest
import trimesh

from meshjig import make_puzzle
from meshjig.mesh.measure import area_vectors, mesh_volume, unit
from meshjig.mesh.mesh import Mesh
from meshjig.options import Options
from meshjig.pipeline.ground import surface_to_lay_out
from meshjig.pipeline.make import _outer_normals
from meshjig.pipeline.plan import plan_puzzle
from meshjig.pipeline.through import solid_parts
from meshjig.solid import shell
from tests.thin.shapes import ear, plate

THICK = 5.0
RED, BLUE = (220, 30, 30), (30, 30, 220)
ASKED = {"pieces": 4, "size": 40, "thickness": 1.5, "through": 8.0, "process": "sla"}


@pytest.fixture(scope="module")
def puzzle():
    V, F = plate(40, 30, THICK, 1.6)
    shown = np.where(V[:, 2:] > 0, RED, BLUE).astype(np.uint8)
    both = trimesh.Trimesh(V, F, process=False, vertex_colors=np.c_[shown, np.full(len(V), 255)])
    made = make_puzzle(both, **ASKED, labels=True)
    assert made.report["ok"], made.report["failures"]
    assert made.report["through"]["pieces"] == [piece.name for piece in made.pieces]
    return made


def test_both_sides_of_a_thin_part_show_the_colours_of_the_scan(puzzle):
    for piece in puzzle.pieces:
        A = area_vectors(piece.V, piece.F)
        normal, middle = unit(A), piece.V[piece.F].mean(axis=1)
        for sign, colour in ((1, RED), (-1, BLUE)):
            side = (sign * normal[:, 2] > 0.9) & (sign * middle[:, 2] > 0.45 * THICK)
            assert piece.texture.outer[side].mean() > 0.99
            shown = piece.texture.rgb[side & piece.texture.outer].mean(axis=1)
            assert np.abs(shown - np.array(colour) / 255).max() < 0.02
        inside = (np.abs(middle[:, :2]) < [16, 11]).all(axis=1) & (np.abs(normal[:, 2]) < 0.3)
        assert inside.any()
        assert not piece.texture.outer[inside].any()
        assert np.ptp(piece.texture.rgb[inside].reshape(-1, 3), axis=0).max() < 1e-6


def test_labels_stand_on_walls_and_both_sides_stay_whole(puzzle):
    facts = puzzle.report["labels"]
    assert facts["engraved"] >= 3
    assert len(facts["on_walls"]) == facts["engraved"]
    bare = make_puzzle(plate(40, 30, THICK, 1.6), **ASKED)
    for piece, old in zip(puzzle.pieces, bare.pieces, strict=True):
        assert flat_area(piece) == pytest.approx(flat_area(old), rel=1e-3)
        lettered = str(int(piece.name[-3:])) in facts["on_walls"]
        taken = mesh_volume(old.V, old.F) - mesh_volume(piece.V, piece.F)
        assert (taken > 0.2) == lettered


def flat_area(piece):
    """Give the area of both sides, mm2."""
    on = (np.abs(np.abs(piece.V[:, 2]) - THICK / 2) < 1e-3)[piece.F].all(axis=1)
    return Mesh(piece.V, piece.F).areas[on].sum()


def test_what_lies_between_both_sides_is_nearly_all_of_a_plate():
    surface = Mesh(*plate(60, 40, 3.0, 1.6))
    ground = surface_to_lay_out(surface, Options.of(pieces=8, thickness=1.0, through=6.0))
    between = solid_parts(ground, shell(*ground.surface, 1.0))
    assert 0.85 < mesh_volume(*between) / mesh_volume(*surface) < 1.0
    thick = surface_to_lay_out(surface, Options.of(pieces=8, thickness=1.0, through="off"))
    assert solid_parts(thick, shell(*surface, 1.0)) is None


@pytest.mark.slow
def test_a_core_ends_where_an_ear_is_cut_through():
    made = make_puzzle(
        ear(thick=8.0, cell=1.3),
        pieces=10,
        size=41,
        thickness=1.0,
        through=8.0,
        process="sla",
        core=True,
        assembly="off",
    )
    assert set(made.report["failures"]) <= {"thin_walls"}, made.report["failures"]
    assert made.report["core"]["gap_mm"] >= 0.95 * 0.15
    [part] = made.core
    assert part.V[:, 2].max() < 6.0  # with --through off it reaches 16 mm into the ear
    assert part.V[:, 2].min() < -12.0


def test_a_plan_counts_one_side_of_thin_parts_only():
    asked = {"piece_size": 12.0, "size": 60, "thickness": 1.0, "process": "sla"}
    mesh = plate(60, 40, 3.0, 1.6)
    through, skins = (
        plan_puzzle(mesh, Options.of(**asked, through=value))["pieces"] for value in (6.0, "off")
    )
    assert skins > 1.7 * through


def test_the_outer_side_of_a_piece_is_the_one_that_it_was_laid_out_on():
    """Of a small ear that was laid out all around, too: its far side was taken away afterwards."""
    surface = Mesh(*plate(60, 40, 3.0, 1.6))
    piece = (surface.area_vectors[:, 2] > 0).astype(np.int64) - 1
    layout = SimpleNamespace(cut=surface, stitching=SimpleNamespace(n_pieces=1))
    [outward] = _outer_normals(layout, piece)
    assert outward[2] == pytest.approx(60 * 40, rel=0.1)
    assert np.abs(outward[:2]).max() < 0.01 * outward[2]
