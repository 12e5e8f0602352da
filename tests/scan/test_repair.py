"""Repair leaves clean meshes alone, counts what it changes, and keeps the shape."""

from dataclasses import asdict

import numpy as np
import pytest
from hypothesis import given, settings

from meshjig.errors import InputError
from meshjig.mesh.measure import face_areas, mesh_volume
from meshjig.scan import repair
from tests.meshes import (
    Shape,
    cavity_shell,
    closed_cylinder,
    creased_box,
    cylinder,
    disc,
    genus2,
    half_sphere,
    inside_out,
    joined,
    moebius,
    moved,
    open_cup,
    saddle,
    sphere,
    torus,
    two_components,
)
from tests.strategies import meshes

SHAPES = [sphere, torus, genus2, creased_box, closed_cylinder, open_cup, cylinder, half_sphere, saddle]


def assert_clean(V, F):
    """Judge by counting, in plain Python, what the program finds by sorting."""
    assert set(F.ravel().tolist()) == set(range(len(V)))
    directed, fan = {}, {}
    for face in F.tolist():
        assert len(set(face)) == 3
        for a, b, c in (face, face[1:] + face[:1], face[2:] + face[:2]):
            assert (a, b) not in directed, "an edge runs the same way twice"
            directed[a, b] = True
            fan.setdefault(a, {})[b] = c
    for step in fan.values():
        start = next(iter(set(step) - set(step.values())), next(iter(step)))
        seen, at = 0, start
        while at in step and seen < len(step):
            at, seen = step[at], seen + 1
        assert seen == len(step), "a vertex has two fans"


def changed(result):
    return {name: n for name, n in asdict(result.changes).items() if n and not name.startswith("lost_")}


def soup(mesh):
    return Shape(mesh.V[mesh.F].reshape(-1, 3), np.arange(mesh.F.size).reshape(-1, 3))


def area(mesh):
    return face_areas(mesh.V, mesh.F).sum()


@given(meshes())
@settings(max_examples=25, deadline=None)
def test_a_clean_mesh_stays_as_it_is(mesh):
    result = repair(*mesh)
    assert changed(result) == {}
    np.testing.assert_array_equal(result.V, mesh.V)
    np.testing.assert_array_equal(result.F, mesh.F)


@pytest.mark.parametrize("maker", SHAPES)
def test_a_soup_of_triangles_is_welded(maker):
    mesh = maker(600)
    rng = np.random.default_rng(0)
    loose = soup(mesh)
    loose = Shape(loose.V + rng.uniform(-2e-6, 2e-6, loose.V.shape), loose.F)  # as float32 would leave it
    result = repair(*loose)
    assert_clean(result.V, result.F)
    assert changed(result) == {"merged_vertices": len(loose.V) - len(mesh.V)}
    assert area(result) == pytest.approx(area(mesh), rel=1e-5)


@pytest.mark.parametrize("maker", SHAPES)
def test_every_constructed_defect_is_counted(maker):
    mesh = maker(600)
    lone = np.array([[0, 0, 1], [5, 5, 5], [7, 8, 7]])
    F = np.concatenate([mesh.F, mesh.F[:4], mesh.F[4:6, ::-1], lone])
    result = repair(np.concatenate([mesh.V, mesh.V[:3] + 1]), F)
    assert changed(result) == {"unused_vertices": 3, "duplicate_faces": 6, "null_faces": 3}
    np.testing.assert_array_equal(result.F, mesh.F)


@pytest.mark.parametrize("maker", SHAPES)
def test_faces_that_disagree_are_turned_with_the_majority(maker):
    mesh = maker(600)
    F = mesh.F.copy()
    F[::5] = F[::5, ::-1]
    result = repair(mesh.V, F)
    assert changed(result) == {"reoriented": len(F[::5])}
    assert_clean(result.V, result.F)
    assert mesh_volume(result.V, result.F) == pytest.approx(mesh_volume(*mesh))


@pytest.mark.parametrize("maker", [sphere, torus, genus2, creased_box, open_cup, cylinder, half_sphere])
def test_inside_out_is_turned_and_reported(maker):
    mesh = maker(600)
    result = repair(*inside_out(mesh))
    assert changed(result) == {"turned_inside_out": 1}
    assert mesh_volume(result.V, result.F) == pytest.approx(mesh_volume(*mesh))


