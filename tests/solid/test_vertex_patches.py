import numpy as np
import pytest

from meshjig.solid.vertex_patches import VertexPatches, submesh_around
from tests.meshes import disc, joined, moved, sphere, torus


def test_a_part_holds_where_it_was_cut_out():
    V, F = sphere(4000)
    core = np.zeros(len(F), bool)
    core[7] = True
    part = submesh_around(V, F, core, 10.0)
    assert 10 < len(part.faces) < len(F) / 2
    assert (part.vertices[part.F] == F[part.faces]).all()
    outside = np.setdiff1d(np.arange(len(F)), part.faces)
    assert set(part.vertices[part.held]) == set(part.vertices) & set(F[outside].ravel())
    near = np.linalg.norm(V - V[F[7]].mean(0), axis=1) < 10.0
    assert set(np.flatnonzero(near)) <= set(part.vertices)


def test_a_wall_across_is_part_of_it():
    V, F = joined(sphere(1000), moved(torus(1000), [0, 0, 70]))
    core = np.zeros(len(F), bool)
    core[V[F].mean(1)[:, 2].argmax()] = True
    assert not submesh_around(V, F, core, 1.0).held.all()
    whole = submesh_around(V, F, core, 500.0)
    assert len(whole.faces) == len(F)
    assert not whole.held.any()


def test_pairs_of_both_sheets_are_renumbered():
    V, F = sphere(4000)
    core = np.zeros(len(F), bool)
    core[100] = True
    part = submesh_around(V, F, core, 5.0)
    a, b = part.faces[[3, 5]]
    far = np.setdiff1d(np.arange(len(F)), part.faces)[0]
    pairs = np.array([[a, b + len(F)], [a + len(F), b + len(F)], [a, far]])
    k = len(part.faces)
    assert part.inside(pairs, len(F)).tolist() == [[3, 5 + k], [3 + k, 5 + k]]


def test_a_filled_patch_is_linear_where_its_border_is():
    V, F = disc(2000)
    patches = VertexPatches(V, F)
    patch = patches.around(np.array([int(np.linalg.norm(V, axis=1).argmin())]), 8.0)
    values = 3.0 * V[:, :2] + 1.0
    spoilt = values.copy()
    spoilt[patch] = -50.0
    filled = patches.filled(spoilt, patch)
    assert len(patch) > 20
    assert np.abs(filled - values[patch]).max() < 0.1 * np.ptp(values[patch])
    spoilt[patch] = filled
    assert patches.mean(spoilt, patch) == pytest.approx(filled, abs=1e-5)


def test_a_patch_that_is_all_there_is_keeps_its_values():
    V, F = sphere(100)
    filled = VertexPatches(V, F).filled(np.full((len(V), 1), 7.0), np.arange(len(V)))
    assert filled == pytest.approx(7.0)


def test_patches_far_apart_are_two_components():
    V, F = torus(2000)
    patches = VertexPatches(V, F)
    far = int(np.linalg.norm(V - V[0], axis=1).argmax())
    patch = patches.around(np.array([0, far]), 5.0)
    component = patches.components(patch)
    assert component.max() == 1
    assert (component == component[list(patch).index(far)]).sum() == len(patches.around(np.array([far]), 5.0))
