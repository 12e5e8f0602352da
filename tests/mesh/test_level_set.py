"""Faces cut along the line where a function is zero."""

import numpy as np
import trimesh

from meshjig.mesh.halfedges import edges
from meshjig.mesh.level_set import split_at_zero
from meshjig.mesh.measure import face_areas


def test_a_ball_is_cut_along_a_circle() -> None:
    ball = trimesh.creation.icosphere(3, 10.0)
    V, F = np.asarray(ball.vertices, float), np.asarray(ball.faces, np.int64)
    values = V[:, 2] - 3.21
    split = split_at_zero(V, F, values)
    assert (split.V[: len(V)] == V).all()
    assert (edges(split.F).n_faces == 2).all()
    assert np.isclose(face_areas(split.V, split.F).sum(), face_areas(V, F).sum())
    middle = split.V[split.F].mean(axis=1)
    assert (
        np.sign(middle[:, 2] - 3.21)[np.abs(middle[:, 2] - 3.21) > 0.2]
        == split.sign[np.abs(middle[:, 2] - 3.21) > 0.2]
    ).all()
    twin = edges(split.F).twin
    rim = np.flatnonzero(np.repeat(split.sign, 3) != split.sign[twin // 3])
    height = split.V[split.F.ravel()[rim], 2]
    assert len(rim) > 20
    assert np.abs(height - 3.21).max() < 0.2  # led through vertices where it passes close to them
    assert np.median(np.abs(height - 3.21)) < 1e-9


def test_parts_lie_in_their_parents() -> None:
    V = np.array([[0, 0, 0], [4, 0, 0], [0, 4, 0], [4, 4, 0]], float)
    F = np.array([[0, 1, 2], [1, 3, 2]])
    split = split_at_zero(V, F, np.array([-1.0, 1.0, 1.0, 1.0]))
    assert split.parent.tolist().count(1) == 1
    assert split.parent.tolist().count(0) == 3
    assert np.allclose(np.bincount(split.parent, face_areas(split.V, split.F)), 8.0)
    assert sorted(split.sign.tolist()) == [-1, 1, 1, 1]


def test_a_line_at_a_vertex_makes_no_slivers() -> None:
    V = np.array([[0, 0, 0], [4, 0, 0], [0, 4, 0]], float)
    split = split_at_zero(V, np.array([[0, 1, 2]]), np.array([-1e-3, 1.0, 1.0]))
    assert len(split.F) == 1
    assert split.sign.tolist() == [1]
