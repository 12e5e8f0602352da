import sys

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely import affinity

from meshjig.errors import OptionError, OutputError
from meshjig.output.plates import nest as nesting
from meshjig.output.plates.nest import nest
from meshjig.output.plates.pack import convex_ring, footprint, least_rectangle, pack, size_at
from meshjig.output.plates.printers import Plate
from tests.meshes import genus2, sphere, torus
from tests.output.plates.tiles import bent, turned

EPS = 1e-6  # mm


def placed(outlines, placements):
    """The outlines where they ended up."""
    turned = [
        affinity.rotate(shapely.Polygon(points), turn, origin=(0, 0), use_radians=True)
        for points, turn in zip(outlines, placements.turn, strict=True)
    ]
    return [affinity.translate(shape, *shift) for shape, shift in zip(turned, placements.shift, strict=True)]


def assert_kept_apart(shapes, placements, plate, gap):
    bed = shapely.box(0, 0, plate.width, plate.depth).buffer(-gap + EPS, join_style="mitre")
    for i, shape in enumerate(shapes):
        assert bed.covers(shape)
        for other in np.flatnonzero(placements.plate[:i] == placements.plate[i]):
            assert shape.distance(shapes[other]) >= gap - EPS


def tile(width, depth):
    return np.array([[0, 0], [width, 0], [width, depth], [0, depth]], float)


def bent_arm(side, arm):
    """An L."""
    return np.array([[0, 0], [side, 0], [side, arm], [arm, arm], [arm, side], [0, side]], float)


sizes = st.lists(st.tuples(st.floats(2, 60), st.floats(2, 60)), min_size=1, max_size=25)


@settings(max_examples=40, deadline=None)
@given(sizes, st.sampled_from([0.0, 1.0, 5.0]), st.integers(0, 100))
def test_outlines_lie_within_their_plate_with_the_gap_kept(sizes, gap, seed):
    rng = np.random.default_rng(seed)
    outlines = [tile(*size) @ _rotation(rng.uniform(0, 7)) + rng.uniform(-50, 50, 2) for size in sizes]
    plate = Plate(110, 90)
    placements = pack(outlines, plate, gap)
    assert_kept_apart(placed(outlines, placements), placements, plate, gap)
    assert set(placements.plate) == set(range(placements.n_plates))


def _rotation(turn):
    return np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])


def test_equal_squares_fill_plates_to_the_brim():
    placements = pack([tile(18, 18)] * 50, Plate(102, 102), 2.0)  # five by five a plate, exactly
    assert np.bincount(placements.plate).tolist() == [25, 25]


def test_equal_outlines_give_equal_packings():
    outlines = [tile(5 + k % 7, 9 + k % 5) for k in range(40)]
    first, second = (pack(outlines, Plate(60, 60), 1.0) for _ in range(2))
    for a, b in zip(first, second, strict=True):
        np.testing.assert_array_equal(a, b)


def test_what_fits_on_the_diagonal_alone_is_laid_there():
    stick = [tile(120, 4)]
    placements = pack(stick, Plate(100, 100), 3.0)
    assert_kept_apart(placed(stick, placements), placements, Plate(100, 100), 3.0)


def test_what_fits_nowhere_is_named_by_its_place():
    with pytest.raises(OutputError) as caught:
        pack([tile(5, 5), tile(150, 4)], Plate(100, 100), 3.0)
    assert caught.value.ids == [1]


def test_tight_nesting_saves_a_plate_where_outlines_fit_into_one_another(monkeypatch):
    pytest.importorskip("spyrrow")
    monkeypatch.setattr(nesting, "SECONDS", 2)
    outlines, plate, gap = [bent_arm(40, 20)] * 6, Plate(170, 67), 2.0
    assert pack(outlines, plate, gap).n_plates == 2
    placements = nest([shapely.Polygon(points) for points in outlines], plate, gap)
    assert placements.n_plates == 1
    assert_kept_apart(placed(outlines, placements), placements, plate, gap)


def test_tight_nesting_needs_no_more_plates_than_plain_packing(monkeypatch):
    pytest.importorskip("spyrrow")
    monkeypatch.setattr(nesting, "SECONDS", 1)
    outlines = [tile(18, 18)] * 8
    placements = nest([shapely.Polygon(points) for points in outlines], Plate(42, 42), 2.0)
    assert placements.n_plates == 2
    assert_kept_apart(placed(outlines, placements), placements, Plate(42, 42), 2.0)


def test_tight_nesting_without_spyrrow_says_how_to_get_it(monkeypatch):
    monkeypatch.setitem(sys.modules, "spyrrow", None)
    with pytest.raises(OptionError, match="pip install"):
        nest([shapely.Polygon(tile(5, 5))], Plate(42, 42), 2.0)


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
