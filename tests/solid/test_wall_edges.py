import numpy as np
import pytest

from meshjig.mesh.halfedges import edges
from meshjig.mesh.measure import face_areas, mesh_volume
from meshjig.solid.wall_edges import bends, split_bent_walls
from tests.meshes import disc, sphere


def turning(V):
    """Directions that turn with the place, so that walls are twisted."""
    a = V[:, 0] / 8
    return 2 * np.stack([np.sin(a), np.cos(a) * np.sin(a), -np.ones(len(V))], 1)


@pytest.mark.parametrize("shape", [disc(150), sphere(150)])
def test_walls_come_out_flat_on_the_same_surface_and_sheet(shape):
    V, F = shape
    D = turning(V)
    label = (V[F].mean(1)[:, 1] > 3).astype(int)
    W, G, piece, E = split_bent_walls(V, F, label, D, 0.05)
    assert len(W) > len(V)
    assert (W[: len(V)] == V).all()
    e = edges(G)
    h = np.flatnonzero(np.repeat(piece, 3) != piece[e.twin // 3])
    between = e.E[e.edge_of_halfedge[h]]
    assert bends(W, W + E, *between.T).max() <= 0.05
    assert (edges(F).n_faces == 1).sum() == (e.n_faces == 1).sum()  # no edge has come apart
    for side in (0, 1):
        for before, after in ((V, W), (V + D, W + E)):
            area = face_areas(before, F)[label == side].sum()
            assert face_areas(after, G)[piece == side].sum() == pytest.approx(area)
    assert mesh_volume(W, G) == pytest.approx(mesh_volume(V, F), abs=1e-6)


def test_flat_walls_are_left_alone():
    V, F = disc(150)
    label = (V[F].mean(1)[:, 1] > 3).astype(int)
    W, G, _, _ = split_bent_walls(V, F, label, np.tile([0, 0, -2.0], (len(V), 1)), 0.01)
    assert len(W) == len(V)
    assert len(G) == len(F)


def test_a_bend_is_a_quarter_of_what_the_fourth_corner_stands_off():
    X = np.array([[0, 0, 0], [1.0, 0, 0]])
    Y = np.array([[0, 0, -2.0], [1.0, 0.4, -2.0]])
    assert bends(X, Y, np.array([0]), np.array([1])) == pytest.approx(0.1, rel=0.05)
