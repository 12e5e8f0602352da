"""Pieces with walls that lean: of a plate, where volume and ways are known, and of a ball."""

import numpy as np
import pytest

from meshjig.check import gaps, is_closed_as_stl, is_one_component, overlaps, self_intersections
from meshjig.check.straight import met_on_the_way
from meshjig.mesh.measure import mesh_volume, vertex_normals
from meshjig.mesh.mesh import Mesh
from meshjig.solid.border_chains import border_chains
from meshjig.solid.carve_leaning import LeaningWalls, bands, finer, ruled
from meshjig.solid.kerf import Lean, carve_pieces
from meshjig.solid.printable import printable
from meshjig.solid.wall_edges import LabelledShell
from tests.meshes import sphere

GAP, THICK, WIDTH = 0.2, 2.0, 10.0


def plate(n=20):
    """Make a flat sheet of two squares side by side, a piece each."""
    x, y = np.meshgrid(np.arange(2 * n + 1) * WIDTH / n, np.arange(n + 1) * WIDTH / n, indexing="ij")
    k = np.arange(x.size).reshape(x.shape)
    a, b, c, d = (i.ravel() for i in (k[:-1, :-1], k[1:, :-1], k[1:, 1:], k[:-1, 1:]))
    V = np.stack([x.ravel(), y.ravel(), np.zeros(x.size)], 1)
    F = np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])
    piece = (V[F].mean(axis=1)[:, 0] > WIDTH).astype(int)
    return LabelledShell(V, F, piece, np.tile([0.0, 0.0, -THICK], (len(V), 1)))


def leaning(surface, degrees):
    """Lean the wall between two pieces of a plate: its foot goes under the left piece."""
    at = np.unique(border_chains(*surface[1:3]).vertex)
    wall = THICK * np.array([-np.tan(np.radians(degrees)), 0, -1])
    return Lean(at, np.tile(wall, (len(at), 1)), surface.D)


@pytest.mark.parametrize("degrees", [0, 15, 30, 45])
def test_walls_turn_around_the_middle_of_a_plate_and_end_on_both_sheets(degrees):
    surface = plate()
    lean = leaning(surface, degrees)
    walls = ruled(surface, surface.D, lean.vertex, lean.wall)
    top, way = walls.top[lean.vertex], walls.D[lean.vertex]
    inside = (top[:, 1] > 0) & (top[:, 1] < WIDTH)
    aside = np.tan(np.radians(degrees)) * THICK / 2
    assert top[inside, 0] == pytest.approx(WIDTH + aside, abs=1e-5)
    assert top[inside, 2] == pytest.approx(0, abs=1e-5)
    np.testing.assert_allclose(way[inside], np.tile([-2 * aside, 0, -THICK], (inside.sum(), 1)), atol=1e-5)
    other = np.setdiff1d(np.arange(len(surface.V)), lean.vertex)
    assert np.array_equal(walls.top[other], surface.V[other])
    assert np.array_equal(walls.D[other], surface.D[other])


def test_walls_that_turn_get_more_places_until_two_triangles_follow_them():
    surface = plate(4)
    chains = border_chains(*surface[1:3])
    straight = LeaningWalls(surface.V, surface.D)
    same, line = finer(straight, chains, 0.01)
    assert len(same.top) == len(surface.V)
    assert np.array_equal(line.vertex, chains.vertex)
    turning = surface.D.copy()
    turning[chains.vertex[::2], 0] += 1.5
    walls, line = finer(LeaningWalls(surface.V, turning), chains, 0.01)
    assert len(line.vertex) > len(chains.vertex)
    assert np.array_equal(walls.top[: len(surface.V)], surface.V)
    assert [v for v in line.vertex if v < len(surface.V)] == chains.vertex.tolist()
    y = walls.top[line.vertex, 1]
    assert (np.diff(y) > 0).all() or (np.diff(y) < 0).all()


