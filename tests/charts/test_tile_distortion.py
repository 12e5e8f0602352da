"""Stretch at the scale of tiles: noise does not count, stretch does."""

import numpy as np
import pytest

from meshjig.charts.atlas_distortion import quality
from meshjig.charts.tile_distortion import gate_share
from meshjig.mesh.types import Atlas, Mesh
from tests.meshes import Shape, disc, noisy


def plane():
    V, F = disc(20_000)
    return V, F, np.ascontiguousarray(V[:, :2])


def test_a_true_map_is_within_and_a_stretched_one_is_not():
    V, F, uv = plane()
    assert gate_share(V, F, uv, F, 5.0) == 1.0
    assert gate_share(V, F, uv * [1.3, 1 / 1.3], F, 5.0) == 0.0
    assert gate_share(V, F, 1.3 * uv, F, 5.0) == 0.0


def test_stretch_of_a_half_counts_by_its_area():
    V, F, uv = plane()
    uv[:, 0] = np.where(uv[:, 0] > 0, 1.0, 0.6) * uv[:, 0]
    share = gate_share(V, F, uv, F, 2.0)
    assert share < 0.6


@pytest.mark.parametrize("amount", [0.25, 0.4])
def test_noise_is_no_stretch(amount):
    V, F, uv = plane()
    rough = noisy(Shape(V, F), amount)
    atlas = Atlas(Mesh(rough.V, F), uv, F, np.zeros(len(F), np.int64))
    assert gate_share(rough.V, F, uv, F, 8.0) > 0.97
    assert quality(atlas)["gate_share_faces"] < 0.9
