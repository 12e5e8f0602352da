"""Stretch at the scale of tiles: noise does not count, stretch does."""

import numpy as np
import pytest

from meshjig.charts.atlas_distortion import atlas_distortion, share_at_scale
from meshjig.mesh.types import Atlas, Mesh
from tests.charts.helpers import unrolled_tube
from tests.meshes import Shape, disc, noisy


def flat_disc(scale=(1.0, 1.0)):
    V, F = disc(600)
    return Atlas(Mesh(V, F), V[:, :2] * scale, F, np.zeros(len(F), np.int64))


def test_a_copy_is_perfect():
    facts = atlas_distortion(flat_disc())
    assert facts.gate_share == pytest.approx(1)
    assert (facts.n_charts, facts.flips, facts.overlaps, facts.seam_over_sqrt_area) == (
        1,
        0,
        0,
        0,
    )


def test_stretch_beyond_the_limits_and_mirrored_faces_are_counted():
    assert atlas_distortion(flat_disc((1.24, 0.81))).gate_share == pytest.approx(1)
    assert atlas_distortion(flat_disc((1.26, 1.0))).gate_share == 0
    assert atlas_distortion(flat_disc((-1.0, 1.0))).flips == 600


def test_a_border_that_meets_itself_is_an_overlap():
    sheet = flat_disc()
    uv = sheet.uv.copy()
    rim = np.linalg.norm(uv, axis=1) > 49.9
    uv[rim & (uv[:, 0] > 30)] *= -0.9
    assert atlas_distortion(Atlas(sheet.mesh, uv, sheet.F_uv, sheet.chart_of_face)).overlaps == 1


def test_what_is_said_of_each_chart_adds_up():
    V, F = disc(600)
    chart = (V[F].mean(1)[:, 0] > 0).astype(np.int64)
    _, G = np.unique(F.ravel() * 2 + np.repeat(chart, 3), return_inverse=True)
    G = G.reshape(-1, 3).astype(np.int64)
    uv = np.empty((G.max() + 1, 2))
    uv[G] = V[F][..., :2] * np.where(chart, 1.0, 1.5)[:, None, None] + chart[:, None, None] * 200
    facts = atlas_distortion(Atlas(Mesh(V, F), uv, G, chart))
    left, right = facts.charts
    assert left.faces + right.faces == len(F)
    assert (left.gate_share, right.gate_share) == pytest.approx((0, 1))
    weighed = right.area_mm2 / (left.area_mm2 + right.area_mm2)
    assert facts.gate_share == pytest.approx(weighed)
    cut = facts.seam_over_sqrt_area * np.sqrt(np.pi) * 50
    assert cut == pytest.approx(100, rel=0.2)  # across the disc


def test_the_closing_line_of_a_ring_is_no_seam_but_that_of_a_cut_tube_is():
    V, F, uv, G = unrolled_tube()
    chart = np.zeros(len(F), np.int64)
    plain = atlas_distortion(Atlas(Mesh(V, F), uv, G, chart))
    ring = atlas_distortion(Atlas(Mesh(V, F), uv, G, chart, period=np.array([np.ptp(uv[:, 0])])))
    assert plain.seam_over_sqrt_area * np.sqrt(100 * 50 * np.pi) == pytest.approx(100, rel=0.02)
    assert ring.overlaps == 0
    assert ring.charts[0].period_mm == pytest.approx(50 * np.pi, rel=0.01)
    assert ring.seam_over_sqrt_area == 0


def test_a_ring_wider_than_its_period_lies_on_its_copy():
    V, F, uv, G = unrolled_tube()
    ring = Atlas(Mesh(V, F), uv, G, np.zeros(len(F), np.int64), period=np.array([100.0]))
    assert atlas_distortion(ring).overlaps == 1


def plane():
    V, F = disc(20_000)
    return V, F, np.ascontiguousarray(V[:, :2])


def test_a_true_map_is_within_and_a_stretched_one_is_not():
    V, F, uv = plane()
    assert share_at_scale(V, F, uv, F, 5.0) == 1.0
    assert share_at_scale(V, F, uv * [1.3, 1 / 1.3], F, 5.0) == 0.0
    assert share_at_scale(V, F, 1.3 * uv, F, 5.0) == 0.0


def test_stretch_of_a_half_counts_by_its_area():
    V, F, uv = plane()
    uv[:, 0] = np.where(uv[:, 0] > 0, 1.0, 0.6) * uv[:, 0]
    share = share_at_scale(V, F, uv, F, 2.0)
    assert share < 0.6


@pytest.mark.parametrize("amount", [0.25, 0.4])
def test_noise_is_no_stretch(amount):
    V, F, uv = plane()
    rough = noisy(Shape(V, F), amount)
    atlas = Atlas(Mesh(rough.V, F), uv, F, np.zeros(len(F), np.int64))
    assert share_at_scale(rough.V, F, uv, F, 8.0) > 0.97
    assert atlas_distortion(atlas).gate_share_faces < 0.9
