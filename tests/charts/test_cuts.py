import numpy as np
import pytest

from meshjig.charts.cuts import chains, cut_faces, cut_open
from meshjig.mesh.components import components
from meshjig.mesh.halfedges import edges
from tests.meshes import cylinder, disc, torus

Y_AND_LOOP = np.array([[0, 1], [1, 2], [2, 3], [2, 4], [6, 7], [5, 6], [5, 7]])


def test_chains_end_where_edges_end_or_branch_and_loops_are_one():
    found = {frozenset(map(tuple, Y_AND_LOOP[chain])) for chain in chains(Y_AND_LOOP, np.zeros(0, int))}
    assert found == {
        frozenset({(0, 1), (1, 2)}),
        frozenset({(2, 3)}),
        frozenset({(2, 4)}),
        frozenset({(5, 6), (6, 7), (5, 7)}),
    }


def test_chains_are_stopped_and_run_in_order():
    line = np.array([[3, 4], [0, 1], [2, 3], [1, 2], [4, 5]])
    whole, halves = chains(line, np.array([9])), chains(line, np.array([3]))
    assert [chain.tolist() for chain in whole] in ([[1, 3, 2, 0, 4]], [[4, 0, 2, 3, 1]])
    assert sorted(sorted(chain.tolist()) for chain in halves) == [[0, 4], [1, 2, 3]]


@pytest.mark.parametrize(("mesh", "n_parts"), [(torus(800), 1), (cylinder(400), 2), (disc(600), 2)])
def test_cutting_a_plane_through_parts_what_it_separates(mesh, n_parts):
    V, F = mesh
    e = edges(F)
    front = V[F].mean(1)[:, 1] > 0.1
    h = np.arange(3 * len(F))
    cut = np.zeros(len(e.E), bool)
    cut[e.edge_of_halfedge[h[front[h // 3] & ~front[e.twin // 3]]]] = True
    if n_parts == 1:  # only one of the two circles around the tube
        cut &= V[e.E[:, 0], 0] > 0
    corners, origin = cut_open(F, e, cut)
    assert (origin[corners] == F).all()
    assert components(corners)[0] == n_parts
    assert (edges(corners).n_faces == 1).sum() == (e.n_faces == 1).sum() + 2 * cut.sum()


def test_nothing_cut_is_nothing_changed():
    _, F = torus(800)
    e = edges(F)
    corners, origin = cut_open(F, e, np.zeros(len(e.E), bool))
    assert len(origin) == F.max() + 1
    assert (origin[corners] == F).all()


def test_faces_that_only_touch_at_a_point_have_corners_of_their_own():
    F = np.array([[0, 1, 2], [0, 3, 4]])
    e = edges(F)
    corners = cut_faces(F, e, np.zeros(len(e.E), bool), np.arange(2))
    assert len(np.unique(corners)) == 6
