"""Warps bend the plane within a box, one-to-one, and leave its border alone."""

import numpy as np
import pytest

from meshjig.tiling.warp import random_warp

BOX = np.array([3.0, 4.0, 123.0, 84.0])
STYLES = ["bspline", "bilinear"]


def warp(amount, style, seed=0, period=0.0, box=BOX, tile=15.0):
    return random_warp(box, tile, amount, style, np.random.default_rng(seed), period)


def grid(n=400, box=BOX):
    u, v = np.linspace(box[0], box[2], n), np.linspace(box[1], box[3], n)
    return np.stack(np.meshgrid(u, v, indexing="ij"), -1)


@pytest.mark.parametrize("style", STYLES)
@pytest.mark.parametrize("period", [0.0, 120.0])
@pytest.mark.parametrize("seed", range(5))
def test_no_part_of_the_plane_folds_or_vanishes(style, period, seed):
    x = grid()
    y = warp(1.0, style, seed, period)(x[:-1] if period else x)
    d, e = np.diff(y, axis=0)[:, :-1], np.diff(y, axis=1)[:-1]
    area = d[..., 0] * e[..., 1] - d[..., 1] * e[..., 0]
    assert area.min() > 0.15 * area.mean()


@pytest.mark.parametrize("style", STYLES)
def test_borders_are_kept(style):
    bend = warp(1.0, style)
    edge = np.concatenate([x.reshape(-1, 2) for x in (grid()[0], grid()[-1], grid()[:, 0], grid()[:, -1])])
    np.testing.assert_allclose(bend(edge), edge, atol=1e-9)
    beyond = edge + 50 * np.sign(edge - edge.mean(0))
    np.testing.assert_allclose(bend(beyond), beyond, atol=1e-9)


@pytest.mark.parametrize("style", STYLES)
def test_with_a_period_the_map_repeats_and_moves_the_closing_line(style):
    bend = warp(1.0, style, period=120.0)
    x = np.random.default_rng(1).uniform(BOX[:2], BOX[2:], (500, 2))
    by = np.array([120.0, 0.0])
    np.testing.assert_allclose(bend(x + by), bend(x) + by, atol=1e-9)
    closing = grid()[0]
    assert np.linalg.norm(bend(closing) - closing, axis=1).max() > 1.0
    np.testing.assert_allclose(bend(closing - [1e-7, 0.0]), bend(closing), atol=1e-6)
    rims = np.concatenate([grid()[:, 0], grid()[:, -1]])
    np.testing.assert_allclose(bend(rims), rims, atol=1e-9)


@pytest.mark.parametrize("style", STYLES)
def test_more_moves_more(style):
    moved = [np.linalg.norm(warp(a, style)(grid()) - grid(), axis=2).mean() for a in (0.2, 0.5, 1.0)]
    assert 0.2 < moved[0] < 0.6 * moved[1] < 0.6 * moved[2]
    assert np.linalg.norm(warp(0.7, style)(grid()) - grid(), axis=2).max() > 0.1 * 15.0


def test_a_cubic_bends_smoothly_and_a_bilinear_map_does_not():
    line = np.stack([np.linspace(3, 123, 4001), np.full(4001, 44.0)], 1)
    turns = []
    for style in STYLES:
        direction = np.diff(warp(0.7, style)(line), axis=0)
        turns.append(np.abs(np.diff(np.arctan2(direction[:, 1], direction[:, 0]))).max())
    assert turns[0] < 0.01 < turns[1]


@pytest.mark.parametrize("style", STYLES)
def test_a_chart_of_one_tile_or_less_is_fine(style):
    for box in (np.array([0.0, 0.0, 4.0, 3.0]), np.array([0.0, 0.0, 200.0, 3.0])):
        bend = warp(1.0, style, box=box)
        if bend is not None:
            assert np.isfinite(bend(grid(20, box))).all()
