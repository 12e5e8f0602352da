import numpy as np
import pytest

from meshjig.charts.border import border_loop
from meshjig.charts.flatten import border_is_simple
from meshjig.charts.part import part
from meshjig.charts.proxy import proxy
from meshjig.charts.split import split
from meshjig.charts.steady import steady
from meshjig.errors import ChartError
from meshjig.measure import face_areas
from meshjig.topology import components, is_disc
from tests.charts.helpers import all_turn_left
from tests.meshes import cylinder, disc, sphere


def nearly_a_ring(overlap, n=120, rows=6):
    """Bend a flat strip so far that its two ends overlap."""
    i, j = (x.ravel() for x in np.meshgrid(np.arange(n + 1), np.arange(rows + 1), indexing="ij"))
    angle, radius = (2 * np.pi + overlap) * i / n, 10 + 6 * j / rows
    uv = np.stack([radius * np.cos(-angle), radius * np.sin(-angle)], 1)
    a = (np.arange(n)[:, None] * (rows + 1) + np.arange(rows)[None]).ravel()
    F = np.concatenate([np.stack([a, a + rows + 1, a + rows + 2], 1), np.stack([a, a + rows + 2, a + 1], 1)])
    F = F.astype(np.int64)
    return uv, F if all_turn_left(uv, F) else F[:, ::-1].copy()


def test_ends_that_overlap_a_little_are_drawn_apart_and_the_rest_stays():
    uv, F = nearly_a_ring(0.02)
    V = np.column_stack([uv, np.linspace(0, 5, len(uv))])
    assert all_turn_left(uv, F)
    assert not border_is_simple(uv, F)
    clear = part(V, F, uv)
    assert all_turn_left(clear, F)
    assert border_is_simple(clear, F)
    far = uv[:, 0] < 0
    assert (clear[far] == uv[far]).all()


def test_the_border_loop_runs_with_the_chart_on_its_left():
    V, F = disc(600)
    loop = border_loop(F)
    np.testing.assert_allclose(np.linalg.norm(V[loop], axis=1), 50)
    x, y = V[np.append(loop, loop[0]), :2].T
    assert (x[:-1] * y[1:] - x[1:] * y[:-1]).sum() > 0
    assert len(np.unique(loop)) == len(loop)
    assert len(border_loop(sphere(100)[1])) == 0


def test_split_stops_as_soon_as_every_part_is_good():
    mesh = cylinder(600)
    label = split(*mesh, np.zeros(len(mesh.F), np.int64), lambda faces: is_disc(mesh.F[faces]), 0)
    assert 2 <= label.max() + 1 <= 4
    assert all(is_disc(mesh.F[label == k]) for k in range(label.max() + 1))
    small = split(*mesh, np.zeros(len(mesh.F), np.int64), lambda faces: len(faces) <= 50, 0)
    assert np.bincount(small).max() <= 50
    assert all(components(mesh.F[small == k])[0] == 1 for k in range(small.max() + 1))


def test_steady_moves_thin_faces_only_and_by_little():
    V, F = sphere(500)
    assert steady(V, F) is V
    V[F[100, 0]] = V[F[100, 1]]
    moved = steady(V, F)
    assert face_areas(moved, F).min() > 0
    shift = np.linalg.norm(moved - V, axis=1)
    thin = np.unique(F[face_areas(V, F) == 0])
    assert set(np.flatnonzero(shift)) == set(thin)
    assert shift.max() < 0.1
    with pytest.raises(ChartError, match="no extent"):
        steady(np.zeros_like(V), F)


def test_a_proxy_keeps_a_mesh_that_is_light_enough():
    V, F = disc(600)
    assert proxy(V, F, 500)[1] is F
