"""Knobs hold on every border, keep their distance, stay off creases and leave areas even."""

import numpy as np
import pytest
import shapely

from meshjig.cells.knobs.knob_outlines import knob_outlines
from meshjig.cut import overlay
from meshjig.layout.interlock import interlock
from meshjig.mesh.measure import area_vectors, face_areas, unit
from tests.cells.knobs.knob_sheets import EDGE, folded, hemispheres, rolled, square_cells, waved, waved_flat

SHEETS = {
    "flat": square_cells(),
    "waved": square_cells(fine=20, shape=waved_flat, plane=waved),
    "rolled": square_cells(shape=rolled),
    "coarse": square_cells(fine=3),
}
CLEAR = 0.07 * EDGE


def cell_areas(atlas):
    return np.bincount(atlas.chart_of_face, face_areas(atlas.mesh.V, atlas.mesh.F), atlas.n_charts)


def loops_of(layout):
    """Give each loop's points and the labels inside and outside, following segments."""
    o = layout.outlines
    ends = np.flatnonzero(o.segments[:, 1] != np.arange(len(o.segments)) + 1) + 1
    for part in np.split(np.arange(len(o.segments)), ends[:-1]):
        yield o.points[o.segments[part, 0]], int(o.left[part[0]]), int(o.right[part[0]])


@pytest.mark.parametrize("name", SHEETS)
def test_every_border_has_a_whole_knob_that_holds(name):
    atlas = SHEETS[name]
    layout = knob_outlines(atlas, size=EDGE)
    cut = overlay(atlas, layout.outlines)
    found = interlock(cut, layout.knobs, cut.label)
    assert layout.facts.borders == len(layout.pairs) == 24
    assert layout.facts.knobs == 24
    assert found.interlocked_borders(0.2) == 1.0
    assert len(found.neck) == 24
    assert (found.head / found.neck).min() > 1.5
    assert np.unique(cut.label).tolist() == list(range(16))


@pytest.mark.parametrize("name", SHEETS)
def test_areas_that_move_are_those_of_the_cut(name):
    atlas = SHEETS[name]
    layout = knob_outlines(atlas, size=EDGE)
    cut = overlay(atlas, layout.outlines)
    expected = cell_areas(atlas)
    np.add.at(expected, layout.moved[:, 0], -layout.moved_mm2)
    np.add.at(expected, layout.moved[:, 1], layout.moved_mm2)
    areas = np.bincount(cut.label, face_areas(cut.V, cut.F), atlas.n_charts)
    np.testing.assert_allclose(areas, expected, atol=0.02 * EDGE**2)
    odd = 0.14 * EDGE**2  # a knob's area: half of the cells have three borders, and give one more or less
    assert areas.std() < odd * np.sqrt(1 / 2)


@pytest.mark.parametrize("random", [0.0, 1.0])
def test_knobs_keep_clear_of_each_other_and_of_other_borders(random):
    atlas = SHEETS["waved"]
    layout = knob_outlines(atlas, size=EDGE, random=random, seed=3)
    tree_of = {}
    for loop, inside, cell in loops_of(layout):
        if inside == cell:
            continue  # the frame of a cell that no knob enters
        faces = atlas.uv[atlas.F_uv[atlas.chart_of_face == cell]]
        chart = shapely.union_all(shapely.polygons(faces))
        knob = shapely.intersection(shapely.polygons(loop), chart)
        assert knob.geom_type == "Polygon"
        assert shapely.intersection(shapely.linearrings(loop), chart.exterior).geom_type == "MultiPoint"
        tree_of.setdefault(cell, []).append((knob, chart))
    for knobs in tree_of.values():
        for i, (knob, chart) in enumerate(knobs):
            corners = shapely.multipoints(np.array(chart.minimum_rotated_rectangle.exterior.coords))
            assert knob.distance(corners) > CLEAR / 2
            assert all(knob.distance(other) >= CLEAR - 1e-9 for other, _ in knobs[i + 1 :])


def test_open_rims_stay_plain():
    atlas = square_cells(3, 1)
    layout = knob_outlines(atlas, size=EDGE)
    cut = overlay(atlas, layout.outlines)
    rim = cut.V[(cut.V[:, 1] < 1e-9) | (cut.V[:, 1] > EDGE - 1e-9)]
    assert layout.facts.knobs == 2
    assert len(rim) == 2 * 31  # as before: nothing cuts the long rims


def test_a_cell_without_neighbours_stays_whole():
    atlas = square_cells(1)
    layout = knob_outlines(atlas, size=EDGE)
    assert layout.facts.borders == 0
    assert overlay(atlas, layout.outlines).label.tolist() == [0] * len(atlas.mesh.F)


def test_two_cells_around_one_closed_border_interlock():
    atlas = hemispheres()
    layout = knob_outlines(atlas, size=float(np.sqrt(cell_areas(atlas)[0])))
    cut = overlay(atlas, layout.outlines)
    found = interlock(cut, layout.knobs, cut.label)
    assert found.pairs.tolist() == [[0, 1]]
    assert found.knobs_of_pair.tolist() == [1]
    assert (found.head / found.neck).min() > 1.35


