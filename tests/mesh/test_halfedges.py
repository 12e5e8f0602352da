"""Edges, twins and borders of known meshes."""

import numpy as np

from meshjig.mesh.halfedges import border_halfedges, compact, edge_keys, edges, next_halfedge
from tests.meshes import half_sphere, sphere

SQUARE = np.array([[0, 1, 2], [0, 2, 3]])  # two triangles that share the edge 0-2


def test_a_square_has_five_edges_and_one_pair_of_twins():
    e = edges(SQUARE)
    assert e.E.tolist() == [[0, 1], [0, 2], [0, 3], [1, 2], [2, 3]]
    assert e.n_faces.tolist() == [1, 2, 1, 1, 1]
    assert e.twin.tolist() == [0, 1, 3, 2, 4, 5]
    assert e.E[e.edge_of_halfedge].tolist() == [[0, 1], [1, 2], [0, 2], [0, 2], [2, 3], [0, 3]]


def test_three_faces_at_an_edge_have_no_twins_there():
    e = edges(np.array([[0, 1, 2], [1, 0, 3], [0, 1, 4]]))
    assert e.n_faces.max() == 3
    assert (e.twin == np.arange(9)).all()


def test_twins_are_mutual_and_run_against_each_other_on_a_closed_mesh():
    F = sphere(500).F
    twin = edges(F).twin
    assert (twin[twin] == np.arange(len(twin))).all()
    assert (twin != np.arange(len(twin))).all()
    assert (F.ravel()[twin] == F.ravel()[next_halfedge(np.arange(len(twin)))]).all()
    assert not len(border_halfedges(F))


def test_borders_are_the_edges_of_one_face():
    F = half_sphere(500).F
    e = edges(F)
    assert len(border_halfedges(F)) == (e.n_faces == 1).sum() > 0


def test_compact_keeps_order_and_edge_keys_do_not_know_direction():
    F, kept = compact(np.array([[7, 3, 9]]))
    assert (F.tolist(), kept.tolist()) == ([[1, 0, 2]], [3, 7, 9])
    assert edge_keys(np.array([[4, 2]]), 10) == edge_keys(np.array([[2, 4]]), 10) == 24
