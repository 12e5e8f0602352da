"""Whatever the values of a field, its contour is a closed manifold."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from meshjig.mesh.halfedges import border_halfedges
from meshjig.mesh.measure import mesh_volume
from meshjig.scan import self_crossings
from meshjig.scan.contour import contour
from meshjig.scan.field import Field, follow, steps, well_composed
from meshjig.scan.manifold import is_clean

FAR = np.array([[900.0, 0, 0], [901, 0, 0], [900, 1, 0]]), np.array([[0, 1, 2]])


def field_of(values):
    """Make a field of values on a grid of edge 1, surrounded by outside."""
    padded = np.pad(values, 2, constant_values=1.0)
    ijk = np.stack(np.meshgrid(*map(np.arange, padded.shape), indexing="ij"), -1).reshape(-1, 3)
    key = steps(ijk)
    order = np.argsort(key)
    none = np.zeros(0, np.int64)
    return follow(Field(*FAR, np.zeros(3), 1.0, key[order], padded.ravel()[order], key[order], none))


def noise(seed, side, inside):
    rng = np.random.default_rng(seed)
    return rng.uniform(0.05, 1, (side, side, side)) * np.where(rng.random((side, side, side)) < inside, -1, 1)


@given(st.integers(0, 2**32), st.integers(1, 6), st.sampled_from([0.05, 0.2, 0.5, 0.8]))
@settings(max_examples=60, deadline=None)
def test_noise_has_a_manifold_contour_that_crosses_nothing_in_the_middles_of_its_cubes(seed, side, inside):
    field = well_composed(field_of(noise(seed, side, inside)))
    made = contour(field)
    if not len(made.F):
        assert (field.value > 0).all()
        return
    assert is_clean(made.F, len(made.V))
    assert len(border_halfedges(made.F)) == 0
    assert len(self_crossings(made.centre, made.F)) == 0
    assert mesh_volume(made.V, made.F) > 0
    assert (np.abs(made.V - made.centre) <= 1).all()


@given(st.integers(0, 2**32))
@settings(max_examples=30, deadline=None)
def test_only_outer_corners_are_filled_and_none_far_from_the_inside(seed):
    before = field_of(noise(seed, 4, 0.3))
    after = well_composed(before)
    np.testing.assert_array_equal(before.key, after.key)
    changed = before.value != after.value
    assert (before.value[changed] > 0).all()
    assert (after.value[changed] < 0).all()


def test_the_contour_of_a_distance_is_where_the_distance_is_zero():
    x = np.stack(np.meshgrid(*[np.arange(30.0)] * 3, indexing="ij"), -1) - 14.3
    made = contour(well_composed(field_of(np.linalg.norm(x, axis=-1) - 11.0)))
    radius = np.linalg.norm(made.V - 14.3 - 2, axis=1)
    assert np.abs(radius - 11).max() < 0.05
    assert mesh_volume(made.V, made.F) > 0
