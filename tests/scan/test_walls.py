"""Bodies that share a wall, an edge or a corner become bodies of their own, whatever the file has."""

import itertools

import numpy as np
import pytest

from meshjig.mesh.boundary_loops import border_loops
from meshjig.mesh.components import components
from meshjig.mesh.measure import mesh_volume
from meshjig.scan import repair
from tests.meshes import Shape, sphere
from tests.scan.boxes import box, welded, without_wall


def flipped_wall(shape):
    wall = (np.abs(shape.V[shape.F][:, :, 0] - 0.5) < 1e-9).all(1)
    return Shape(shape.V, np.where(wall[:, None], shape.F[:, ::-1], shape.F))


def inside_out(shape):
    return Shape(shape.V, shape.F[:, ::-1])


def soup(shape):
    return Shape(shape.V[shape.F].reshape(-1, 3), np.arange(shape.F.size).reshape(-1, 3))


def other_diagonals(shape):
    """A box at (1, 0, 0) whose squares at x = 0.5 are halved the other way."""
    mirrored = shape.V * [1, -1, 1]
    return Shape(mirrored, shape.F[:, ::-1])


TWO = welded(box(), box((1, 0, 0)))
ONE_WALL = welded(box(), without_wall(box((1, 0, 0)), 0.5))
IN_CONTACT = {
    "a wall twice": (TWO, 2),
    "a wall twice, halved in two ways": (welded(box(), other_diagonals(box((1, 0, 0)))), 2),
    "a wall once": (ONE_WALL, 2),
    "a wall once, turned": (flipped_wall(ONE_WALL), 2),
    "one inside out": (welded(box(), inside_out(box((1, 0, 0)))), 2),
    "a soup": (soup(TWO), 2),
    "an edge": (welded(box(), box((1, 1, 0))), 2),
    "a corner": (welded(box(), box((1, 1, 1))), 2),
    "a ring of edges": (welded(*(box(at) for at in ((0, 0, 0), (1, 1, 0), (2, 0, 0), (1, -1, 0)))), 4),
    "a cube of cubes": (welded(*(box(at, 1) for at in itertools.product(range(3), repeat=3))), 27),
    "around a hollow": (
        welded(*(box(at, 1) for at in itertools.product(range(3), repeat=3) if at != (1, 1, 1))),
        26,
    ),
}


@pytest.mark.parametrize("name", IN_CONTACT)
def test_each_body_is_closed_by_its_own_faces(name):
    mesh, n_bodies = IN_CONTACT[name]
    V, F, _ = repair(*mesh)
    n, component = components(F)
    assert (n, border_loops(F)) == (n_bodies, [])
    volumes = [mesh_volume(V, F[component == k]) for k in range(n)]
    assert volumes == pytest.approx([1.0] * n_bodies)


def test_faces_between_two_bodies_are_counted():
    assert repair(*ONE_WALL).changes.shared_walls == 8
    assert repair(*welded(box(), box((1, 1, 0)))).changes.shared_walls == 0


def test_a_sheet_that_stands_on_a_body_is_no_wall():
    mesh = sphere(320)
    a, b = mesh.F[0, 0], mesh.F[0, 1]
    V = np.concatenate([mesh.V, [2 * mesh.V[a], 2 * mesh.V[b]]])
    n = len(mesh.V)
    result = repair(V, np.concatenate([mesh.F, [[a, b, n], [b, n + 1, n]]]))
    assert result.changes.shared_walls == 0
    n, component = components(result.F)
    assert n == 2
    body = np.bincount(component).argmax()
    assert mesh_volume(result.V, result.F[component == body]) == pytest.approx(mesh_volume(*mesh))
