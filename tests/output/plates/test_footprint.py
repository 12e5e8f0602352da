import numpy as np
import pytest
import shapely

from meshjig.output.plates.footprint import convex_ring, footprint, least_rectangle, size_at
from tests.meshes import genus2, sphere, torus
from tests.output.plates.tiles import bent, turned


@pytest.mark.parametrize(
    "solid",
    [sphere(500), torus(800), genus2(600), turned(bent(30, 26, 0.03, -0.03), 1)[0]],
    ids=["sphere", "ring", "two holes", "bent tile, tilted"],
)
def test_the_shadow_is_the_union_of_the_triangles_shadows(solid):
    V, F = solid
    true = shapely.union_all(_triangles(V, F))
    shadow = footprint(V, F)
    assert len(shadow.interiors) == sum(shapely.Polygon(hole).area > 1e-3 for hole in true.interiors)
    assert shadow.exterior.hausdorff_distance(true.exterior) < 0.06
    assert shadow.area == pytest.approx(true.area, rel=0.005)


def _triangles(V, F):
    triangles = shapely.polygons(V[F][..., :2])
    return triangles[shapely.area(triangles) > 1e-9]


@pytest.mark.parametrize("seed", range(20))
def test_no_turn_gives_a_smaller_rectangle(seed):
    ring = convex_ring(np.random.default_rng(seed).standard_normal((12, 2)) * (9, 4))
    turn = least_rectangle(ring)
    size = size_at(ring, np.array([turn]))[0]
    assert 0 <= turn < np.pi
    assert size[0] >= size[1]
    every = size_at(ring, np.radians(np.arange(0, 180, 0.25)))
    assert size.prod() <= every.prod(axis=1).min() + 1e-9


def test_sizes_are_those_of_the_turned_points():
    points = np.array([[0.0, 0.0], [4.0, 0.0], [4.0, 3.0]])
    size = size_at(points, np.array([0.0, np.pi / 2, -np.arctan2(3, 4)]))
    np.testing.assert_allclose(size, [[4, 3], [3, 4], [5, 2.4]], atol=1e-12)
