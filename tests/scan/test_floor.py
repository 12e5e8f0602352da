"""A model cut at a height is what was above it: closed where it was closed, open where that is asked."""

from functools import partial

import numpy as np
import pytest
import trimesh

from meshjig.errors import InputError
from meshjig.mesh.boundary_loops import border_loops
from meshjig.mesh.measure import mesh_volume
from meshjig.mesh.mesh import Mesh
from meshjig.scan import read_scan
from meshjig.scan.floor import cut_floor
from meshjig.scan.manifold import is_clean
from meshjig.scan.plane_cut import cut_level
from meshjig.scan.preparation import Floor, Preparation
from tests.meshes import closed_cylinder, genus2, half_sphere, joined, moved, open_cup, sphere, torus


def z(source):
    return 2


def cut(mesh, axis=2, share=0.5, **how):
    V, F = mesh
    found = cut_floor(V, F, axis, V[:, axis].min() + share * np.ptp(V[:, axis]), **how)
    assert is_clean(found.F, len(found.V))
    return found


@pytest.mark.parametrize("axis", [0, 1, 2])
@pytest.mark.parametrize("maker", [sphere, torus, genus2, closed_cylinder])
def test_half_of_a_closed_model_is_closed_and_half_as_large(maker, axis):
    mesh = maker(1000)
    V, F, closed, left_open = cut(mesh, axis)
    assert not border_loops(F)
    assert (left_open, closed > 0) == (0, True)
    assert mesh_volume(V, F) == pytest.approx(mesh_volume(*mesh) / 2, rel=1e-6)
    assert V[:, axis].min() == pytest.approx((mesh.V[:, axis].min() + mesh.V[:, axis].max()) / 2)


def test_an_open_base_stays_open():
    _, F, closed, left_open = cut(torus(1000), share=0.2, stays_open=True)
    assert (closed, left_open, len(border_loops(F))) == (0, 2, 2)


def test_a_cup_gets_a_bottom_and_keeps_its_rim():
    assert len(border_loops(cut(open_cup(1000)).F)) == 1
    assert len(border_loops(cut(open_cup(1000), stays_open=True).F)) == 2


def test_a_cut_through_a_rim_stays_open():
    _, F, closed, left_open = cut(half_sphere(1000), axis=0)
    assert (closed, left_open, len(border_loops(F))) == (0, 1, 1)


def test_a_hollow_stays_a_hollow():
    solid = sphere(1000)
    shell = joined(solid, type(solid)(solid.V / 2, solid.F[:, ::-1]))
    V, F, closed, _ = cut(shell)
    assert closed == 2
    assert mesh_volume(V, F) == pytest.approx(mesh_volume(*shell) / 2, rel=1e-6)


@pytest.mark.parametrize(("height", "size"), [(10.0, None), (10.0, 80.0), (25.0, 300.0)])
def test_heights_and_sizes_are_those_of_what_is_left(height, size):
    tall = closed_cylinder(1000)
    tall = type(tall)(tall.V * [0.2, 0.2, 1], tall.F)  # 100 mm high
    scan = read_scan(tall, size=size, preparation=Preparation(floor=Floor(height, z)))
    assert np.ptp(scan.mesh.V[:, 2]) == pytest.approx(size or 100 - height)
    assert scan.facts.floor.above_lowest_mm == height
    back = np.column_stack([scan.mesh.V, np.ones(len(scan.mesh.V))]) @ scan.to_source.T
    taken = back[:, 2].min() - tall.V[:, 2].min()
    assert taken * scan.facts.scale == pytest.approx(height)


def test_a_stand_that_cannot_be_closed_is_refused():
    floor = partial(Floor, 10.0, lambda source: 0)
    with pytest.raises(InputError, match=r"open where it is cut, 10 mm .* along x.*--open-base"):
        read_scan(half_sphere(1000), preparation=Preparation(floor=floor(stands=True)))
    scan = read_scan(half_sphere(1000), preparation=Preparation(floor=floor()))
    assert any("the cut stays open" in note for note in scan.facts.notes)


def test_a_cut_above_everything_is_refused():
    with pytest.raises(InputError, match=r"higher than 120 mm along z: it is 99.6\d? mm high"):
        read_scan(sphere(1000), preparation=Preparation(floor=Floor(120.0, z)))


def test_the_largest_parts_are_kept_and_the_others_are_counted():
    parts = joined(*(moved(sphere(320, r), (at, 0, 0)) for r, at in ((30, 0), (5, 50), (10, 70))))
    found = {keep: read_scan(parts, preparation=Preparation(keep=keep)) for keep in ("all", "largest", 2)}
    assert [scan.facts.components for scan in found.values()] == [3, 1, 2]
    assert not found["all"].facts.notes
    assert found["largest"].facts.notes == [
        "of 3 connected parts the largest is kept: 2 with 12.2% of the area are left out"
    ]
    assert "the largest 2 are kept: 1 with 2.4% of the area is left out" in found[2].facts.notes[0]


@pytest.mark.parametrize("height", [10.0, 20.0, 40.0, 10.01, 11.0, 19.99])
def test_a_plane_through_rows_of_vertices_leaves_no_needles(height):
    box = trimesh.creation.box([100, 100, 80]).subdivide().subdivide().subdivide()
    V, F = np.asarray(box.vertices), np.asarray(box.faces)
    cut = cut_floor(V, F, 2, float(V[:, 2].min()) + height)
    mesh = Mesh(cut.V, cut.F)
    assert is_clean(cut.F, len(cut.V))
    assert not len(mesh.borders)
    assert mesh_volume(cut.V, cut.F) == pytest.approx(1e4 * (80 - height), rel=1e-3)
    corners = cut.V[cut.F[: len(F) // 4]]  # those of the model; a lid is flat, whatever its triangles
    sides = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2)
    high = 2 * mesh.areas[: len(corners)] / sides.max(axis=1)
    assert (high / sides.max(axis=1)).min() > 0.02


def test_where_the_cut_touches_itself_there_are_two_borders():
    V = np.array([[x, y, 0.0] for x in (-1, 0, 1) for y in (-1, 0, 1)]) * 10
    V[:, 2] = [8, -8, 8, 0, 0, 0, 8, -8, 8]  # a saddle: its middle lies on the plane
    quads = [(0, 3, 4, 1), (1, 4, 5, 2), (3, 6, 7, 4), (4, 7, 8, 5)]
    F = np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))])
    cut = cut_level(V, F, 2, 0.0)
    assert is_clean(cut.F, len(cut.V))
    assert (cut.V[:, 2] >= 0).all()


@pytest.mark.parametrize(("maker", "words"), [(sphere, "1 outline"), (torus, "2 outlines")])
def test_outlines_of_a_cut_are_counted_in_words(maker, words):
    scan = read_scan(maker(1000), preparation=Preparation(floor=Floor(5.0, z)))
    assert f"a plane closes the cut ({words})" in scan.facts.notes[0]
