import numpy as np
import pytest
import shapely

from meshjig.mesh.measure import mesh_volume
from meshjig.output.plates.pose import lying_pose
from tests.meshes import Shape, creased_box, sphere
from tests.output.plates.tiles import bent, turned

UP = np.array([0.0, 0.0, 1.0])
TILES = {
    "flat": bent(30, 22),
    "dome": bent(30, 26, 0.03, 0.03),
    "gutter": bent(30, 30, 0.05, 0.0),
    "saddle": bent(28, 28, 0.03, -0.03),
    "strip on a limb": bent(32, 10, 0.0, 0.1),
    "long and bent": bent(60, 12, 0.02, 0.0),
}
each_tile = pytest.mark.parametrize("tile", TILES.values(), ids=TILES.keys())


def test_the_makers_of_these_tests_give_closed_solids():
    for tile in TILES.values():
        assert mesh_volume(*tile) > 0


@each_tile
@pytest.mark.parametrize("seed", range(3))
def test_a_tile_lies_down_however_it_came(tile, seed):
    (V, F), R = turned(tile, seed)
    pose = lying_pose(V, F, R @ UP)
    np.testing.assert_allclose(pose.R @ pose.R.T, np.eye(3), atol=1e-12)
    assert np.linalg.det(pose.R) == pytest.approx(1)
    assert np.ptp((V @ pose.R.T)[:, 2]) == pytest.approx(pose.height)
    assert pose.height <= 0.6 * pose.extent
    assert abs((pose.R @ R @ UP)[2]) > 0.7


@each_tile
def test_the_centre_of_mass_is_above_what_touches_the_plate(tile):
    (V, F), _ = turned(tile, 4)
    W = V @ lying_pose(V, F).R.T
    a, b, c = (W[F[:, k]] for k in range(3))
    volume = np.einsum("ij,ij->i", a, np.cross(b, c))
    centre = volume @ (a + b + c) / 4 / volume.sum()
    touching = W[W[:, 2] < W[:, 2].min() + 1e-4, :2]
    base = shapely.MultiPoint(touching).convex_hull
    assert base.distance(shapely.Point(centre[:2])) < 1e-3


@each_tile
def test_height_and_support_do_not_depend_on_how_it_came(tile):
    poses = [lying_pose(*turned(tile, seed)[0]) for seed in range(4)]
    assert np.ptp([pose.height for pose in poses]) < 0.05 * poses[0].height + 1e-3
    assert np.ptp([pose.overhang for pose in poses]) < 0.02


@pytest.mark.parametrize("name", ["flat", "dome", "gutter", "saddle"])
@pytest.mark.parametrize("outer", [UP, -UP])
def test_the_outer_side_comes_up_when_it_costs_little(name, outer):
    (V, F), R = turned(TILES[name], 5)
    pose = lying_pose(V, F, R @ outer)
    assert pose.outer_up
    assert (pose.R @ R @ outer)[2] > 0.7


def test_what_is_not_known_is_not_claimed():
    assert lying_pose(*TILES["dome"]).outer_up is None
    assert lying_pose(*TILES["dome"], np.zeros(3)).outer_up is None


def test_a_sphere_needs_support_around_its_lowest_point_only():
    share = (1 - np.cos(np.pi / 4)) / 2  # of a sphere's area, below 45 degrees
    assert lying_pose(*sphere(20_000)).overhang == pytest.approx(share, abs=0.01)


def test_a_box_rests_on_its_largest_side_without_support():
    V, F = creased_box(1200)
    pose = lying_pose(*turned(Shape(V * (0.3, 0.1, 0.6), F), 2)[0])
    assert pose.height == pytest.approx(10, abs=1e-6)
    assert pose.overhang == 0
    assert pose.extent == pytest.approx(np.linalg.norm([30, 10, 60]))


def test_a_body_without_a_low_pose_takes_the_lowest():
    pose = lying_pose(*sphere(2000))
    assert 0.95 < pose.height / pose.extent <= 1
