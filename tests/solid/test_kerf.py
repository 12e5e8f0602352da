import sys

import numpy as np
import pytest
import trimesh

from meshjig.check import gaps, is_closed_as_stl, is_one_component, overlaps, self_intersections
from meshjig.mesh.booleans import body
from meshjig.mesh.components import components
from meshjig.mesh.halfedges import edges
from meshjig.solid import displacement, kerf, solidify
from meshjig.solid.border_chains import border_chains
from meshjig.solid.carve_gap import repair
from meshjig.solid.printable import printable
from meshjig.solid.solidify import OUTER
from tests.meshes import creased_box, disc, genus2, half_sphere, noisy, open_cup, sphere, torus

SHAPES = {
    "sphere": sphere(3000),
    "torus": torus(3000),
    "genus2": genus2(2500),
    "box": creased_box(3000),
    "cup": open_cup(3000),
    "noisy": noisy(sphere(3000), 0.1),
}


def waves(V, F, n, seed=2):
    """Pieces around seed points, with wavy borders along the mesh's edges."""
    rng = np.random.default_rng(seed)
    c = V[F].mean(1)
    seeds = V[rng.choice(len(V), n, replace=False)]
    c = c + 2 * np.sin(c[:, [1, 2, 0]] / 3)
    return np.linalg.norm(c[:, None] - seeds[None], axis=2).argmin(1)


