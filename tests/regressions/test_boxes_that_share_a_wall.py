"""Cubes that share a wall, or an edge, once gave a ValueError, or pieces that crossed with exit code 0."""

import numpy as np
import pytest

from meshjig import make_puzzle
from meshjig.mesh.components import components
from meshjig.options import Options
from meshjig.pipeline.prepare import clean_scan
from tests.meshes import Shape
from tests.scan.boxes import box, welded, without_wall


def pair(at, wall, parts=6):
    """Two cubes of 30 mm; the wall between them is there once, twice or not at all."""
    first, second = box(parts=parts), box(at, parts=parts)
    if wall < 2:
        second = without_wall(second, 0.5)
    if wall < 1:
        first = without_wall(first, 0.5)
    V, F = welded(first, second)
    return Shape(30.0 * V, F)


@pytest.mark.parametrize(
    ("at", "wall", "bodies"),
    [((1, 0, 0), 2, 2), ((1, 0, 0), 1, 2), ((1, 0, 0), 0, 1), ((1, 1, 0), 2, 2)],
    ids=["a wall, twice", "a wall, once", "no wall", "an edge"],
)
@pytest.mark.parametrize(("pieces", "assembly"), [(2, "any"), (8, "off")])
def test_pieces_of_boxes_that_touch_are_sound(at, wall, bodies, pieces, assembly):
    mesh = pair(at, wall)
    report = make_puzzle(mesh, pieces=pieces, assembly=assembly).report
    checks, read = report["checks"], report["input"]
    assert (read["components"], read["borders"], read["self_crossings"]) == (bodies, 0, 0)
    assert report["ok"], report["failures"]
    assert report["exempt"] == {}
    assert checks["closed"] is True
    assert (checks["self_intersections"], checks["overlap_mm3"]) == (0, 0)
    assert checks["gap_mm"]["min"] >= 0.95 * 0.2
    assert len(report["pieces"]) >= max(pieces, 2 * bodies)


def test_a_coarse_pair_in_two_pieces_each_keeps_its_gap():
    report = make_puzzle(pair((1, 0, 0), 2, parts=4), pieces=2).report
    assert report["ok"], report["failures"]


def test_the_note_names_the_place_where_bodies_touch():
    notes = clean_scan(pair((1, 1, 0), 2), Options.of()).facts.notes
    assert any("touch each other (first at (15, 15," in note for note in notes), notes


def test_bodies_stay_apart_in_what_is_made():
    puzzle = make_puzzle(pair((1, 0, 0), 2), pieces=8)
    whole = [piece.mesh for piece in puzzle.pieces]
    assert all(mesh.is_watertight for mesh in whole)
    left = np.array([mesh.bounds[1, 0] < 15 for mesh in whole])
    right = np.array([mesh.bounds[0, 0] > 15 for mesh in whole])
    assert (left ^ right).all()
    assert max(m.bounds[1, 0] for m, k in zip(whole, left, strict=True) if k) <= 15 - 0.99 * 0.1
    assert all(components(piece.F)[0] == 1 for piece in puzzle.pieces)
