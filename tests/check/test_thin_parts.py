"""Thin walls: a thousandth of a piece is found, and skins back to back; what is thin as the model is not."""

import itertools

import manifold3d
import numpy as np
import pytest

from meshjig.check import ThinParts, judge
from meshjig.mesh.mesh import Mesh
from tests.check.pieces import box
from tests.meshes import moved

LEAST = 1.2


def dented(k, width=60):
    """Make a plate 2 mm thick that is 1 mm thick over a square of k - 1 mm."""
    V, F = box([0, 0, 0], [width, width, 2], width)
    low, high = 30 - 0.1, 30 + k - 0.9
    V[((low < V[:, :2]) & (V[:, :2] < high)).all(1) & (V[:, 2] > 1.9), 2] = 1.0
    return V, F


def step(thin, thick):
    """Make a plate of 40 x 20 mm that is thicker where x > 20."""
    V, F = box([0, 0, 0], [40, 20, thin], 40)
    V[(V[:, 0] > 20.5) & (V[:, 2] > thin / 2), 2] = thick
    return V, F


def halves(low, high):
    """Make two plates side by side, 0.2 mm apart."""
    return [box([0, 0, low], [19.9, 20, high], 10), box([20.1, 0, low], [40, 20, high], 10)]


@pytest.mark.parametrize(("k", "found"), [(2, []), (4, ["piece_001"])])
def test_more_than_a_thousandth_of_a_piece_is_found(k, found):
    verdict = judge([dented(k), box([0, 0, 10], [60, 60, 12])], min_wall=LEAST)
    assert verdict.failures.get("thin_walls", []) == found
    assert verdict.checks["thin_walls"] == len(found)
    assert verdict.ok == (not found)


def test_a_thin_piece_that_the_model_crosses_is_named_as_exempt():
    thick = [box([0, 0, 10 * k], [20, 20, 10 * k + 2]) for k in range(1, 10)]
    verdict = judge([box([0, 0, 0], [20, 20, 1]), *thick], min_wall=LEAST, exempt_pieces=["piece_001"])
    assert verdict.ok
    assert verdict.exempt == {"thin_walls": ["piece_001"]}
    assert verdict.checks["thin_walls"] == 1


@pytest.mark.parametrize("between", [0.2, 0.5, 1.5])
def test_skins_back_to_back_are_thin_however_near_they_are(between):
    skins = [*halves(0, 1), *halves(1 + between, 2 + between)]
    model = Mesh(*box([0, 0, 0], [40, 20, 2 + between], 10))
    verdict = judge(skins, min_wall=LEAST, thin_parts=ThinParts(model))
    assert len(verdict.failures["thin_walls"]) == 4
    assert not verdict.model_thin


def test_pieces_as_thin_as_the_model_keep_the_promise():
    pieces, model = halves(0, 1), Mesh(*box([0, 0, 0], [40, 20, 1], 10))
    assert len(judge(pieces, min_wall=LEAST).failures["thin_walls"]) == 2
    verdict = judge(pieces, min_wall=LEAST, thin_parts=ThinParts(model))
    assert verdict.ok
    assert verdict.checks["thin_walls"] == 0
    assert list(verdict.model_thin) == ["piece_001", "piece_002"]
    assert min(verdict.model_thin.values()) > 0.9  # the rim faces nobody, and counts as sheet


def test_the_model_is_asked_along_the_same_line():
    piece, model = box([0, 0, 0], [40, 20, 1], 20), Mesh(*step(1.0, 3.0))
    verdict = judge([piece], min_wall=LEAST, thin_parts=ThinParts(model))
    assert verdict.failures == {"thin_walls": ["piece_001"]}
    assert verdict.model_thin["piece_001"] == pytest.approx(0.5, abs=0.06)


def test_a_model_that_is_elsewhere_pardons_nothing():
    pieces, model = halves(0, 1), Mesh(*box([0, 0, 5], [40, 20, 6], 10))
    assert len(judge(pieces, min_wall=LEAST, thin_parts=ThinParts(model)).failures["thin_walls"]) == 2


