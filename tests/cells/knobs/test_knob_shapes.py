"""Knobs have heads wider than necks, are covered by their discs, and waves have no undercut."""

import numpy as np
import pytest
import shapely

from meshjig.cells.knobs.knob_shapes import SLIM, STOUT, WAVE, knob_shapes


def shapes(random=0.0, n=12):
    return knob_shapes(np.random.default_rng(0), random, n)


@pytest.mark.parametrize(("kind", "ratio"), [(SLIM, 1.85), (STOUT, 1.47)])
@pytest.mark.parametrize("random", [0.0, 1.0])
def test_heads_and_necks_are_where_a_knob_is_widest_and_narrowest(kind, ratio, random):
    s = shapes(random)
    for i in s.of_kind(kind):
        neck, head = s.points[i, list(s.neck)], s.points[i, list(s.head)]
        width = {}
        for y in np.linspace(0.02, s.points[i, :, 1].max() - 0.02, 300):
            row = shapely.linestrings([(-3, y), (3, y)])
            width[y] = shapely.intersection(row, shapely.polygons(s.points[i])).length
        heights = np.array(list(width))
        above = heights > neck[0, 1]
        values = np.array(list(width.values()))
        assert neck[0, 0] - neck[1, 0] == pytest.approx(s.neck_width[i], abs=0.01)
        assert values[heights < head[0, 1]].min() == pytest.approx(s.neck_width[i], abs=0.02)
        assert values[above].max() == pytest.approx(np.linalg.norm(head[0] - head[1]), abs=0.05)
        assert np.linalg.norm(head[0] - head[1]) / s.neck_width[i] == pytest.approx(ratio, rel=0.02)


@pytest.mark.parametrize("random", [0.0, 1.0])
def test_discs_cover_curves_above_the_border(random):
    s = shapes(random)
    for points, discs in zip(s.points, s.discs, strict=True):
        cover = shapely.union_all(shapely.buffer(shapely.points(discs[:, :2]), discs[:, 2] + 0.02))
        above = shapely.intersection(shapely.polygons(points), shapely.box(-3, 0.0, 3, 3))
        assert cover.covers(above)


def test_areas_are_those_above_the_border():
    s = shapes(0.5, n=40)
    above = shapely.intersection(shapely.polygons(s.points), shapely.box(-3, 0, 3, 3))
    np.testing.assert_allclose(s.area, shapely.area(above), rtol=0.01)


def test_curves_run_anticlockwise_and_do_not_cross_themselves():
    s = shapes(1.0)
    rings = shapely.linearrings(s.points)
    assert shapely.is_simple(rings).all()
    assert shapely.is_ccw(rings).all()


def test_a_wave_has_no_undercut():
    s = shapes()
    (wave,) = s.of_kind(WAVE)
    assert (np.diff(s.points[wave, :, 0]) <= 1e-9).all()
    assert np.ptp(s.points[wave, :, 0]) <= 2 * s.half_width[wave] + 1e-9
