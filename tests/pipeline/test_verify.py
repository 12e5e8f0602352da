"""Pieces that stand too near to a neighbour are found by the verdict, and mended."""

import numpy as np
import pytest
import trimesh

from meshjig.mesh.pieces import Pieces
from meshjig.options import Options
from meshjig.pipeline.verify import Mended, verify

NAMES = ("one", "other")
PAIR = np.array([[0, 1]])


@pytest.fixture(scope="module")
def boxes():
    """Two boxes 1 mm apart, and a ball grown out of one, 0.1 mm from the other."""
    first = trimesh.creation.box(bounds=[[0, 0, 0], [4, 10, 2]])
    ball = trimesh.creation.icosphere(2, 0.5).apply_translation([4.4, 5, 1])
    first = trimesh.boolean.union([first, ball], engine="manifold")
    other = trimesh.creation.box(bounds=[[5, 0, 0], [9, 10, 2]])
    return Pieces.of(
        [(name, mesh.vertices, mesh.faces) for name, mesh in zip(NAMES, (first, other), strict=True)], PAIR
    )


def test_pieces_nearer_than_the_gap_are_dented_until_the_verdict_is_content(boxes):
    solids, verdict, facts = verify(boxes, Options(clearance=0.2), [])
    assert facts == Mended(dented=[0, 1])  # nothing has come off
    assert verdict.checks["gap_mm"]["min"] >= 0.97 * 0.2
    assert not verdict.near
    assert all(len(V) > len(W) for (V, _), (W, _) in zip(solids, boxes, strict=True))


def test_pieces_that_keep_the_gap_are_left_as_they_are(boxes):
    solids, verdict, facts = verify(boxes, Options(clearance=0.1), [])
    assert solids is boxes
    assert facts == Mended()
    assert "gap_mm" not in verdict.failures


def test_gaps_of_the_plane_are_judged_but_not_mended(boxes):
    solids, verdict, _ = verify(boxes, Options(clearance=0.2, clearance_method="stretch"), [])
    assert solids is boxes
    assert verdict.failures["gap_mm"] == list(NAMES)
