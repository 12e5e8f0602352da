import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from meshjig.charts.segment.accept import Acceptance, ConformalDistortion
from meshjig.charts.segment.segment import segment, unwrap
from meshjig.errors import OptionError
from meshjig.mesh.components import is_disc
from tests.meshes import closed_cylinder, creased_box, cylinder, genus2, half_sphere, saddle, sphere, torus


@pytest.mark.parametrize(
    ("mesh", "at_most"),
    [
        (sphere(1500), 4),
        (torus(1500), 6),
        (creased_box(1200), 4),
        (closed_cylinder(1200), 5),
        (cylinder(1200), 3),
        (genus2(1500), 10),
        (saddle(1000), 2),
    ],
)
def test_charts_are_few_discs_that_cover_the_mesh(mesh, at_most):
    label = segment(*mesh)
    n = label.max() + 1
    assert 1 <= n <= at_most
    assert (np.bincount(label) > 0).all()
    assert all(is_disc(mesh.F[label == k]) for k in range(n))


@settings(max_examples=10, deadline=None)
@given(st.integers(1, 40), st.integers(0, 100))
def test_any_number_of_patches_and_any_seed_gives_good_charts(n_patches, seed):
    mesh = torus(300)
    label = segment(*mesh, n_patches=n_patches, seed=seed)
    acceptance = Acceptance(*mesh)
    for k in range(label.max() + 1):
        faces = np.flatnonzero(label == k)
        assert len(faces) == 1 or acceptance.accepts(faces)


def test_equal_seeds_give_equal_charts():
    mesh = genus2(1500)
    assert (segment(*mesh, seed=3) == segment(*mesh, seed=3)).all()


def test_the_judge_refuses_what_is_no_disc_or_too_round():
    tube, bowl = cylinder(600), half_sphere(1500)
    assert not Acceptance(*tube).accepts(np.arange(len(tube.F)))
    assert ConformalDistortion(*bowl).spread(np.arange(len(bowl.F))) > 0.6
    assert not Acceptance(*bowl).accepts(np.arange(len(bowl.F)))
    cap = np.flatnonzero(bowl.V[bowl.F].mean(1)[:, 2] > 40)
    assert Acceptance(*bowl).accepts(cap)


@pytest.mark.parametrize("mesh", [sphere(800), torus(800), cylinder(400), creased_box(300)])
def test_every_chart_is_a_disc(mesh):
    label = unwrap(*mesh)
    assert set(label) == set(range(label.max() + 1))
    assert all(is_disc(mesh.F[label == k]) for k in range(label.max() + 1))


def test_a_box_falls_into_its_flat_sides():
    V, F = creased_box(300)
    side = np.abs(V[F].mean(1)).argmax(1) * 2 + (V[F].mean(1).sum(1) > 0)
    label = unwrap(V, F)
    assert all(len(set(side[label == k])) <= 2 for k in range(label.max() + 1))


def test_its_options_are_heard():
    few, many = (unwrap(*sphere(800), options={"max_chart_area": area}) for area in (0.0, 1000.0))
    assert many.max() > 2 * few.max()


def test_wrong_options_are_named():
    with pytest.raises(OptionError, match=r"'max_cots': xatlas knows .*max_cost"):
        unwrap(*sphere(100), options={"max_cots": 1.0})
    with pytest.raises(OptionError, match="max_cost can't be 'low'"):
        unwrap(*sphere(100), options={"max_cost": "low"})
