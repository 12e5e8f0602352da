"""What is rebuilt is closed, clean, free of crossings, and where the outer surface was."""

import numpy as np
import pytest

from meshjig.errors import InputError
from meshjig.mesh.components import components
from meshjig.mesh.halfedges import border_halfedges
from meshjig.mesh.measure import mesh_volume
from meshjig.scan import read_scan, resurface, self_crossings
from meshjig.scan.manifold import is_clean
from tests.meshes import (
    Shape,
    cavity_shell,
    creased_box,
    cylinder,
    disc,
    genus2,
    half_sphere,
    inside_out,
    joined,
    moved,
    open_cup,
    sphere,
    torus,
)

TURN = np.linalg.qr(np.random.default_rng(3).normal(size=(3, 3)))[0]
TURN *= np.sign(np.linalg.det(TURN))


def turned(mesh):
    """Turn a mesh so that no side lies along the grid."""
    return Shape(mesh.V @ TURN.T, mesh.F)


def assert_sound(V, F):
    assert is_clean(F, len(V))
    assert len(border_halfedges(F)) == 0
    assert len(self_crossings(V, F)) == 0
    assert mesh_volume(V, F) > 0


def euler(F):
    return int(F.max()) + 1 - len(F) // 2


def test_two_spheres_through_each_other_become_their_union():
    r, d = 50.0, 60.0
    mesh = joined(sphere(8000), moved(sphere(8000), [d, 0, 0]))
    V, F, facts = resurface(*mesh, 1.5)
    assert_sound(V, F)
    lens = np.pi * (4 * r + d) * (2 * r - d) ** 2 / 12
    assert mesh_volume(V, F) == pytest.approx(2 * 4 / 3 * np.pi * r**3 - lens, rel=2e-3)
    gap = np.minimum(np.linalg.norm(V, axis=1), np.linalg.norm(V - [d, 0, 0], axis=1)) - r
    assert np.percentile(np.abs(gap), 99) < 0.1
    assert np.abs(gap).max() < 0.75  # half a cell
    assert facts.off_mm.max < 0.75
    assert euler(F) == 2


@pytest.mark.parametrize(
    ("mesh", "genus"), [(sphere(3000), 0), (torus(3000), 1), (genus2(3000), 2), (creased_box(300), 0)]
)
def test_what_was_clean_keeps_its_shape(mesh, genus):
    mesh = turned(mesh)
    V, F, facts = resurface(*mesh, 1.5)
    assert_sound(V, F)
    assert euler(F) == 2 - 2 * genus
    assert mesh_volume(V, F) == pytest.approx(mesh_volume(*mesh), rel=1e-3)
    assert (facts.capped_area_share, facts.lost_area_share) == (0, 0)


def test_creases_and_corners_stay_sharp():
    V, _, _ = resurface(*turned(creased_box(300)), 1.5)
    W = V @ TURN
    corners = 50 * np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    off = np.sort(np.linalg.norm(W[:, None] - corners, axis=2).min(axis=0))
    assert off[5] < 0.05
    assert off[7] < 0.75  # half a cell, where vertices got into each other's way
    assert np.percentile(np.abs(np.abs(W).max(axis=1) - 50), 99) < 0.05


def test_shells_inside_go_unless_they_are_wanted():
    mesh = cavity_shell(4000)
    V, F, _ = resurface(*mesh, 2.0)
    assert components(F)[0] == 1
    V, F, _ = resurface(*mesh, 2.0, cavities=True)
    assert components(F)[0] == 2
    assert mesh_volume(V, F) == pytest.approx(mesh_volume(*mesh), rel=5e-3)


def test_small_holes_are_closed():
    V, F = sphere(3000)
    keep = np.linalg.norm(V[F].mean(axis=1) - [0, 0, 50], axis=1) > 6
    new, G, facts = resurface(V, F[keep], 1.5)
    assert_sound(new, G)
    assert euler(G) == 2
    assert 0 < facts.capped_area_share < 0.02
    assert mesh_volume(new, G) == pytest.approx(mesh_volume(V, F), rel=2e-3)


def test_loose_sheets_that_face_any_way_become_one_solid():
    sheet = disc(600, 68)  # reaches beyond its neighbours: they cross along every edge of a cube
    sides = []
    for axis in range(3):
        for sign in (1, -1):
            square = Shape(np.clip(sheet.V, -53, 53), sheet.F)
            side = moved(square if (axis + (sign > 0)) % 2 else inside_out(square), [0, 0, 50.0 * sign])
            sides.append(Shape(np.roll(side.V, axis, axis=1), side.F))
    V, F, facts = resurface(*turned(joined(*sides)), 2.0)
    assert_sound(V, F)
    assert facts.lost_area_share < 0.1
    assert mesh_volume(V, F) == pytest.approx(100**3, rel=0.01)


@pytest.mark.parametrize("mesh", [open_cup(1500), half_sphere(1000), cylinder(1000), disc(500)])
def test_an_open_surface_is_refused_in_one_sentence(mesh):
    with pytest.raises(InputError, match=r"^the mesh is too open to be resurfaced: [^.]*$"):
        resurface(*mesh, 2.0)


@pytest.mark.parametrize("faces", [8000, 30_000])
def test_a_scan_is_rebuilt_at_its_working_resolution(faces):
    crossed = joined(sphere(2000), moved(torus(2000), [40, 0, 0]))
    plain = read_scan(crossed, faces=faces)
    assert len(self_crossings(plain.mesh.V, plain.mesh.F)) > 0
    assert plain.facts.resurfaced is None
    scan = read_scan(crossed, faces=faces, resurface=True)
    assert_sound(scan.mesh.V, scan.mesh.F)
    assert faces / 2 < len(scan.mesh.F) <= faces
    assert scan.facts.decimated_from is None
    assert scan.facts.resurfaced.off_mm.p99 < scan.facts.resurfaced.cell_mm / 5


def test_equal_input_gives_equal_output():
    mesh = noisy_soup()
    first, second = resurface(*mesh, 2.5), resurface(*mesh, 2.5)
    np.testing.assert_array_equal(first.V, second.V)
    np.testing.assert_array_equal(first.F, second.F)


def noisy_soup():
    return joined(turned(sphere(1000)), moved(turned(creased_box(600)), [31, 17, 5]))