def test_a_band_holds_the_piece_and_what_its_walls_lean_into():
    surface = plate()
    lean = leaning(surface, 30)
    walls = ruled(surface, surface.D, lean.vertex, lean.wall)
    made = bands(surface, walls, np.array([0]), GAP)
    assert list(made) == [0]
    solid, marks = made[0]
    low_x, low_y, low_z, high_x, high_y, high_z = solid.bounding_box()
    assert (low_x, low_y, high_y) == pytest.approx((0, 0, WIDTH))
    assert (low_z, high_z) == pytest.approx((-THICK, 0))
    aside = np.tan(np.radians(30)) * THICK / 2 + GAP / 2
    assert WIDTH + aside < high_x < WIDTH + aside + 2.5
    assert (marks[:, 0] < WIDTH / 2 + 1).all()
    assert marks[:, 2] == pytest.approx(0)


@pytest.mark.parametrize("degrees", [0, 20, 40])
def test_pieces_of_a_plate_have_their_volume_their_gap_and_their_way_out(degrees):
    surface = plate()
    solids, facts, strays = carve_pieces(surface, GAP, lean=leaning(surface, degrees))
    assert (facts.crossing, facts.uncut, strays) == ([], [], {})
    lost = THICK * WIDTH * GAP / 2 / np.cos(np.radians(degrees))
    for solid in solids:
        assert mesh_volume(*solid) == pytest.approx(THICK * WIDTH**2 - lost, rel=2e-3)
    measured = gaps(solids, clearance=GAP)
    assert measured.pairs[0][2] == pytest.approx(GAP, abs=0.002)
    left, right = solids
    # the left piece lies on the wall and goes out over it; its neighbour is under it
    way = np.array([np.sin(np.radians(degrees)), 0, np.cos(np.radians(degrees))])
    assert not met_on_the_way(left, right, way).points
    assert not met_on_the_way(right, left, way).points
    more = np.radians(degrees + 10)
    steeper = np.array([np.sin(more), 0, np.cos(more)])
    assert met_on_the_way(left, right, steeper).points
    assert not met_on_the_way(right, left, steeper).points
    less = np.radians(degrees - 10)
    assert met_on_the_way(right, left, np.array([np.sin(less), 0, np.cos(less)])).points


def test_pieces_of_a_ball_whose_walls_all_lean_along_one_way_are_sound():
    V, F = sphere(3000, 20.0)
    D = -THICK * vertex_normals(V, F)
    i = np.arange(10) + 0.5
    polar, turn = np.arccos(1 - 2 * i / 10), np.pi * (1 + 5**0.5) * i
    seeds = np.stack([np.cos(turn) * np.sin(polar), np.sin(turn) * np.sin(polar), np.cos(polar)], 1)
    surface = LabelledShell(V, F, (V[F].mean(axis=1) @ seeds.T).argmax(axis=1), D)
    at = np.unique(border_chains(F, surface.piece_of_face).vertex)
    normal = V[at] / 20.0
    aside = np.cross(normal, [0.3, 0.5, 0.8])
    lean = Lean(at, THICK * (0.5 * aside / np.linalg.norm(aside, axis=1)[:, None] - normal), D)
    solids, facts, _ = carve_pieces(surface, GAP, lean=lean)
    pieces = [Mesh(*printable(*solid)) for solid in solids]
    assert (facts.crossing, facts.uncut, facts.split) == ([], [], [])
    for piece in pieces:
        assert is_closed_as_stl(*piece)
        assert is_one_component(piece.F)
        assert not len(self_intersections(*piece))
    assert overlaps(pieces).total == 0
    measured = gaps(pieces, clearance=GAP)
    assert np.quantile(measured.samples, 0.01) > 0.95 * GAP
    shell = 4 / 3 * np.pi * (20.0**3 - (20.0 - THICK) ** 3)
    assert 0.9 * shell < sum(mesh_volume(*piece) for piece in pieces) < shell


def test_only_those_that_are_asked_for_are_made():
    surface = plate(8)
    solids, _, _ = carve_pieces(surface, GAP, lean=leaning(surface, 20), only=np.array([False, True]))
    both, _, _ = carve_pieces(surface, GAP, lean=leaning(surface, 20))
    assert len(solids[0].F) == 0
    assert mesh_volume(*solids[1]) == pytest.approx(mesh_volume(*both[1]))
