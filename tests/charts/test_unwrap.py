import numpy as np
import pytest

from meshjig.charts.unwrap import unwrap
from meshjig.errors import OptionError
from meshjig.mesh.components import is_disc
from tests.meshes import creased_box, cylinder, sphere, torus


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
