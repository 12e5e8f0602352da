import manifold3d
import numpy as np
import pytest

from meshjig.output.pictures.render import render
from meshjig.output.pictures.scene import scene_of, shifted
from meshjig.output.pictures.view import view_of
from tests.meshes import RADIUS, Shape, closed_cylinder, disc, joined, moved, sphere

SIZE = 200
Y = np.array([0.0, 1, 0])


def picture(V, F, ids=None, colour=(0.9, 0.3, 0.2), **how):
    ids = np.zeros(len(F), np.int64) if ids is None else ids
    scene = scene_of(V, F, np.tile(colour, (len(F), 1)), ids)
    return render(scene, view_of(V, Y, 30, 18), SIZE, **how).astype(int)


def is_white(image):
    return (image == 255).all(axis=2)


@pytest.mark.parametrize("far", [0, 1e4])
def test_a_sphere_is_a_round_patch_without_holes_on_white(far):
    V, F = sphere(20_000)
    image = picture(V + far, F)
    row, column = np.indices((SIZE, SIZE)) + 0.5
    r = np.hypot(row - SIZE / 2, column - SIZE / 2)
    assert not is_white(image)[r < SIZE / 2 - 2].any()
    assert is_white(image)[r > SIZE / 2 + 2].all()


def test_light_comes_from_above_and_in_the_right_hue():
    image = picture(*sphere(20_000))
    top, bottom = image[SIZE // 5, SIZE // 2], image[-SIZE // 5, SIZE // 2]
    assert top.sum() > 1.2 * bottom.sum()
    assert (image[SIZE // 2, SIZE // 2].argsort() == [2, 1, 0]).all()


def test_shades_are_smooth_on_a_coarse_sphere():
    image = picture(*sphere(1200))[:, :, 0]
    inside = image[60:140, 60:140]
    assert np.abs(np.diff(inside, axis=0)).max() < 12
    assert np.ptp(inside) > 20


def test_a_dark_line_runs_where_the_id_changes():
    V, F = sphere(20_000)
    upper = (V[F].mean(axis=1)[:, 1] > 0).astype(np.int64)
    with_line, without = picture(V, F, upper), picture(V, F, upper, line=0.0)
    plain = picture(V, F)
    left = (with_line.sum(axis=2) / plain.sum(axis=2))[20:180, 40:160]  # of the light
    assert left.min(axis=0).max() < 0.75  # unbroken
    assert (left < 0.95).sum(axis=0).max() <= 5  # thin
    assert np.abs(plain - without)[20:180, 40:160].max() < 60


def test_fog_fades_what_is_far():
    V, F = joined(sphere(3000), moved(sphere(3000), [-2.0 * RADIUS, 0, -6 * RADIUS]))
    clear, fogged = picture(V, F), picture(V, F, fog=0.8)
    change = np.abs(fogged - clear).sum(axis=2)
    assert change.max() > 200
    assert (change[~is_white(clear)] < 5).mean() > 0.2


def test_hollows_are_darker_than_open_places():
    V, F = closed_cylinder(3000)
    floor = np.array([[-1.0, 0, -1], [-1, 0, 1], [1, 0, 1], [1, 0, -1]]) * 6 * RADIUS
    low = [0, V[:, 1].min(), 0]
    W, G = joined(Shape(floor + low, np.array([[0, 1, 2], [0, 2, 3]])), Shape(V, F))
    scene = scene_of(W, G, np.full((len(G), 3), 0.8), np.zeros(len(G), np.int64))
    view = view_of(W, Y, 0, 60)
    image = render(scene, view, SIZE).sum(axis=2).astype(int)
    foot = (np.array([[0, low[1], V[:, 2].max() + 0.3], [0, low[1], 4 * RADIUS]]) - view.eye) @ view.axes.T
    place = (foot[:, :2] / foot[:, 2:] - view.centre) / view.half * (1, -1) * SIZE / 2 + SIZE / 2
    (x, y), (u, v) = place.astype(int)
    assert image[y, x] < 0.93 * image[v, u]


def test_shifted_is_a_scene_of_the_shifted_points():
    V, F = joined(sphere(2000), sphere(2000))
    V[len(V) // 2 :] += [3 * RADIUS, 0, 0]
    W = V.copy()
    W[len(V) // 2 :] += [0, 2 * RADIUS, 0]
    ids = np.repeat([0, 1], len(F) // 2)
    colour = np.full((len(F), 3), 0.5)
    view = view_of(W, Y, 30, 18)
    moved = render(shifted(scene_of(V, F, colour, ids), W), view, SIZE)
    np.testing.assert_array_equal(moved, render(scene_of(W, F, colour, ids), view, SIZE))


def test_an_open_sheet_is_lit_from_either_side():
    V, F = disc(500)
    V = V[:, [0, 2, 1]]
    front, back = picture(V, F, line=0.0), picture(V, F[:, ::-1], line=0.0)
    assert np.abs(front - back).max() <= 2


def test_a_flat_side_is_evenly_shaded_whatever_its_triangles():
    turn = np.arange(120) * np.pi / 60
    radius = np.where(np.arange(120) % 2, 14.0, 30.0)
    ring = radius[:, None] * np.stack([np.cos(turn), np.sin(turn)], 1)
    star = manifold3d.Manifold.extrude(manifold3d.CrossSection([ring]), 2.0).to_mesh64()
    V, F = np.array(star.vert_properties, float)[:, [1, 2, 0]], np.array(star.tri_verts, np.int64)
    row, column = np.indices((SIZE, SIZE)) - SIZE / 2
    scene = scene_of(V, F, np.full((len(F), 3), 0.8), np.zeros(len(F), np.int64))
    image = render(scene, view_of(V, Y, 0, 90), SIZE).astype(int)
    assert np.ptp(image[np.hypot(row, column) < 0.4 * SIZE * 14 / 30], axis=0).max() <= 1
