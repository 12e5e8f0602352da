"""Borders and pieces that could be taken for one another are found, and no others."""

from pathlib import Path

import numpy as np
import pytest

from meshjig.cut.overlay import overlay
from meshjig.layout.congruent import borders, clashes, congruent_borders, interchangeable
from meshjig.layout.tiles import tile_layout
from meshjig.mesh.subdivide import refine_long_edges
from meshjig.mesh.types import Mesh
from meshjig.options import Options
from meshjig.pipeline.prepare import chart, clean_scan
from meshjig.runtime.progress import Stages
from meshjig.scan import Scan
from tests.cut.graphs import SIDE, atlas, flat_sheet, grid_graph, wavy

VASE = Path(__file__).parent.parent.parent / "data/vase.ply"


def gridded(x, y, bend=None):
    """A sheet cut into rectangles, and the number of each."""
    p, F = flat_sheet(20)
    V = np.c_[p, np.zeros(len(p))] if bend is None else bend(p)
    lines = (np.array([-1.0, *x, SIDE + 1]), np.array([-1.0, *y, SIDE + 1]))
    cut = overlay(atlas(V, F, p), grid_graph(*lines))
    return cut, np.unique(cut.label, return_inverse=True)[1]


def third(k):
    return k * SIDE / 3


def found(cut, piece, tolerance=0.1):
    rims = borders(cut, piece)
    return rims, congruent_borders(cut, rims, tolerance), interchangeable(cut, rims, tolerance)


def test_equal_squares_are_told_apart_by_their_neighbours_only():
    cut, piece = gridded([third(1), third(2)], [third(1), third(2)])
    rims, alike, swaps = found(cut, piece)
    assert [len(rim) for rim in rims] == [3, 4, 3, 4, 4, 4, 3, 4, 3]
    assert len(alike) == 12 * 11 / 2  # all twelve borders are straight and of one length
    corners, others = {0, 2, 6, 8}, {1, 3, 4, 5, 7}
    assert swaps == sorted((a, b) for g in (corners, others) for a in g for b in g if a < b)


def test_rectangles_of_different_size_have_one_place_each():
    cut, piece = gridded([20.0, 55.0], [30.0, 72.0])
    _, alike, swaps = found(cut, piece)
    assert swaps == []
    lengths = {20.0, 35.0, 45.0, 30.0, 42.0, 28.0}  # each of them two borders long
    assert len(alike) == len(lengths)


def test_bending_the_sheet_tells_equal_squares_apart():
    cut, piece = gridded([third(1), third(2)], [third(1), third(2)], wavy)
    assert found(cut, piece)[2] == []
    assert found(cut, piece, tolerance=SIDE)[2]


@pytest.mark.parametrize("turn", [0.0, 0.7, 2.0])
def test_where_the_sheet_lies_in_space_changes_nothing(turn):
    c, s = np.cos(turn), np.sin(turn)
    R = np.array([[c, -s, 0], [0, 0, -1], [s, c, 0]])
    cut, piece = gridded([20.0, 40.0], [50.0], lambda p: np.c_[p, np.zeros(len(p))] @ R.T + [5, -80, 3])
    _, alike, swaps = found(cut, piece)
    assert len(alike) == 6 + 1  # four borders of 50, and two of 20
    assert swaps == [(1, 4)]  # the others are each other's mirror images


@pytest.mark.parametrize("unique", [False, True])
def test_pieces_of_a_vase_change_places_unless_they_are_to_be_unique(unique):
    options = Options.of(charts="periodic", pieces=80, unique=unique)
    mesh = clean_scan(VASE, options).mesh
    surface = Mesh(*refine_long_edges(mesh.V, mesh.F, 6.0))
    layout = tile_layout(chart(Scan(surface, None, None, None), options), options, Stages())
    _, facts = clashes(layout, options.clearance)
    assert (facts.interchangeable_pieces == 0) == unique
    assert (facts.congruent_borders < 40) == unique  # plain borders are left to look alike