def one_part_each(F, label):
    """Renumber so that every piece hangs together."""
    twin = edges(F).twin
    wall = np.repeat(label, 3) != label[twin // 3]
    return components(F, wall)[1]


def neighbours(F, label):
    twin = edges(F).twin
    both = np.sort(np.stack([np.repeat(label, 3), label[twin // 3]], 1), axis=1)
    return np.unique(both[both[:, 0] != both[:, 1]], axis=0)


@pytest.mark.parametrize("name", SHAPES)
def test_pieces_are_sound_and_stand_the_gap_apart(name):
    V, F = SHAPES[name]
    label = one_part_each(F, waves(V, F, 12))
    D, _ = displacement(V, F, 2.0)
    solids, facts = kerf(V, F, label, D, 0.2)
    pieces = [printable(*solid) for solid in solids]
    assert facts.crossing == []
    assert facts.uncut == []
    assert facts.discarded_volume_share < 0.001
    for piece in pieces:
        assert is_closed_as_stl(*piece)
        assert is_one_component(piece[1])
        assert not len(self_intersections(*piece))
    assert overlaps(pieces).total == 0
    measured = gaps(pieces, neighbours=neighbours(F, label), clearance=0.2)
    assert min(mm for _, _, mm in measured.pairs) >= 0.19
    assert np.median(measured.samples) == pytest.approx(0.2, abs=0.003)
    assert (np.abs(measured.samples - 0.2) < 0.02).mean() > 0.97


@pytest.mark.parametrize("clearance", [0.05, 0.1, 0.4])
def test_a_plate_loses_its_cut_line_times_the_gap(clearance):
    V, F = disc(400)
    label = (V[F].mean(1)[:, 0] > 0.1).astype(int)
    D = np.tile([0, 0, -2.0], (len(V), 1))
    whole = sum(trimesh.Trimesh(s.V, s.F, process=False).volume for s in solidify(V, F, label, D)[0])
    solids, _ = kerf(V, F, label, D, clearance)
    left = sum(trimesh.Trimesh(*s, process=False).volume for s in solids)
    line = V[border_chains(F, label).vertex]
    length = np.linalg.norm(np.diff(line, axis=0), axis=1).sum()
    assert whole - left == pytest.approx(length * clearance * 2, rel=0.05)
    gap = gaps(solids, neighbours=[[0, 1]], clearance=clearance)
    assert gap.min == pytest.approx(clearance, rel=0.01)


def test_no_clearance_leaves_the_pieces_touching():
    V, F = half_sphere(800)
    label = waves(V, F, 5)
    D = -2 * V / np.linalg.norm(V, axis=1, keepdims=True)
    solids, facts = kerf(V, F, label, D, 0.0)
    expected, _ = solidify(V, F, label, D)
    assert facts.discarded_volume_share == 0
    for (X, G), solid in zip(solids, expected, strict=True):
        assert (X == solid.V).all()
        assert (G == solid.F).all()


def test_walls_follow_the_directions_that_are_handed_in():
    V, F = disc(400)
    label = (V[F].mean(1)[:, 0] > 0.1).astype(int)
    D = np.tile([0, 0, -2.0], (len(V), 1))
    lean = np.tile([0.8, 0, -2.0], (len(V), 1))
    solids, _ = kerf(V, F, label, D, 0.2, wall=lean)
    gap = gaps(solids, neighbours=[[0, 1]], clearance=0.2)
    assert gap.min == pytest.approx(0.2, rel=0.01)
    middle = [X[np.abs(X[:, 1]) < 20] for X, _ in solids]
    edge = [x[np.abs(x[:, 2] - z) < 1e-6][:, 0].max() for z in (0.0, -2.0) for x in middle[:1]]
    assert edge[1] - edge[0] == pytest.approx(0.8, abs=0.02)


def test_a_part_that_the_gap_cuts_off_is_counted():
    V, F = disc(2400)
    x, y = V[F].mean(1)[:, :2].T
    band = (np.abs(y) < 6) & (x > 0)
    narrow = band & (x > 20) & (x < 30)
    label = np.where(band & ~narrow, 1, 0)
    D = np.tile([0, 0, -2.0], (len(V), 1))
    solids, facts = kerf(V, F, label, D, 0.2)
    assert facts.split == [1]
    parts = trimesh.Trimesh(*solidify(V, F, label, D)[0][1][:2], process=False).split()
    lost = min(part.volume for part in parts)
    total = sum(trimesh.Trimesh(*s, process=False).volume for s in solids)
    assert facts.discarded_volume_share == pytest.approx(lost / (total + lost), rel=0.05)


def test_equal_input_gives_equal_pieces():
    V, F = SHAPES["torus"]
    label = waves(V, F, 8)
    D, _ = displacement(V, F, 2.0)
    for (X, G), (Y, H) in zip(kerf(V, F, label, D, 0.2)[0], kerf(V, F, label, D, 0.2)[0], strict=True):
        assert (X == Y).all()
        assert (G == H).all()


def folded_sheet():
    """A plate whose inner sheet is pushed through itself at one place."""
    V, F = disc(1000)
    D = np.tile([0, 0, -2.0], (len(V), 1))
    near = np.linalg.norm(V[:, :2] - [10, 5], axis=1) < 6
    D[near] += [9.0, 0, 0]
    D[near, 2] += np.random.default_rng(0).uniform(-0.5, 0.5, near.sum())
    (solid,) = solidify(V, F, np.zeros(len(F), np.int64), D)[0]
    return solid


def test_a_folded_solid_is_mended():
    solid = folded_sheet()
    assert len(self_intersections(solid.V, solid.F))
    repaired = repair(solid, 1)
    mesh = repaired.to_mesh64()
    V, F = np.array(mesh.vert_properties, float)[:, :3], np.array(mesh.tri_verts, np.int64)
    assert not len(self_intersections(V, F))
    area = trimesh.Trimesh(solid.V, solid.F[solid.kind == OUTER], process=False).area
    assert repaired.volume() == pytest.approx(2 * area, rel=0.1)


def test_a_sound_solid_needs_no_mending():
    V, F = half_sphere(800)
    (solid,) = solidify(V, F, np.zeros(len(F), np.int64), -0.04 * V)[0]
    assert repair(solid, 1) is None
    assert body(solid.V, solid.F).volume() == pytest.approx(trimesh.Trimesh(solid.V, solid.F).volume)


@pytest.mark.parametrize("name", ["sphere", "cup"])
def test_two_processes_make_what_one_makes(name, monkeypatch):
    V, F = SHAPES[name]
    label = one_part_each(F, waves(V, F, 12))
    label[label == 3] = -1
    D, _ = displacement(V, F, 2.0)
    module = sys.modules["meshjig.solid.kerf"]
    monkeypatch.setattr(module, "SOLIDS_WORTH_A_CHILD", np.inf)
    alone, facts = kerf(V, F, label, D, 0.2)
    monkeypatch.setattr(module, "SOLIDS_WORTH_A_CHILD", 0)
    together, told = kerf(V, F, label, D, 0.2)
    assert told == facts
    for (X, G), (Y, H) in zip(alone, together, strict=True):
        np.testing.assert_array_equal(X, Y)
        np.testing.assert_array_equal(G, H)