def test_necks_are_as_thick_as_asked_and_else_there_are_waves():
    atlas = SHEETS["rolled"]
    layout = knob_outlines(atlas, size=EDGE, min_neck=4.5)
    cut = overlay(atlas, layout.outlines)
    found = interlock(cut, layout.knobs, cut.label)
    assert layout.facts.stout_knobs == layout.facts.knobs == len(found.neck) > 12
    assert found.neck.min() >= 4.5

    layout = knob_outlines(atlas, size=EDGE, min_neck=6.0)
    assert layout.facts.knobs == 0
    assert (layout.knob_of_border == -1).all()
    assert layout.facts.waves > 12
    assert layout.facts.too_thin == layout.facts.long_without_knob == 24


def test_waves_have_no_undercut():
    layout = knob_outlines(SHEETS["flat"], size=EDGE, min_neck=6.0)
    for loop, inside, cell in loops_of(layout):
        if inside != cell:
            across = np.ptp(loop, axis=0).argmax()  # on flat squares, borders run along the axes
            steps = np.diff(loop[:, across])
            assert (steps[np.abs(steps) > 1e-9] > 0).all() or (steps[np.abs(steps) > 1e-9] < 0).all()


def test_knobs_keep_off_a_crease():
    atlas = square_cells(4, fine=12, shape=folded)
    layout = knob_outlines(atlas, size=EDGE, crease_aware=True)
    cut = overlay(atlas, layout.outlines)
    mine = atlas.chart_of_face[cut.parent]
    inside = np.flatnonzero(cut.label != mine)
    knob = np.unique(mine[inside] * 100 + cut.label[inside], return_inverse=True)[1]
    normal = area_vectors(cut.V, cut.F)[inside]
    mean = unit(np.stack([np.bincount(knob, n) for n in normal.T], 1))
    off = np.degrees(np.arccos(np.clip((unit(normal) * mean[knob]).sum(1), -1, 1)))
    assert layout.facts.knobs == 24
    assert off.max() < 35


def test_seed_decides():
    a, b, c = (knob_outlines(SHEETS["flat"], size=EDGE, seed=s).outlines.points for s in (1, 1, 2))
    np.testing.assert_array_equal(a, b)
    assert a.shape != c.shape or not np.allclose(a, c)


def test_randomness_makes_knobs_lean():
    lean = {}
    for random in (0.0, 1.0):
        layout = knob_outlines(SHEETS["flat"], size=EDGE, random=random)
        p = layout.outlines.points
        neck, head = p[layout.knobs.neck], p[layout.knobs.head]
        along = unit(neck[:, 0] - neck[:, 1])
        lean[random] = np.abs(((head - neck).mean(1) * along).sum(1))
    assert lean[0.0].max() < 0.2
    assert np.median(lean[1.0]) > 2 * np.median(lean[0.0])
    assert lean[1.0].max() > 0.4


def test_knobs_scale_with_their_size():
    head = {}
    for size in (0.7, 1.0):
        layout = knob_outlines(SHEETS["flat"], size=EDGE, knob_size=size)
        p = layout.outlines.points[layout.knobs.head]
        head[size] = np.median(np.linalg.norm(p[:, 0] - p[:, 1], axis=1))
    assert head[1.0] == pytest.approx(0.37 * EDGE, rel=0.1)
    assert head[0.7] == pytest.approx(0.7 * 0.37 * EDGE, rel=0.1)


def test_another_layout_can_be_followed():
    atlas = SHEETS["waved"]
    before = knob_outlines(atlas, size=EDGE, seed=1)
    alone = knob_outlines(atlas, size=EDGE, seed=2)
    after = knob_outlines(atlas, size=EDGE, seed=2, like=before)
    sides = [{tuple(pair) for pair in layout.moved.tolist()} for layout in (before, alone, after)]
    assert len(sides[0] & sides[1]) < 20
    assert len(sides[0] & sides[2]) >= 23


def test_only_the_borders_that_are_asked_for_get_a_knob():
    atlas = SHEETS["waved"]
    wanted = np.array([[1, 0], [5, 6], [9, 13]])
    layout = knob_outlines(atlas, size=EDGE, between=wanted)
    cut = overlay(atlas, layout.outlines)
    found = interlock(cut, layout.knobs, cut.label)
    assert found.pairs[found.knobs_of_pair > 0].tolist() == np.sort(wanted, axis=1).tolist()
    np.testing.assert_array_equal(np.unique(cut.label), np.arange(16))
    moved = np.abs(cell_areas(atlas) - np.bincount(cut.label, face_areas(cut.V, cut.F), 16)) > 1e-6
    assert set(np.flatnonzero(moved)) <= set(wanted.ravel())
