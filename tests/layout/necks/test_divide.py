"""What hangs on a piece by less than a width goes to the neighbour; the rest stays as it is."""

import numpy as np
import pytest

from meshjig.cut.overlay import overlay
from meshjig.layout.necks.divide import divide_at_necks
from meshjig.layout.necks.width_components import width_components
from meshjig.layout.stitch import region_graph, stitch
from meshjig.mesh.measure import face_areas
from meshjig.mesh.types import Outlines
from tests.cut.graphs import SIDE, atlas, flat_sheet, halved_sheet

NECK = 2.0
HEAD = 24.0


def knobbed(neck, bent):
    """A sheet in two, the left one with a square head on a neck that reaches into the right one."""
    a, b, h = SIDE / 2 - neck / 2, SIDE / 2 + neck / 2, HEAD / 2
    y = [-1, a, a, SIDE / 2 - h, SIDE / 2 - h, SIDE / 2 + h, SIDE / 2 + h, b, b, SIDE + 1]
    x = [40, 40, 50, 50, 50 + HEAD, 50 + HEAD, 50, 50, 40, 40]
    return halved_sheet(np.stack([x, y], 1).astype(float), bent=bent)


def stitched(cut):
    return stitch(region_graph(cut), 0.3, SIDE**2, smallest=0.0)


def head_of(cut):
    middle = cut.V[cut.F].mean(1)
    return (middle[:, 0] > 51) & (middle[:, 0] < 49 + HEAD) & (np.abs(middle[:, 1] - SIDE / 2) < HEAD / 2 - 1)


@pytest.mark.parametrize("bent", [False, True], ids=["flat", "bent"])
def test_a_head_on_a_thin_neck_goes_to_the_piece_around_it(bent):
    cut = knobbed(NECK, bent)
    divided, stitching = divide_at_necks(cut, stitched(cut), 1.3 * NECK, 0.25)
    piece = stitching.piece_of_region[divided.region]
    far_right = piece[np.argmax(cut.V[cut.F].mean(1)[:, 0])]
    assert (piece[head_of(cut)] == far_right).all()
    assert stitching.facts.handed_over == 1
    assert stitching.n_pieces == 2


@pytest.mark.parametrize("bent", [False, True], ids=["flat", "bent"])
def test_a_neck_wide_enough_stays(bent):
    cut = knobbed(NECK, bent)
    before = stitched(cut)
    divided, stitching = divide_at_necks(cut, before, 0.8 * NECK, 0.25)
    assert divided is cut
    np.testing.assert_array_equal(stitching.piece_of_region, before.piece_of_region)


def test_a_large_head_becomes_a_piece():
    cut = knobbed(NECK, False)
    share = 0.5 * HEAD**2 / (SIDE**2 / 2)
    divided, stitching = divide_at_necks(cut, stitched(cut), 1.3 * NECK, share)
    assert stitching.facts.parted == 1
    piece = stitching.piece_of_region[divided.region]
    area = np.bincount(piece, face_areas(cut.V, cut.F))
    assert area[piece[head_of(cut)][0]] == pytest.approx(HEAD**2, rel=0.1)


def test_regions_after_it_are_of_one_piece_and_make_up_the_same_faces():
    cut = knobbed(NECK, True)
    divided, stitching = divide_at_necks(cut, stitched(cut), 1.3 * NECK, 0.25)
    assert len(stitching.piece_of_region) == divided.region.max() + 1
    pairs = np.unique(np.stack([divided.region, cut.label], 1), axis=0)
    assert len(pairs) == divided.region.max() + 1  # each lies in one label


def test_a_border_on_the_other_side_of_a_thin_sheet_is_not_near():
    """Two sheets, half the width apart, back to back: cuts of the one don't divide the other."""
    p, F = flat_sheet(20)
    V = np.vstack([np.c_[p, np.zeros(len(p))], np.c_[p, np.full(len(p), -0.5)]])
    both = np.vstack([F, F[:, ::-1] + len(p)])
    uv = np.vstack([p, np.c_[2.5 * SIDE - p[:, 0], p[:, 1]]])
    line = np.array([(SIDE / 2 + 1.3, -1.0), (SIDE / 2 + 1.3, SIDE + 1)])
    around = np.array([(-1, SIDE + 1), (-1, -1), (3 * SIDE, -1), (3 * SIDE, SIDE + 1)], float)
    segments = np.array([[0, 1], [1, 2], [2, 3], [3, 0], [0, 4], [4, 5], [5, 1]])
    outlines = Outlines(
        np.vstack([line, around]), segments, np.array([0] * 4 + [1] * 3), np.array([1] + [2] * 6)
    )
    cut = overlay(atlas(V, both, uv), outlines)
    piece = cut.region
    part = width_components(cut.V, cut.F, piece, 2.0)
    np.testing.assert_array_equal(np.unique(np.stack([piece, part], 1), axis=0)[:, 0], np.arange(3))