@pytest.mark.parametrize("maker", [saddle, disc])
def test_an_open_sheet_without_an_inside_is_left_as_it_is(maker):
    mesh = inside_out(maker(600))
    result = repair(*mesh)
    assert changed(result) == {}
    np.testing.assert_array_equal(result.F, mesh.F)


def test_only_the_component_that_is_inside_out_is_turned():
    right = sphere(300)
    result = repair(*joined(right, moved(inside_out(torus(300)), [130, 0, 0])))
    assert changed(result) == {"turned_inside_out": 1}
    assert mesh_volume(result.V, result.F) == pytest.approx(mesh_volume(*right) + mesh_volume(*torus(300)))


@pytest.mark.parametrize("mesh", [cavity_shell(1000), joined(sphere(500), sphere(500, 25.0))])
def test_a_cavity_is_kept_out_unless_asked(mesh):
    outer, inner = mesh_volume(*sphere(500)), mesh_volume(*sphere(500, 25.0))
    without, within = repair(*mesh), repair(*mesh, cavities=True)
    assert without.changes.cavities == within.changes.cavities == 1
    assert mesh_volume(without.V, without.F) == pytest.approx(outer)
    assert mesh_volume(within.V, within.F) == pytest.approx(outer - inner)
    assert_clean(without.V, without.F)


def test_a_ball_in_a_hollow_is_a_body_again():
    mesh = joined(cavity_shell(1000), moved(sphere(300, 10.0), [2, 0, 0]))
    result = repair(*mesh)
    assert changed(result) == {"cavities": 1}
    assert mesh_volume(result.V, result.F) == pytest.approx(
        mesh_volume(*sphere(500)) + mesh_volume(*sphere(300, 10.0))
    )


def test_a_cavity_inside_out_with_its_body_is_still_a_cavity():
    result = repair(*inside_out(cavity_shell(1000)), cavities=True)
    assert result.changes.cavities == 1
    assert result.changes.turned_inside_out == 2
    assert mesh_volume(result.V, result.F) == pytest.approx(mesh_volume(*cavity_shell(1000)))


def test_bodies_beside_each_other_are_no_cavities():
    torus_around = joined(torus(600), sphere(300, 10.0))  # in its hole, not in its body
    assert repair(*torus_around).changes.cavities == 0
    assert repair(*two_components(600)).changes.cavities == 0


def test_crumbs_are_dropped_and_reported():
    body, crumb = sphere(500), sphere(80, 1.0)
    mesh = joined(body, moved(crumb, [60, 0, 0]), moved(crumb, [70, 0, 0]))
    result = repair(*mesh)
    assert result.changes.dropped_components == 2
    assert result.changes.dropped_area_share == pytest.approx(2 * area(crumb) / area(mesh))
    np.testing.assert_array_equal(result.F, body.F)


def test_a_component_above_the_crumb_size_stays():
    mesh = joined(sphere(500), moved(sphere(80, 3.0), [60, 0, 0]))
    assert changed(repair(*mesh)) == {}


def test_boxes_that_touch_in_an_edge_come_apart():
    box = creased_box(300)
    mesh = soup(joined(box, moved(box, [100, 100, 0])))
    result = repair(*mesh)
    assert_clean(result.V, result.F)
    assert result.changes.non_manifold_edges == 5
    assert result.changes.non_manifold_vertices == 6
    assert mesh_volume(result.V, result.F) == pytest.approx(2 * mesh_volume(*box))
    assert area(result) == pytest.approx(2 * area(box))


def test_cones_that_touch_in_a_point_come_apart():
    cone = half_sphere(600)
    top = cone.V[np.argmax(cone.V[:, 2])]
    other = Shape(2 * top - cone.V, inside_out(cone).F)
    result = repair(*soup(joined(cone, other)))
    assert_clean(result.V, result.F)
    assert result.changes.non_manifold_vertices == 1
    mesh = joined(cone, other)
    k = int(np.argmax(cone.V[:, 2]))
    F = np.where(k + len(cone.V) == mesh.F, k, mesh.F)
    result = repair(mesh.V, F)
    assert_clean(result.V, result.F)
    assert result.changes.non_manifold_vertices == 1


