import sys

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from meshjig.cells import cell_atlas, grow_cells
from meshjig.errors import OptionError
from meshjig.mesh.components import components, is_disc
from meshjig.mesh.halfedges import edges
from meshjig.mesh.measure import face_areas, interpolate
from meshjig.mesh.types import Mesh
from tests.meshes import (
    creased_box,
    cylinder,
    disc,
    genus2,
    half_sphere,
    joined,
    moved,
    noisy,
    sphere,
    torus,
    two_components,
)
from tests.strategies import meshes


def areas(cells):
    return np.bincount(cells.cell, face_areas(cells.mesh.V, cells.mesh.F), cells.n_cells)


def spread_of(cells):
    area = areas(cells)
    return area.std() / area.mean()


def assert_sound(mesh, cells):
    """Cells are discs that cover the surface, which is the same surface, cut finer."""
    V, F = cells.mesh.V, cells.mesh.F
    assert np.unique(cells.cell).tolist() == list(range(cells.n_cells))
    assert all(is_disc(F[cells.cell == c]) for c in range(cells.n_cells))
    assert (edges(F).n_faces == 1).sum() >= (edges(mesh.F).n_faces == 1).sum()
    assert components(F)[0] == components(mesh.F)[0]
    assert (V[: len(mesh.V)] == mesh.V).all()
    size = np.ptp(V, axis=0).max()
    assert np.abs(interpolate(mesh.V, mesh.F, cells.vertex_face, cells.vertex_bary) - V).max() < 1e-9 * size
    assert cells.vertex_bary.min() >= 0
    by_parent = np.bincount(cells.parent, face_areas(V, F), len(mesh.F))
    assert by_parent == pytest.approx(face_areas(mesh.V, mesh.F), rel=1e-6, abs=1e-9 * size**2)


def thin_limb(bend=0.0):
    """A tube 100 mm long and 10 mm wide, open at both ends, of even triangles; bent by an angle."""
    around, along = 24, 76
    i, j = (x.ravel() for x in np.meshgrid(np.arange(around), np.arange(along + 1), indexing="ij"))
    angle, way = 2 * np.pi * (i + j / 2) / around, 100 * j / along
    V = np.column_stack([5 * np.cos(angle), 5 * np.sin(angle), way])
    if bend:
        radius, turn = 100 / bend, bend * way / 100
        V = np.column_stack([(radius + V[:, 0]) * np.cos(turn), V[:, 1], (radius + V[:, 0]) * np.sin(turn)])
    a = np.arange(len(V))[j < along]
    right = ((i + 1) % around * (along + 1) + j)[j < along]
    F = np.concatenate([np.stack([a, right, a + 1], 1), np.stack([right, right + 1, a + 1], 1)])
    return Mesh(V, F)


SHAPES = {
    "sphere": (sphere(3000), 40),
    "few faces, many cells": (sphere(100), 40),
    "torus": (torus(3000), 40),
    "genus 2, creased": (genus2(3000), 60),
    "box": (creased_box(1200), 30),
    "open": (half_sphere(2000), 30),
    "flat": (disc(2000), 50),
    "tube": (cylinder(2000), 30),
    "two components": (two_components(3000), 40),
    "noisy": (noisy(sphere(2000), 0.3), 40),
}


@pytest.mark.parametrize(("shape", "n"), SHAPES.values(), ids=SHAPES.keys())
def test_cells_are_discs_of_equal_area_on_the_same_surface(shape, n):
    mesh = Mesh(*shape)
    cells = grow_cells(mesh, n)
    assert_sound(mesh, cells)
    assert cells.n_cells == n
    assert spread_of(cells) < 0.04
    assert areas(cells).min() > 0.85 * areas(cells).mean()


