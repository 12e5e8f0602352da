import numpy as np
import pytest

from meshjig.charts.flatten.flatten import flatten
from meshjig.charts.flatten.untangle import untangle
from meshjig.charts.transfer.proxy import proxy_mesh
from meshjig.charts.transfer.transfer_labels import transfer_labels, transfer_uv
from meshjig.mesh.components import components
from meshjig.mesh.halfedges import edges
from meshjig.mesh.measure import face_areas, singular_values
from meshjig.mesh.mesh import Mesh
from tests.charts.helpers import all_turn_left
from tests.meshes import creased_box, disc, half_sphere, noisy, sphere


def test_labels_follow_the_surface():
    V, F = sphere(20000)
    W, G = proxy_mesh(Mesh(V, F), 1000)
    octant = lambda P: (P > 0) @ np.array([1, 2, 4])  # noqa: E731
    label = transfer_labels(Mesh(V, F), Mesh(W, G), octant(W[G].mean(1)))
    clear = (np.abs(V[F].mean(1)) > 5).all(1)
    assert (label == octant(V[F].mean(1)))[clear].all()
    assert set(label) == set(range(8))


def test_the_two_sides_of_a_thin_sheet_are_told_apart():
    top = disc(3000)
    V = np.concatenate([top.V + np.array([0, 0, 0.02]), top.V - np.array([0, 0, 0.02])])
    F = np.concatenate([top.F, top.F[:, ::-1] + len(top.V)])
    # On one half, the proxy's sheets have changed places by a hair, as decimation may do.
    swapped = np.where((V[:, :1] > 0) & [[False, False, True]], -V, V)
    label = transfer_labels(Mesh(V, F[: len(top.F)]), Mesh(swapped, F), np.repeat([0, 1], len(top.F)))
    assert (label == 0).all()


def spread_of_stretch(V, F, uv):
    """Give both stretches that a tenth, half and nine tenths of the area stay below."""
    area = face_areas(V, F)
    rows = []
    for stretch in singular_values(V, F, uv).T:
        order = np.argsort(stretch)
        below = np.cumsum(area[order]) / area.sum()
        rows.append(stretch[order][np.searchsorted(below, [0.1, 0.5, 0.9])])
    return np.array(rows)


@pytest.mark.parametrize("amount", [0.0, 0.2])
def test_a_map_carried_from_the_proxy_is_as_flat_as_the_proxy_and_nowhere_mirrored(amount):
    V, F = noisy(half_sphere(20000), amount)
    W, G = proxy_mesh(Mesh(V, F), 1000)
    light = flatten(W, G)
    uv = untangle(V, F, transfer_uv(V, W, G, light))
    assert all_turn_left(uv, F)
    before, after = (spread_of_stretch(*m) for m in ((W, G, light), (V, F, uv)))
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


def test_borders_are_straight_across_the_faces_of_the_proxy():
    V, F = disc(20000)
    W, G = disc(600)
    label = transfer_labels(Mesh(V, F), Mesh(W, G), (W[G].mean(1)[:, 0] > 3.3).astype(np.int64))
    e = edges(F)
    h = np.flatnonzero(e.twin > np.arange(len(e.twin)))
    rim = h[label[h // 3] != label[e.twin[h] // 3]]
    x = V[F.ravel()[rim], 0]
    teeth = np.abs(W[G].mean(1)[:, 0] - 3.3).min()
    assert np.abs(x - np.median(x)).max() < 2.5  # the proxy's faces are 10 mm wide
    assert teeth < 2.5


def test_a_strip_one_face_wide_comes_through():
    V, F = disc(20000)
    W, G = disc(600)
    label = np.digitize(W[G].mean(1)[:, 0], [-4, 4])
    transferred = transfer_labels(Mesh(V, F), Mesh(W, G), label)
    before, after = (face_areas(*m)[k == 1].sum() for m, k in (((W, G), label), ((V, F), transferred)))
    assert after == pytest.approx(before, rel=0.15)
    assert components(F[transferred == 1])[0] == 1


def test_a_fold_holds_a_border():
    V, F = creased_box(12000)
    W, G = creased_box(700)
    top = (W[G].mean(1)[:, 2] > 49.9).astype(np.int64)
    wrong = transfer_labels(Mesh(V, F), Mesh(W, G), top) != (V[F].mean(1)[:, 2] > 49.9)
    assert (np.abs(V[F[wrong]].mean(1)) > 48).all()  # at the four corners, faces would stick out like teeth