@pytest.mark.parametrize(("known", "ok"), [(0.0, False), (0.4, False), (1.0, True)])
def test_what_was_found_of_the_model_earlier_is_allowed_for(known, ok):
    plates = [("thin", *box([0, 0, 0], [20, 20, 1])), ("thick", *box([0, 0, 9], [20, 20, 11]))]
    verdict = judge(plates, min_wall=LEAST, thin_parts=ThinParts(model_thin={"thin": known}))
    assert verdict.failures == ({} if ok else {"thin_walls": ["thin"]})


def test_pieces_as_thick_as_the_least_wall_are_not_thin():
    tilt = np.linalg.qr(np.random.default_rng(5).normal(size=(3, 3)))[0]
    tilt *= np.sign(np.linalg.det(tilt))
    V, F = box([0, 0, 0], [30, 20, LEAST])
    assert judge([((V @ tilt).astype(np.float32), F)], min_wall=LEAST).ok


def test_the_corner_of_a_wall_where_nothing_lies_before_it_is_no_sheet():
    """A strip that tapers between two neighbours, the ends of its walls beyond theirs."""
    side = np.array([[0, 0, 0], [40, 0, 0], [40, 3, 0], [0, 0.6, 0]], float)
    V = np.concatenate([side, side + np.array([0, 0, 2])])
    F = np.array(
        [[0, 2, 1], [0, 3, 2], [4, 5, 6], [4, 6, 7]]
        + [[a, b, b + 4] for a, b in ((0, 1), (1, 2), (2, 3), (3, 0))]
        + [[a, b + 4, a + 4] for a, b in ((0, 1), (1, 2), (2, 3), (3, 0))]
    )
    below = box([4, -10, 0], [40, -0.2, 2])
    above = box([4, 0, 0], [40, 10, 2])
    above.V[:, 1] += np.where(above.V[:, 1] < 5, 0.8 + 2.4 / 40 * above.V[:, 0], 0.8 + 3)
    assert "thin_walls" not in judge([(V, F), below, above], min_wall=LEAST).failures


def test_small_facets_at_the_corners_of_walls_are_no_sheets():
    """A plate hardly thicker than the least wall, a tip cut off below each of its corners."""
    tip, width = np.array([1.2, 1.2, 1.0]), 24.0
    plate = manifold3d.Manifold.cube([width, width, 1.25], True)
    for x, y in itertools.product((-1, 1), repeat=2):
        inward = -np.array([x, y, -1]) / tip
        corner = np.array([x * width, y * width, -1.25]) / 2
        away = inward @ corner + 1.0
        length = np.linalg.norm(inward)
        plate = plate.trim_by_plane(inward / length, away / length)
    cut = plate.to_mesh64()
    beside = [
        moved(box([-12, -12, -0.625], [12, 12, 0.625]), [24.2 * x, 24.2 * y, 0])
        for x, y in ((1, 0), (-1, 0), (0, 1), (0, -1))
    ]
    pieces = [(np.array(cut.vert_properties[:, :3]), cut.tri_verts.astype(np.int64)), *beside]
    assert judge(pieces, min_wall=LEAST).ok
    assert judge(pieces[:1], min_wall=LEAST).failures == {"thin_walls": ["piece_001"]}  # no walls, alone


@pytest.mark.parametrize(("through", "blamed"), [((), True), (["piece_001", "piece_002"], False)])
def test_pieces_that_reach_through_are_as_thick_as_their_part(through, blamed):
    parts = ThinParts(through_pieces=through)
    verdict = judge([*halves(0, 4), box([0, 0, 20], [40, 20, 22])], thickness=2.0, thin_parts=parts)
    assert verdict.failures == ({"thickness_mm": ["piece_001", "piece_002"]} if blamed else {})
    assert verdict.checks["thickness_mm"]["median"] == pytest.approx(4.0 if blamed else 2.0)