def test_cells_are_compact():
    """Near to hexagons: 4 pi A / P^2 is 0.907 for a hexagon, 0.785 for a square."""
    cells = grow_cells(Mesh(*sphere(5000)), 60)
    e = edges(cells.mesh.F)
    h = np.arange(len(e.twin))
    border = cells.cell[h // 3] != cells.cell[e.twin // 3]
    ends = cells.mesh.V[e.E[e.edge_of_halfedge[border]]]
    around = np.bincount(cells.cell[h[border] // 3], np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1))
    roundness = 4 * np.pi * areas(cells) / around**2
    assert np.median(roundness) > 0.8
    assert roundness.min() > 0.7


def test_borders_run_smoothly():
    """On a flat sheet with uneven triangles, borders are straight: few turns inside of them."""
    V, F = disc(6000)
    shake = np.random.default_rng(0).normal(size=(len(V), 2)) * 0.3
    inner = np.linalg.norm(V, axis=1) < 45
    V = np.column_stack([V[:, :2] + shake * inner[:, None], V[:, 2]])
    cells = grow_cells(Mesh(V, F), 25)
    e = edges(cells.mesh.F)
    h = np.flatnonzero(e.twin > np.arange(len(e.twin)))
    border = e.E[e.edge_of_halfedge[h[cells.cell[h // 3] != cells.cell[e.twin[h] // 3]]]]
    both = np.concatenate([border, border[:, ::-1]])
    both = both[np.argsort(both[:, 0], kind="stable")]
    twice = np.flatnonzero(np.bincount(both[:, 0]) == 2)
    at = np.searchsorted(both[:, 0], twice)
    way = [cells.mesh.V[both[at + k, 1]] - cells.mesh.V[twice] for k in range(2)]
    cosine = -(way[0] * way[1]).sum(1) / np.linalg.norm(way[0], axis=1) / np.linalg.norm(way[1], axis=1)
    turn = np.degrees(np.arccos(np.clip(cosine, -1, 1)))
    assert np.median(turn) < 4
    assert np.percentile(turn, 95) < 25


@pytest.mark.parametrize("n", [1, 2, 3, 4])
@pytest.mark.parametrize("shape", [sphere(1000), torus(1000), cylinder(1000), disc(500)], ids="STCD")
def test_few_cells_are_discs_too(shape, n):
    mesh = Mesh(*shape)
    cells = grow_cells(mesh, n)
    assert_sound(mesh, cells)
    assert n <= cells.n_cells <= 10


@pytest.mark.parametrize("bend", [0.0, 1.5], ids=["straight", "bent"])
@pytest.mark.parametrize("n", [2, 3])
def test_a_limb_thinner_than_a_cell_is_cut_along(n, bend):
    mesh = thin_limb(bend)
    cells = grow_cells(mesh, n)
    assert_sound(mesh, cells)
    assert abs(cells.n_cells - n) <= 1
    assert areas(cells).min() >= 0.5 * areas(cells).mean()
    assert cells.facts.thin_limbs


def test_small_components_are_pieces_of_their_own():
    crumb = moved(disc(24, radius=2.0), [100, 0, 0])
    mesh = Mesh(*joined(sphere(2000), crumb))
    cells = grow_cells(mesh, 20)
    assert_sound(mesh, cells)
    assert len(np.unique(cells.cell[cells.mesh.V[cells.mesh.F[:, 0], 0] > 90])) == 1


def test_a_second_pass_gives_each_cell_the_area_asked_for():
    mesh = Mesh(*torus(4000))
    cells = grow_cells(mesh, 40)
    wanted = np.random.default_rng(0).uniform(0.7, 1.3, 40)
    again = grow_cells(mesh, 40, start=cells.seeds, targets=wanted)
    assert_sound(mesh, again)
    share = areas(again) / wanted
    assert share.std() / share.mean() < 0.04
    centres = [np.stack([np.bincount(c.cell, c.mesh.V[c.mesh.F].mean(1)[:, k]) for k in range(3)], 1)
               / np.bincount(c.cell)[:, None] for c in (cells, again)]  # fmt: skip
    assert np.linalg.norm(centres[0] - centres[1], axis=1).max() < 10


def test_another_pass_keeps_limbs_cut_along():
    mesh = thin_limb()
    cells = grow_cells(mesh, 2)
    again = grow_cells(mesh, 2, start=cells.seeds, targets=np.linspace(0.9, 1.1, cells.n_cells))
    assert_sound(mesh, again)
    assert again.n_cells == cells.n_cells


def test_the_seed_decides():
    mesh = Mesh(*sphere(1500))
    one, same, other = (grow_cells(mesh, 20, seed=seed) for seed in (0, 0, 1))
    assert (one.mesh.V == same.mesh.V).all()
    assert (one.cell == same.cell).all()
    assert one.mesh.V.shape != other.mesh.V.shape or not (one.mesh.V == other.mesh.V).all()


def test_borders_follow_creases_where_asked():
    """On a box, far more of the creases are borders, and fewer of the borders are beside them."""
    mesh = Mesh(*creased_box(4000))
    on, beside = [], []
    for aware in (False, True):
        cells = grow_cells(mesh, 54, crease_aware=aware)
        assert_sound(mesh, cells)
        e = edges(cells.mesh.F)
        h = np.flatnonzero(e.twin > np.arange(len(e.twin)))
        ends = cells.mesh.V[e.E[e.edge_of_halfedge[h]]]
        border = cells.cell[h // 3] != cells.cell[e.twin[h] // 3]
        length = np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1)
        away = np.sort(50 - np.abs(ends), axis=2)[:, :, 1]  # from the nearest of the box's creases
        crease, near = (away < 1e-6).all(1), (away > 1e-6).any(1) & (away < 6.5).all(1)
        on.append(length[crease & border].sum() / length[crease].sum())
        beside.append(length[near & border].sum())
    assert on[1] > 0.35 > 10 * on[0]
    assert beside[1] < 0.9 * beside[0]


def test_quad_cells_have_four_sides():
    pytest.importorskip("pynanoinstantmeshes")
    cells = grow_cells(Mesh(*cylinder(4000)), 60, style="quad")
    assert_sound(Mesh(*cylinder(4000)), cells)
    assert abs(cells.n_cells - 60) <= 6
    e = edges(cells.mesh.F)
    h = np.flatnonzero(e.twin > np.arange(len(e.twin)))
    pairs = np.sort(np.stack([cells.cell[h // 3], cells.cell[e.twin[h] // 3]], 1), axis=1)
    ends = cells.mesh.V[e.E[e.edge_of_halfedge[h]]]
    length = np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1)
    apart = pairs[:, 0] != pairs[:, 1]
    key = pairs[:, 0] * cells.n_cells + pairs[:, 1]
    border = np.bincount(key[apart], length[apart], cells.n_cells**2)
    long = np.flatnonzero(border > 0.3 * np.sqrt(areas(cells).mean()))
    sides = np.bincount(np.concatenate([long // cells.n_cells, long % cells.n_cells]))
    assert np.median(sides) == 4


@pytest.mark.parametrize(
    "keywords", [{"n": 0}, {"n": 5, "targets": np.ones(5)}], ids=["no cells", "targets without a start"]
)
def test_what_makes_no_sense_is_refused(keywords):
    with pytest.raises(OptionError):
        grow_cells(Mesh(*sphere(100)), **keywords)


@settings(max_examples=12, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(meshes(), st.integers(6, 40), st.integers(0, 9))
def test_any_mesh_falls_into_discs_that_lie_flat(shape, n, seed):
    mesh = Mesh(*shape)
    cells = grow_cells(mesh, n, seed=seed)
    assert_sound(mesh, cells)
    assert cells.n_cells >= n
    atlas = cell_atlas(cells)
    assert (face_areas(atlas.uv, atlas.F_uv) > 0).all()


def test_quad_cells_need_a_package(monkeypatch):
    monkeypatch.setitem(sys.modules, "pynanoinstantmeshes", None)
    with pytest.raises(OptionError, match="pynanoinstantmeshes"):
        grow_cells(Mesh(*sphere(200)), 10, style="quad")
