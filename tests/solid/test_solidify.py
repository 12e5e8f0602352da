import manifold3d
import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

from meshjig.mesh.components import components
from meshjig.solid.solidify import INNER, OUTER, WALL, solidify
from tests.meshes import creased_box, cylinder, disc, genus2, noisy, open_cup, sphere, torus, two_components

SHAPES = {
    "sphere": sphere(1200),
    "torus": torus(1200),
    "genus2": genus2(1500),
    "cup": open_cup(1200),
    "box": creased_box(1200),
    "two": two_components(1200),
    "noisy": noisy(sphere(1200), 0.1),
}


def nearest_of(seeds, V, F):
    """Pieces around seed points; some of them in several parts."""
    return np.linalg.norm(V[F].mean(1)[:, None] - seeds[None], axis=2).argmin(1)


def inward(V, F, t=2.0):
    return -t * trimesh.Trimesh(V, F, process=False).vertex_normals


def as_file(solid):
    """What a reader of binary STL makes of a piece: float32 corners, equal ones merged."""
    corners = solid.V.astype(np.float32)[solid.F].reshape(-1, 3) + np.float32(0)
    V, number = np.unique(corners, axis=0, return_inverse=True)
    return trimesh.Trimesh(V.astype(float), number.reshape(-1, 3), process=False)


def assert_sound(solid):
    mesh = as_file(solid)
    assert len(mesh.vertices) == len(solid.V)
    assert mesh.is_watertight
    assert mesh.is_winding_consistent
    assert mesh.volume > 0
    exact = manifold3d.Manifold(manifold3d.Mesh64(solid.V, solid.F.astype(np.uint64)))
    assert exact.status() == manifold3d.Error.NoError
    assert exact.num_tri() == len(solid.F)


@pytest.mark.parametrize("name", SHAPES)
@pytest.mark.parametrize("n_pieces", [1, 12])
def test_pieces_are_closed_solids_in_file_precision(name, n_pieces):
    V, F = SHAPES[name]
    label = nearest_of(np.random.default_rng(3).uniform(-60, 60, (n_pieces, 3)), V, F)
    solids, _ = solidify(V, F, label, inward(V, F))
    for i, solid in enumerate(solids):
        faces = F[label == i]
        assert (solid.kind == OUTER).sum() == (solid.kind == INNER).sum() == len(faces)
        if len(faces):
            assert_sound(solid)
            if not (solid.kind == WALL).any():  # a closed component: a shell has two surfaces
                continue
            assert components(solid.F)[0] <= 2 * components(faces)[0]


def test_faces_without_a_piece_leave_a_hole():
    V, F = SHAPES["sphere"]
    label = np.where(V[F].mean(1)[:, 2] > 30, -1, 0)
    (solid,), _ = solidify(V, F, label, inward(V, F))
    assert_sound(solid)
    assert (solid.kind == OUTER).sum() == (label == 0).sum()
    rim = solid.V[solid.F[solid.kind == WALL]].reshape(-1, 3)
    assert rim[:, 2].min() > 20


def test_a_number_without_faces_has_an_empty_solid():
    V, F = SHAPES["sphere"]
    solids, _ = solidify(V, F, np.full(len(F), 2), inward(V, F))
    assert [len(solid.F) > 0 for solid in solids] == [False, False, True]


def test_a_flat_disc_has_the_volume_of_a_plate():
    V, F = disc(600)
    D = np.tile([0.0, 0.0, -2.0], (len(V), 1))
    (solid,), _ = solidify(V, F, np.zeros(len(F), np.int64), D)
    area = trimesh.Trimesh(V, F, process=False).area
    assert as_file(solid).volume == pytest.approx(2 * area, rel=1e-5)
    assert solid.V[solid.F[solid.kind == OUTER]][..., 2].max() == 0


