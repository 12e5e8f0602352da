"""Bending around a pole makes polygons round and leaves corners, rays and what is far where they are."""

import numpy as np

from meshjig.tiling.poles.net import Circle, PolarBend

POLE = np.array([3.0, -7.0])


def circle(n, radius):
    return Circle(2 * np.pi * (np.arange(n) + 0.3) / n, np.full(n, radius))


def corners(one):
    return POLE + one.radius[:, None] * np.stack([np.cos(one.angle), np.sin(one.angle)], 1)


def test_regular_polygons_become_circles():
    some = [circle(7, 20.0), circle(5, 9.0)]
    bend = PolarBend(POLE, some)
    for one in some:
        a = corners(one)
        t = np.linspace(0, 1, 30)[:, None, None]
        sides = a + t * (np.roll(a, -1, 0) - a)
        np.testing.assert_allclose(np.linalg.norm(bend(sides) - POLE, axis=-1), one.radius[0])


def test_corners_and_the_plane_far_away_stay():
    some = [circle(6, 20.0), circle(4, 8.0)]
    bend = PolarBend(POLE, some)
    far = POLE + 27.0 * np.stack([np.cos(np.arange(50)), np.sin(np.arange(50))], 1)
    for points in (far, POLE[None], *map(corners, some)):
        np.testing.assert_allclose(bend(points), points, atol=1e-9)


def test_along_a_ray_order_is_kept():
    bend = PolarBend(POLE, [circle(4, 20.0), circle(4, 12.0)])
    ahead = np.stack([np.cos(np.arange(40)), np.sin(np.arange(40))], 1)
    away = np.linspace(0.01, 40, 300)
    bent = bend(POLE + away[:, None, None] * ahead) - POLE
    np.testing.assert_allclose(bent[..., 0] * ahead[:, 1], bent[..., 1] * ahead[:, 0], atol=1e-9)
    assert (np.diff(np.linalg.norm(bent, axis=-1), axis=0) > 0).all()