def test_a_fin_on_a_closed_body_ends_at_it():
    box = creased_box(300)
    a, b = sorted(range(len(box.V)), key=lambda i: np.abs(box.V[i] - [50, 0, 0]).sum())[:2]
    result = repair(np.concatenate([box.V, [[90, 0, 0]]]), np.concatenate([box.F, [[a, b, len(box.V)]]]))
    assert_clean(result.V, result.F)
    assert result.changes.non_manifold_edges == 1
    assert area(result) == pytest.approx(area(box) + face_areas(result.V, result.F)[-1])


def test_a_surface_pinched_along_an_edge_loses_no_area():
    plate = genus2(900)
    # two opposite edges of a tunnel's mouth are glued: four faces at one edge, one sheet around it
    on_top = np.isclose(plate.V[:, 2], 10)
    left = np.flatnonzero(on_top & np.isclose(plate.V[:, 0], -30) & (np.abs(plate.V[:, 1]) < 10.1))
    right = np.flatnonzero(on_top & np.isclose(plate.V[:, 0], -10) & (np.abs(plate.V[:, 1]) < 10.1))
    left, right = (x[np.argsort(plate.V[x, 1])] for x in (left, right))
    assert len(left) == len(right) >= 4
    V, F = plate.V.copy(), plate.F.copy()
    for i, j in list(zip(left, right, strict=True))[1:3]:
        V[i] = (V[i] + V[j]) / 2
        F[j == F] = i
    pinched = Shape(V, F)
    result = repair(*pinched)
    assert_clean(result.V, result.F)
    assert result.changes.non_manifold_edges == 1
    assert area(result) == pytest.approx(area(pinched))
    assert mesh_volume(result.V, result.F) == pytest.approx(mesh_volume(*pinched))


def test_flat_faces_are_flipped_away_without_a_crack():
    mesh = creased_box(300)
    V, F = mesh.V, mesh.F
    a, b, c = F[7]
    # put a vertex on an edge of one face only: its neighbour sees a face without area
    m = len(V)
    F = np.concatenate([np.delete(F, 7, 0), [[a, m, c], [m, b, c], [a, b, m]]])
    result = repair(np.concatenate([V, [(V[a] + V[b]) / 2]]), F)
    assert_clean(result.V, result.F)
    assert changed(result) == {"flat_faces": 1}
    assert face_areas(result.V, result.F).min() > 1.0
    assert area(result) == pytest.approx(area(mesh))


@pytest.mark.parametrize("mesh", [moebius(400), joined(sphere(400), moved(moebius(400), [120, 0, 0]))])
def test_a_surface_with_one_side_is_refused_by_name(mesh):
    with pytest.raises(InputError, match="non-orientable: like a Moebius band"):
        repair(*mesh)


def test_nothing_left_is_refused():
    V, F = sphere(100)
    with pytest.raises(InputError, match="no faces are left"):
        repair(V, F[:, [0, 0, 1]])


def test_a_heap_of_crumbs_is_refused():
    V, F = sphere(5000)
    apart = soup(Shape(V, F))
    centre = apart.V.reshape(-1, 3, 3).mean(axis=1, keepdims=True)
    shrunk = (centre + 0.5 * (apart.V.reshape(-1, 3, 3) - centre)).reshape(-1, 3)
    with pytest.raises(InputError, match="loose parts, most of them"):
        repair(shrunk, apart.F)


@given(meshes(faces=(100, 400)))
@settings(max_examples=40, deadline=None)
def test_whatever_is_broken_comes_out_clean_or_as_a_sentence(mesh):
    rng = np.random.default_rng(len(mesh.F))
    V = np.concatenate([mesh.V, rng.normal(size=(5, 3)) * 30])
    F = np.concatenate([mesh.F, rng.integers(0, len(V), (len(mesh.F) // 20, 3))])
    turn = rng.random(len(F)) < 0.1
    F[turn] = F[turn][:, ::-1]
    try:
        result = repair(V, F)
    except InputError as error:
        sentence = str(error)
    else:
        assert_clean(result.V, result.F)
        return
    assert "non-orientable" in sentence