def test_pieces_of_a_sphere_share_its_shell():
    V, F = SHAPES["sphere"]
    label = nearest_of(np.random.default_rng(5).normal(size=(8, 3)) * 50, V, F)
    D = -0.04 * V
    solids, _ = solidify(V, F, label, D)
    shell = trimesh.Trimesh(V, F).volume - trimesh.Trimesh(V + D, F).volume
    assert sum(as_file(s).volume for s in solids if len(s.F)) == pytest.approx(shell, rel=1e-5)


def test_neighbours_have_the_same_wall():
    V, F = SHAPES["noisy"]
    label = (V[F].mean(1)[:, 0] > 3).astype(np.int64)
    solids, _ = solidify(V, F, label, inward(V, F))
    walls = [{frozenset(map(tuple, s.V[face])) for face in s.F[s.kind == WALL]} for s in solids]
    assert walls[0] == walls[1]


def test_a_piece_that_touches_itself_at_a_point_stays_manifold():
    V, F = disc(600)
    angle = np.arctan2(*V[F].mean(1)[:, 1::-1].T)
    label = np.where(np.abs(np.sin(angle)) < np.sin(np.pi / 6 + 1e-3), 0, -1)  # two wedges, one point
    (solid,), facts = solidify(V, F, label, np.tile([0.0, 0.0, -2.0], (len(V), 1)))
    assert facts.pinches == 2
    assert_sound(solid)


def test_vertices_that_share_a_place_in_the_input_are_told_apart():
    V, F = disc(600)
    angle = np.arctan2(*V[F].mean(1)[:, 1::-1].T)
    label = np.where(np.abs(np.sin(angle)) < np.sin(np.pi / 6 + 1e-3), 0, -1)
    right = (label == 0) & (V[F].mean(1)[:, 0] > 0)
    doubled = np.concatenate([V, V[:1]])  # the centre is vertex 0
    G = np.where(right[:, None] & (F == 0), len(V), F)
    (solid,), facts = solidify(doubled, G, label, np.tile([0.0, 0.0, -2.0], (len(doubled), 1)))
    assert facts.pinches == 2
    assert_sound(solid)


def test_inner_vertices_that_fall_together_are_moved_apart():
    V, F = SHAPES["sphere"]
    D = inward(V, F)
    top = np.argsort(V[:, 2])[-7:]
    D[top] = np.array([0, 0, 44.0]) - V[top]
    solids, facts = solidify(V, F, (V[F].mean(1)[:, 2] < 20).astype(np.int64), D)
    assert facts.nudged >= 6
    assert_sound(solids[0])


def test_missing_thickness_is_raised_to_the_least():
    V, F = SHAPES["sphere"]
    label = (V[F].mean(1)[:, 2] < 20).astype(np.int64)
    solids, facts = solidify(V, F, label, np.zeros_like(V))
    assert facts.raised >= len(V)
    for solid in solids:
        assert_sound(solid)


def test_pieces_turned_inside_out_by_their_inner_sheet_are_made_thinner():
    V, F = cylinder(1200)  # of radius 25: a sheet pushed 80 mm through its axis comes out larger, reversed
    label = (V[F].mean(1)[:, 0] > 0).astype(np.int64)
    axial = V * np.array([0, 0, 1])
    solids, facts = solidify(V, F, label, (axial - V) * 80 / 25)
    assert facts.shrunk == 2
    assert all(as_file(solid).volume > 0 for solid in solids)


@settings(max_examples=25, deadline=None)
@given(st.sampled_from(sorted(SHAPES)), st.integers(0, 10_000), st.floats(0.0, 0.6))
def test_any_labels_give_closed_solids(name, seed, gap_share):
    """Labels at random: pieces of many parts, pinched everywhere."""
    V, F = SHAPES[name]
    rng = np.random.default_rng(seed)
    label = rng.integers(0, 5, len(F))
    label[rng.random(len(F)) < gap_share] = -1
    for solid in solidify(V, F, label, inward(V, F))[0]:
        if len(solid.F):
            mesh = as_file(solid)
            assert len(mesh.vertices) == len(solid.V)
            assert mesh.is_watertight
            assert mesh.is_winding_consistent
