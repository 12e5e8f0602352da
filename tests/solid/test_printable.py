from collections import Counter

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from meshjig.errors import OutputError
from meshjig.mesh.measure import mesh_volume
from meshjig.solid.printable import all_printable, printable
from tests.meshes import Shape, closed_cylinder, creased_box, genus2, joined, sphere, torus
from tests.strategies import CLOSED, meshes

TETRAHEDRON = (
    np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]),
    np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]),
)


def reread(V, F):
    """Tell corners apart by their 32-bit values alone, as a reader of STL does."""
    number = {}
    return [
        [number.setdefault(tuple(corner), len(number)) for corner in face]
        for face in V.astype("f4")[F].tolist()
    ]


def open_halfedges(faces):
    """List directed edges without exactly one opposite; degenerate faces count too."""
    directed = Counter((f[k], f[(k + 1) % 3]) for f in faces for k in range(3))
    return [e for e, n in directed.items() if e[0] == e[1] or n != 1 or directed[e[::-1]] != 1]


def euler(faces):
    vertices = {v for f in faces for v in f}
    edges = {frozenset((f[k], f[(k + 1) % 3])) for f in faces for k in range(3)}
    return len(vertices) - len(edges) + len(faces)


def with_short_edges(V, F, share, seed):
    """Pull an end of random edges to within 1e-9 to 1e-4 mm of the other."""
    rng = np.random.default_rng(seed)
    V = V.copy()
    for f in rng.choice(len(F), int(share * len(F)), replace=False):
        a, b = F[f, :2]
        V[b] = V[a] + 10 ** rng.uniform(-9, -4) * rng.standard_normal(3)
    return V


@settings(max_examples=40, deadline=None)
@given(meshes(CLOSED, faces=(100, 900)), st.sampled_from([0.01, 0.1, 0.3]), st.integers(0, 999))
def test_short_edges_leave_the_file_closed_and_of_one_topology(mesh, share, seed):
    V, F = mesh
    broken = with_short_edges(V, F, share, seed)
    W, G = printable(broken, F)
    faces = reread(W, G)
    assert open_halfedges(faces) == []
    assert euler(faces) == euler(F.tolist())
    assert mesh_volume(W, G) == pytest.approx(mesh_volume(broken, F), rel=1e-4, abs=1e-3)


@pytest.mark.parametrize(
    "mesh", [sphere(800), torus(800), genus2(800), creased_box(600), closed_cylinder(500)]
)
def test_a_sound_solid_is_only_rounded(mesh):
    V, F = mesh
    W, G = printable(V, F)
    np.testing.assert_array_equal(G, F)
    np.testing.assert_array_equal(W, V.astype(np.float32))


def test_a_pinch_along_an_edge_stays_closed():
    V, F = TETRAHEDRON
    mirrored = V * [-1, -1, 1]  # shares the edge from (0, 0, 0) to (0, 0, 1)
    both = joined(Shape(20 * V, F), Shape(20 * mirrored, F))
    assert open_halfedges(reread(*both))
    W, G = printable(*both)
    assert open_halfedges(reread(W, G)) == []
    assert np.abs(W - both[0]).max() < 1e-3


def test_a_pinch_around_zero_stays_closed_for_readers_that_round():
    V, F = TETRAHEDRON
    half = V + np.array([2e-9, 0, 0])
    V, F = printable(*joined(Shape(half, F), Shape(half * [-1, -1, 1], F)))
    places = np.unique(np.round(V.astype(np.float32).astype(float), 8), axis=0)
    assert len(places) == len(V) == 8
    assert not open_halfedges(F.tolist())


def test_loose_triangles_are_joined():
    V, F = torus(600)
    W, G = printable(V[F].reshape(-1, 3), np.arange(3 * len(F)).reshape(-1, 3))
    assert len(W) == len(V)
    assert open_halfedges(reread(W, G)) == []


def test_many_at_once_come_out_as_each_by_itself_though_they_touch():
    V, F = torus(600)
    half = 20 * TETRAHEDRON[0]
    pinched = joined(Shape(half, TETRAHEDRON[1]), Shape(half * [-1, -1, 1], TETRAHEDRON[1]))
    loose = (V[F].reshape(-1, 3), np.arange(3 * len(F)).reshape(-1, 3))
    broken = (with_short_edges(V, F, 0.2, 1), F)
    solids = [(V, F), loose, broken, (V, F), (np.zeros((0, 3)), F[:0]), pinched]
    for (W, G), solid in zip(all_printable(solids), solids, strict=True):
        X, H = printable(*solid)
        np.testing.assert_array_equal(W, X)
        np.testing.assert_array_equal(G, H)
    assert all_printable([]) == []


def test_faces_without_extent_are_dropped():
    V, F = sphere(300)
    a, b = F[0, :2]
    thin = np.array([[a, a, b], [b, b, b]])
    _, G = printable(V, np.concatenate([F, thin]))
    np.testing.assert_array_equal(G, F)


def test_a_speck_far_from_the_origin_stays_closed():
    V, F = TETRAHEDRON
    W, G = printable(1e-8 * V + 140.0, F)
    assert open_halfedges(reread(W, G)) == []
    assert np.abs(W - 140).max() < 0.01


def test_negative_zero_is_zero():
    V, F = TETRAHEDRON
    W, _ = printable(V * [-1, -1, 1] - 1e-60 * V, F[:, ::-1])
    assert not np.signbit(W[W == 0]).any()


def test_points_that_are_not_finite_are_refused():
    V, F = TETRAHEDRON
    V = V.copy()
    V[1, 2] = np.nan
    with pytest.raises(OutputError, match="not finite"):
        printable(V, F)


def test_short_edges_are_gone():
    V, F = sphere(2000)
    V = V.copy()
    chosen = np.arange(0, len(F), 97)
    _, first = np.unique(F[chosen, :2], return_index=True)
    chosen = chosen[np.bincount(first // 2, minlength=len(chosen)) == 2]  # no two share a vertex
    assert len(chosen) > 10
    V[F[chosen, 1]] = V[F[chosen, 0]] + 1e-5
    W, G = printable(V, F)
    assert len(G) == len(F) - 2 * len(chosen)
    assert np.linalg.norm(W[G] - W[np.roll(G, 1, axis=1)], axis=2).min() > 0.1
