"""Knobs are found whole or not at all, and measured in space."""

from dataclasses import replace

import numpy as np
import pytest

from meshjig.cut.overlay import overlay
from meshjig.layout.interlock import interlock, undercuts
from meshjig.mesh.types import Knobs, Mesh
from meshjig.tiling import tile_charts
from tests.cut.graphs import SIDE, atlas, flat_sheet, halved_sheet

MIDDLE = SIDE / 2


@pytest.fixture(scope="module")
def tiled():
    """A flat sheet of 100 mm in tiles of up to 40 mm: 3 x 3 of them, 12 inner borders."""
    p, F = flat_sheet(30)
    sheet = atlas(np.c_[p, np.zeros(len(p))], F, p)
    outlines, knobs = tile_charts(sheet, 40.0)
    return outlines, knobs, overlay(sheet, outlines)


def pieces_of(cut):
    return np.unique(cut.label, return_inverse=True)[1]


def test_every_inner_border_of_a_sheet_has_its_knob(tiled):
    _, _, cut = tiled
    found = interlock(cut, tiled[1], pieces_of(cut))
    assert len(found.pairs) == 12
    assert found.knobs_of_pair.tolist() == [1] * 12
    assert found.interlocked_borders(0.2) == found.interlocked_length(0.2) == 1.0


def test_widths_are_those_of_the_drawing(tiled):
    outlines, knobs, cut = tiled
    found = interlock(cut, knobs, pieces_of(cut))
    for measured, points in ((found.head, knobs.head), (found.neck, knobs.neck)):
        drawn = np.linalg.norm(np.diff(outlines.points[points], axis=1)[:, 0], axis=1)
        np.testing.assert_allclose(np.sort(measured), np.sort(drawn), atol=1e-4)


def test_merging_two_pieces_takes_their_knob_away(tiled):
    _, knobs, cut = tiled
    piece = pieces_of(cut)
    a, b = interlock(cut, knobs, piece).pairs[0]
    merged = np.unique(np.where(piece == b, a, piece), return_inverse=True)[1]
    found = interlock(cut, knobs, merged)
    assert len(found.neck) == 11
    assert found.knobs_of_pair.sum() == 11


def test_a_knob_between_changing_pieces_is_not_whole(tiled):
    _, knobs, cut = tiled
    piece = pieces_of(cut).copy()
    low = cut.V[cut.F].mean(1)
    inside = (low[:, 0] < SIDE / 2) & (low[:, 1] < SIDE / 2)
    piece[inside & (low[:, 0] + low[:, 1] < 60)] = piece.max() + 1  # cuts through tiles and their knobs
    found = interlock(cut, knobs, piece)
    assert len(found.neck) < 12
    assert (found.knobs_of_pair == 0).any()
    assert found.interlocked_borders(0.2) < 1


def test_a_shape_that_holds_counts_without_knobs(tiled):
    _, _, cut = tiled
    none = np.zeros((0, 2), np.int64)
    found = interlock(cut, Knobs(none, none, none), pieces_of(cut))
    assert found.interlocked_borders(0.2) == 1.0
    assert found.interlocked_borders(20.0) == 0.0


def strip(width, length=1.5):
    """Four pieces: two meet end to end in a strip between two others."""
    cut = halved_sheet(np.array([(SIDE / 2, -1.0), (SIDE / 2, SIDE + 1)]), n=10)
    V = cut.V.copy()
    V[:, 1] = np.interp(V[:, 1], [0, 50, 60, SIDE], [0, 50, 50 + width, SIDE])
    y = V[cut.F].mean(1)[:, 1]
    piece = np.where(y < 50, 2, np.where(y < 50 + width, cut.label, 3))
    return replace(cut, mesh=Mesh(V, cut.F)), piece


@pytest.mark.parametrize(
    ("width", "min_wall", "faces"),
    [(0.5, 0.0, False), (1.2, 0.0, True), (1.2, 1.5, False), (5.0, 1.5, True)],
    ids=["a sliver", "thin", "too thin to be made", "wide"],
)
def test_pieces_that_meet_in_a_sliver_between_others_do_not_face_each_other(width, min_wall, faces):
    cut, piece = strip(width)
    none = np.zeros((0, 2), np.int64)
    found = interlock(cut, Knobs(none, none, none), piece)
    pairs = found.pairs[found.faces_other(0.3, min_wall)].tolist()
    assert ([0, 1] in pairs) == faces
    assert [0, 2] in pairs


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
