import numpy as np
import pytest

from meshjig.charts.flatten import flatten
from meshjig.charts.proxy import proxy
from meshjig.charts.transfer import transfer_labels, transfer_uv
from meshjig.charts.untangle import untangle
from meshjig.measure import singular_values
from tests.charts.helpers import all_turn_left
from tests.meshes import disc, half_sphere, noisy, sphere


def test_labels_follow_the_surface():
    V, F = sphere(20000)
    W, G = proxy(V, F, 1000)
    octant = lambda P: (P > 0) @ np.array([1, 2, 4])  # noqa: E731
    label = transfer_labels(V, F, W, G, octant(W[G].mean(1)))
    clear = (np.abs(V[F].mean(1)) > 5).all(1)
    assert (label == octant(V[F].mean(1)))[clear].all()
    assert set(label) == set(range(8))


def test_the_two_sides_of_a_thin_sheet_are_told_apart():
    top = disc(3000)
    V = np.concatenate([top.V + np.array([0, 0, 0.02]), top.V - np.array([0, 0, 0.02])])
    F = np.concatenate([top.F, top.F[:, ::-1] + len(top.V)])
    # On one half, the proxy's sheets have changed places by a hair, as decimation may do.
    swapped = np.where((V[:, :1] > 0) & [[False, False, True]], -V, V)
    label = transfer_labels(V, F[: len(top.F)], swapped, F, np.repeat([0, 1], len(top.F)))
    assert (label == 0).all()


@pytest.mark.parametrize("amount", [0.0, 0.2])
def test_a_map_carried_from_the_proxy_is_as_flat_as_the_proxy_and_nowhere_mirrored(amount):
    V, F = noisy(half_sphere(20000), amount)
    W, G = proxy(V, F, 1000)
    light = flatten(W, G)
    uv = untangle(V, F, transfer_uv(V, W, G, light))
    assert all_turn_left(uv, F)
    share = [0.1, 0.5, 0.9]
    before, after = (np.quantile(singular_values(*m), share, axis=0) for m in ((W, G, light), (V, F, uv)))
    np.testing.assert_allclose(after, before, atol=0.05 + amount)


def test_untangle_moves_only_what_is_mirrored():
    V, F = disc(3000)
    rng = np.random.default_rng(0)
    swapped = rng.choice(len(V), 8, replace=False)
    uv = V[:, :2].copy()
    uv[swapped] += 3 * rng.normal(size=(8, 2))
    clean = untangle(V, F, uv)
    assert not all_turn_left(uv, F)
    assert all_turn_left(clean, F)
    far = np.linalg.norm(V[:, None] - V[swapped][None], axis=2).min(1) > 25
    assert (clean[far] == V[far, :2]).all()
