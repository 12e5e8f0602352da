"""A fine mesh is thinned out in little time and stays what it is: its surface, its borders, its handles."""

import numpy as np
import pytest

from meshjig.mesh.components import components
from meshjig.mesh.halfedges import border_halfedges
from meshjig.mesh.measure import mesh_volume
from meshjig.scan import scale
from meshjig.scan.collapse import collapse_fast
from meshjig.scan.manifold import is_clean
from tests.meshes import genus2, half_sphere, noisy, open_cup, sphere, topology, torus, two_components


@pytest.mark.parametrize("maker", [sphere, torus, genus2, half_sphere, open_cup, two_components])
def test_thinning_keeps_topology_and_shape(maker):
    mesh = noisy(maker(20_000), 0.2)
    V, F = collapse_fast(mesh.V, mesh.F, 2_000)
    assert is_clean(F, len(V))
    assert len(F) < 4_000
    assert topology(F) == topology(mesh.F)
    assert mesh_volume(V, F) == pytest.approx(mesh_volume(*mesh), rel=0.01, abs=1.0)


def test_borders_stay_vertex_by_vertex():
    mesh = noisy(half_sphere(20_000), 0.2)
    V, F = collapse_fast(mesh.V, mesh.F, 2_000)
    np.testing.assert_allclose(_rim(V, F), _rim(*mesh), atol=1e-9)


@pytest.mark.parametrize("faces", [60, 8])
def test_thin_handles_and_small_bodies_outlive_a_target_that_is_too_low(faces):
    """Tubes of three sides: every collapse of a ring's edge makes an edge of four faces."""
    rings = [_thin_ring(40, np.array([30.0 * k, 0, 0])) for k in range(3)]
    V = np.concatenate([ring[0] for ring in rings])
    F = np.concatenate([ring[1] + k * len(rings[0][0]) for k, ring in enumerate(rings)])
    W, G = collapse_fast(V, F, faces)
    assert is_clean(G, len(W))
    assert topology(G) == topology(F)
    assert components(G)[0] == 3


@pytest.mark.parametrize("size", [1e-3, 1e4])
def test_the_unit_does_not_matter(size):
    mesh = noisy(torus(20_000), 0.2)
    V, F = collapse_fast(mesh.V, mesh.F, 2_000)
    W, G = collapse_fast(mesh.V * size + 7 * size, mesh.F, 2_000)
    assert len(G) == pytest.approx(len(F), rel=0.01)
    assert mesh_volume(W, G) / size**3 == pytest.approx(mesh_volume(V, F), rel=1e-3)


def test_only_meshes_beyond_the_limit_are_thinned_first(monkeypatch):
    mesh = noisy(sphere(4_000), 0.1)
    calls = []
    monkeypatch.setattr(
        scale, "collapse_fast", lambda *given: calls.append(given[2]) or collapse_fast(*given)
    )
    scale.decimate(mesh.V, mesh.F, 1_000)
    assert not calls
    monkeypatch.setattr(scale, "_FINE", 3_000)
    _, F = scale.decimate(mesh.V, mesh.F, 1_000)
    assert calls == [1_500]
    assert 900 < len(F) <= 1_000
    assert topology(F) == topology(mesh.F)


def _rim(V, F):
    P = V[F.ravel()[border_halfedges(F)]]
    return P[np.lexsort(P.round(6).T)]


def _thin_ring(n, at):
    """A closed tube of three sides around a circle."""
    turn = 2 * np.pi * np.arange(n) / n
    around = np.stack([np.cos(turn), np.sin(turn), 0 * turn], 1)
    side = 2 * np.pi * np.arange(3) / 3
    V = around[:, None] * (10 + np.cos(side))[None, :, None]
    V[:, :, 2] = np.sin(side)
    i, j = (x.ravel() for x in np.meshgrid(np.arange(n), np.arange(3), indexing="ij"))
    a, b, c, d = 3 * i + j, 3 * ((i + 1) % n) + j, 3 * ((i + 1) % n) + (j + 1) % 3, 3 * i + (j + 1) % 3
    return V.reshape(-1, 3) + at, np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])
