"""A core is closed, fills the model, keeps its gap from all pieces, and fits the plate."""

import igl
import numpy as np
import pytest

from meshjig.check import judge
from meshjig.check.closed import volume
from meshjig.errors import SolidError
from meshjig.extras.cap_openings import cap_openings
from meshjig.extras.core import CoreShape, make_core
from meshjig.mesh.booleans import arrays, body
from meshjig.mesh.halfedges import border_halfedges
from meshjig.mesh.measure import face_areas, mesh_volume, vertex_normals
from meshjig.mesh.types import Mesh
from meshjig.solid import shell
from tests.check.pieces import shell as solid_between
from tests.meshes import creased_box, disc, genus2, half_sphere, noisy, sphere, torus

UP = np.array([0.0, 0.0, 1.0])
SHAPES = {
    "sphere": sphere(2000),
    "coarse sphere": sphere(80),
    "torus": torus(2000),
    "box": creased_box(1200),
    "holes": genus2(1500),
    "noisy": noisy(sphere(4000), 0.2),
    "bowl": half_sphere(2000),
}


def core_of(shape, clearance=0.3, **keywords):
    sheets = shell(*shape, 2.0)
    outer = Mesh(sheets.outer, shape.F)
    wanted = CoreShape(clearance, **{"wall": 2.4, "min_wall": 1.2, "up": UP, **keywords})
    parts, facts = make_core(outer, sheets.D, wanted)
    return outer, sheets.D, parts, facts


def walls_of(outer, D):
    """Give the wall between the sheets: what all pieces together fill."""
    if len(border_halfedges(outer.F)):
        return body(*solid_between(outer.V, outer.V + D, outer.F))
    return body(outer.V, outer.F) - body(outer.V + D, outer.F)


@pytest.fixture(autouse=True)
def _coarse(monkeypatch):
    monkeypatch.setattr("meshjig.extras.core._CELLS", 50)


@pytest.mark.parametrize(("name", "clearance"), [*((name, 0.6) for name in SHAPES), ("holes", 1.5)])
def test_core_is_sound_and_keeps_its_gap(name, clearance):
    outer, D, parts, facts = core_of(SHAPES[name], clearance, wall=0.0)
    assert facts.parts == len(parts) == 1
    verdict = judge(parts)
    assert verdict.ok, verdict.failures
    walls, core = walls_of(outer, D), body(*parts[0])
    assert (walls ^ core).volume() < 1e-9
    least = walls.min_gap(core, 5.0)
    assert least >= 0.97 * clearance
    away = np.sqrt(igl.point_mesh_squared_distance(arrays(core)[0], *arrays(walls))[0])
    assert np.median(away) <= (1.5 if name == "noisy" else 1.2) * clearance


@pytest.mark.parametrize("name", ["sphere", "torus", "box", "bowl"])
def test_core_fills_what_the_pieces_leave(name):
    outer, D, parts, _ = core_of(SHAPES[name], wall=0.0)
    V, F, _ = cap_openings(outer.V + D, outer.F)
    room = mesh_volume(V, F) - 0.33 * face_areas(V, F).sum()
    assert volume(*parts[0]) == pytest.approx(room, rel=0.03)


@pytest.mark.parametrize(("name", "drains"), [("sphere", 1), ("box", 1), ("holes", 1), ("bowl", 1)])
def test_hollow_core_has_its_wall_and_a_drain(name, drains):
    _, _, solid, _ = core_of(SHAPES[name], wall=0.0)
    _, _, hollow, facts = core_of(SHAPES[name])
    assert facts.drains == drains
    verdict = judge(hollow)
    assert verdict.ok, verdict.failures
    area = face_areas(*solid[0]).sum()
    assert volume(*hollow[0]) == pytest.approx(2.4 * area, rel=0.15)
    low = hollow[0][0][:, 2].min()
    assert body(*hollow[0]).slice(low + 1.2).num_contour() > body(*solid[0]).slice(low + 1.2).num_contour()


def test_parts_fit_the_plate_and_are_the_whole_core():
    _, _, whole, _ = core_of(SHAPES["sphere"])
    plate = (60.0, 55.0, 101.0)
    _, _, parts, facts = core_of(SHAPES["sphere"], plate=plate)
    assert facts.parts == len(parts) == 4
    for V, _ in parts:
        assert (np.sort(np.ptp(V, axis=0)) <= np.sort(plate) + 1e-6).all()
    assert sum(volume(*part) for part in parts) == pytest.approx(volume(*whole[0]), rel=1e-6)
    verdict = judge(parts)
    assert not verdict.failures.keys() - {"gap_mm"}


def test_limbs_too_thin_for_a_core_have_none():
    import manifold3d

    ball = body(*sphere(2000, 30.0))
    mesh = ball + manifold3d.Manifold.cylinder(35.0, 2.6, circular_segments=24).translate([0, 0, 28.0])
    V, F = arrays(mesh.refine_to_length(3.0))
    N = vertex_normals(V, F)
    parts, _ = make_core(Mesh(V, F), -2.0 * N, CoreShape(0.3, wall=0.0, min_wall=1.2, up=UP))
    assert parts[0][0][:, 2].max() < 32.0
    assert judge(parts).ok


@pytest.mark.parametrize("shape", [disc(400), sphere(500, 2.2)])
def test_models_without_room_are_refused(shape):
    with pytest.raises(SolidError, match="no room for a core"):
        make_core(Mesh(*shape), -2.0 * vertex_normals(*shape), CoreShape(0.3, wall=2.4, min_wall=1.2, up=UP))


@pytest.mark.parametrize("name", ["sphere", "bowl"])
def test_core_ends_where_pieces_fill_the_model_from_side_to_side(name):
    """As a slab through the middle of a model, with skins on both sides of it."""
    import manifold3d

    outer, D, [whole], _ = core_of(SHAPES[name], 0.6, wall=0.0)
    low, high = outer.V.min(axis=0), outer.V.max(axis=0)
    size = (high - low) * [0.5, 0.4, 1.2]
    slab = manifold3d.Manifold.cube(size.tolist()).translate((low - 0.1 * (high - low)).tolist())
    wanted = CoreShape(0.6, wall=0.0, min_wall=1.2, up=UP)
    [part], facts = make_core(outer, D, wanted, Mesh(*arrays(slab)))
    assert judge([part]).ok
    core = body(*part)
    assert core.min_gap(slab, 5.0) >= 0.6
    assert core.min_gap(walls_of(outer, D), 5.0) >= 0.6
    left = body(*whole) - slab
    assert 0.75 * left.volume() < facts.volume_mm3 < left.volume()
