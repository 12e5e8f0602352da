"""The borders of charts, and the regions they enclose."""

import numpy as np
import pytest
import shapely

from meshjig.mesh.halfedges import border_halfedges
from meshjig.tiling import chart_polygons
from meshjig.tiling.domain import chart_borders, unrolled
from tests.meshes import cylinder, disc, genus2, half_sphere, open_cup, two_components
from tests.tiling.charts import flat_chart, ring_chart


@pytest.mark.parametrize("shape", [disc, half_sphere, open_cup, cylinder, genus2, two_components])
def test_borders_are_the_half_edges_without_a_twin(shape):
    F = shape(2000).F
    np.testing.assert_array_equal(chart_borders(F), border_halfedges(F))


def test_polygon_of_a_chart_is_its_outline():
    square, notched = chart_polygons(flat_chart()), chart_polygons(flat_chart(corner_cut=True))
    assert square[0].area == pytest.approx(100**2)
    assert notched[0].area == pytest.approx(0.75 * 100**2)
    assert len(square) == 1


def test_an_unrolled_chart_is_three_periods_long_in_one_piece():
    polygon = chart_polygons(ring_chart(157.0))[0]
    long = unrolled(polygon, 157.0)
    assert isinstance(long, shapely.Polygon)
    assert not long.interiors
    assert long.area == pytest.approx(3 * polygon.area)
    assert unrolled(polygon, 0.0) is polygon
