"""An undercut is what a drawing says it is, on a flat sheet and on a bent one, and 0 where nothing holds."""

import numpy as np
import pytest

from meshjig.layout.undercut import undercuts
from tests.cut.graphs import SIDE, halved_sheet

MIDDLE = SIDE / 2


def dovetail(neck, head, turn=0.0):
    """A border upward through a sheet, with a tail that widens from neck to head, turned by degrees."""
    y = MIDDLE + np.array([-MIDDLE - 1, -neck / 2, -head / 2, head / 2, neck / 2, MIDDLE + 1])
    x = MIDDLE + np.array([0.0, 0, 12, 12, 0, 0])
    c, s = np.cos(np.radians(turn)), np.sin(np.radians(turn))
    inner = (np.stack([x, y], 1)[1:-1] - MIDDLE) @ np.array([[c, s], [-s, c]]) + MIDDLE
    return np.vstack([(inner[0, 0], -1.0), inner, (inner[-1, 0], SIDE + 1)])


def undercut(curve, bent=False):
    cut = halved_sheet(curve, bent=bent)
    return undercuts(cut, cut.label, np.array([[0, 1]]))[0]


@pytest.mark.parametrize("bent", [False, True], ids=["flat", "bent"])
@pytest.mark.parametrize("undercut_mm", [0.5, 3.0])
def test_a_dovetail_holds_by_half_of_what_it_widens(undercut_mm, bent):
    assert undercut(dovetail(10, 10 + 2 * undercut_mm), bent) == pytest.approx(
        undercut_mm, rel=0.15, abs=0.05
    )


@pytest.mark.parametrize("turn", [-25, 25])
def test_it_holds_as_well_when_it_is_turned(turn):
    assert undercut(dovetail(10, 16, turn)) > 2.5


@pytest.mark.parametrize(
    "curve",
    [
        [(MIDDLE, -1.0), (MIDDLE, SIDE + 1)],
        [(MIDDLE, -1.0), (MIDDLE, 30), (70, 50), (MIDDLE, 70), (MIDDLE, SIDE + 1)],
        dovetail(16, 10),
    ],
    ids=["straight", "a wedge", "a tail that narrows"],
)
def test_what_comes_apart_in_some_direction_has_none(curve):
    assert undercut(np.array(curve)) < 1e-3


def test_a_piece_inside_another_holds_by_its_width():
    cut = halved_sheet(np.array([(MIDDLE, -1.0), (MIDDLE, SIDE + 1)]), n=30)
    middle = cut.V[cut.F].mean(1)
    island = (np.abs(middle[:, :2] - (25, 50)) < 10).all(1).astype(np.int64)
    assert 17 < undercuts(cut, island, np.array([[0, 1]]))[0] < 25
