"""Borders lose their knobs, pieces become one, and nothing of the surface gets lost by it."""

import itertools

import numpy as np
import pytest
import trimesh

from meshjig.layout.cells import cell_layout
from meshjig.layout.plain_borders import joined, numbered, without_knobs
from meshjig.mesh.components import components
from meshjig.mesh.halfedges import edges
from meshjig.mesh.measure import face_areas, sums
from meshjig.mesh.mesh import Mesh
from meshjig.options import Options
from meshjig.runtime.progress import Stages

N = 8


@pytest.fixture(scope="module")
def layout():
    ball = trimesh.creation.icosphere(4, 20.0)
    mesh = Mesh(np.asarray(ball.vertices, float), np.asarray(ball.faces, np.int64))
    return cell_layout(mesh, Options.of(pieces=N), Stages(None))


def neighbours(layout):
    piece, twin = layout.piece_of_face, edges(layout.cut.F).twin
    both = np.sort(np.stack([np.repeat(piece, 3), piece[twin // 3]], 1), axis=1)
    return np.unique(both[both[:, 0] != both[:, 1]], axis=0).tolist()


def areas(layout):
    return sums(layout.piece_of_face, face_areas(layout.cut.V, layout.cut.F), layout.stitching.n_pieces)


def border_length(layout, p, q):
    e, piece = edges(layout.cut.F), layout.piece_of_face
    h = np.flatnonzero((np.repeat(piece, 3) == p) & (piece[e.twin // 3] == q))
    ends = layout.cut.V[e.E[e.edge_of_halfedge[h]]]
    return np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1).sum()


def parts(layout):
    piece, twin = layout.piece_of_face, edges(layout.cut.F).twin
    return components(layout.cut.F, np.repeat(piece, 3) != piece[twin // 3])[0]


def test_one_border_gets_plain_and_all_others_stay(layout):
    p, q = neighbours(layout)[0]
    plain, count = without_knobs(layout, [(p, q)])
    assert 1 <= count <= 2
    assert border_length(plain, p, q) < border_length(layout, p, q) - 1
    changed = plain.piece_of_face != layout.piece_of_face
    assert set(layout.piece_of_face[changed]) | set(plain.piece_of_face[changed]) == {p, q}
    for one, other in neighbours(layout)[1:]:
        assert border_length(plain, one, other) == pytest.approx(border_length(layout, one, other))
    assert without_knobs(plain, [(p, q)])[1] == 0


def test_without_any_knob_pieces_are_their_cells_and_in_one_part(layout):
    pairs = list(itertools.combinations(range(N), 2))
    plain, count = without_knobs(layout, pairs)
    assert count == len(layout.knobs.span)
    assert parts(plain) == parts(layout) == N
    chart = plain.atlas.chart_of_face[plain.cut.parent]
    assert len(np.unique(np.stack([chart, plain.piece_of_face], 1), axis=0)) == len(np.unique(chart))
    assert areas(plain).sum() == pytest.approx(areas(layout).sum())
    assert sum(border_length(plain, p, q) for p, q in pairs) < 0.8 * sum(
        border_length(layout, p, q) for p, q in pairs
    )
    assert without_knobs(layout, [])[1] == 0


def test_two_pieces_become_one_by_the_first_one_s_number(layout):
    p, q = neighbours(layout)[-1]
    one, number = joined(layout, [(q, p)])
    assert one.stitching.n_pieces == N - 1 == parts(one)
    assert number[p] == number[q]
    assert sorted(set(number.tolist())) == list(range(N - 1))
    assert np.array_equal(one.piece_of_face, number[layout.piece_of_face])
    assert areas(one)[number[p]] == pytest.approx(areas(layout)[[p, q]].sum())


def test_a_chain_of_pieces_becomes_one(layout):
    one, number = joined(layout, [(0, 1), (1, 2), (3, 0)])
    assert len(set(number[:4].tolist())) == 1
    assert one.stitching.n_pieces == N - 3


def test_pieces_get_other_numbers_and_nothing_else(layout):
    number = np.random.default_rng(0).permutation(N)
    other = numbered(layout, number)
    assert np.array_equal(other.piece_of_face, number[layout.piece_of_face])
    assert np.array_equal(areas(other)[number], areas(layout))
