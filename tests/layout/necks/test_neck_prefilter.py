"""No piece that is narrow somewhere is missed; most others are known not to be."""

import numpy as np
import pytest

from meshjig.layout.necks.neck_prefilter import could_have_necks
from meshjig.mesh.halfedges import edges
from tests.cut.graphs import SIDE, flat_sheet, halved_sheet, wavy
from tests.layout.necks.test_divide import NECK, knobbed


def narrow(V, F, piece, width):
    return could_have_necks(V, F, edges(F), piece, width).tolist()


@pytest.mark.parametrize("bent", [False, True], ids=["flat", "bent"])
@pytest.mark.parametrize("width", [0.7 * NECK, NECK, 1.4 * NECK])
def test_a_head_on_a_neck_no_wider_than_that_is_found_and_so_is_its_socket(width, bent):
    cut = knobbed(NECK, bent)
    assert narrow(cut.V, cut.F, cut.region, width) == [True, True]


@pytest.mark.parametrize("bent", [False, True], ids=["flat", "bent"])
def test_a_neck_much_wider_is_not_narrow_nor_are_square_corners(bent):
    cut = knobbed(NECK, bent)
    assert narrow(cut.V, cut.F, cut.region, 0.5 * NECK) == [False, False]


def test_a_sharp_corner_could_be_narrow():
    y = np.linspace(-1, SIDE + 1, 20)
    cut = halved_sheet(np.stack([0.3 * y, y], 1), bent=False)
    x = np.array([cut.V[cut.F[cut.region == k]].mean((0, 1))[0] for k in (0, 1)])
    assert narrow(cut.V, cut.F, cut.region, 1.0)[int(x.argmin())]


def test_a_strip_across_a_sheet_is_narrow_and_what_it_divides_is_not():
    p, F = flat_sheet(50)
    x = p[F].mean(1)[:, 0]
    piece = np.searchsorted([SIDE / 2, SIDE / 2 + 2.0], x)
    assert narrow(wavy(p), F, piece, 2.0) == [False, True, False]


def test_pieces_with_two_borders_or_with_one_that_meets_itself_could_be_narrow():
    p, F = flat_sheet(20)
    middle = p[F].mean(1)
    square = np.floor(middle / 5).astype(int)
    hole = (square == [10, 10]).all(1)
    pair = (square == [4, 4]).all(1) | (square == [5, 5]).all(1)  # corner on corner
    assert narrow(wavy(p), F, np.where(hole, 1, np.where(pair, 2, 0)), 0.1) == [True, False, True]
