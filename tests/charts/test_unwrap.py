import numpy as np
import pytest

from meshjig.charts.unwrap import unwrap
from meshjig.topology import is_disc
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
