import numpy as np
import pytest
import shapely

from meshjig.cells import cell_atlas, grow_cells
from meshjig.cells.cell_mesh import CellMesh
from meshjig.cells.flatten.cell_atlas import untangle
from meshjig.cells.flatten.planar import folded, mirrored, patches
from meshjig.mesh.components import components
from meshjig.mesh.halfedges import border_halfedges, compact
from meshjig.mesh.measure import face_areas, singular_values
from meshjig.mesh.types import Mesh
from tests.meshes import cylinder, disc, genus2, noisy, open_cup, sphere, torus


def one_cell(shape):
    """Take a whole disc for a cell."""
    V, F = shape
    none = np.zeros(len(V), np.int64)
    return CellMesh(
        Mesh(V, F), Mesh(V, F), np.arange(len(F)), none, np.ones((len(V), 3)), np.zeros(len(F), np.int64)
    )


SHAPES = {
    "sphere": grow_cells(Mesh(*sphere(3000)), 30),
    "half spheres": grow_cells(Mesh(*sphere(1000)), 2),
    "torus": grow_cells(Mesh(*torus(3000)), 20),
    "creased": grow_cells(Mesh(*genus2(2000)), 30),
    "rolled up": grow_cells(Mesh(*cylinder(2000)), 2),
    "noisy": grow_cells(Mesh(*noisy(sphere(3000), 0.4)), 30),
    "a deep cup": one_cell(open_cup(2000)),
}


@pytest.mark.parametrize("cells", SHAPES.values(), ids=SHAPES.keys())
def test_every_cell_lies_flat_on_its_own(cells):
    atlas = cell_atlas(cells)
    V, F = cells.mesh.V, cells.mesh.F
    assert (atlas.chart_of_face == cells.cell).all()
    assert (face_areas(atlas.uv, atlas.F_uv) > 0).all()
    owner = np.full(len(atlas.uv), -1)
    owner[atlas.F_uv] = F
    assert (owner[atlas.F_uv] == F).all()
    assert components(atlas.F_uv)[0] == cells.n_cells
    shapes = [
        shapely.union_all(shapely.polygons(atlas.uv[atlas.F_uv[cells.cell == c]]))
        for c in range(cells.n_cells)
    ]
    size = np.bincount(cells.cell, face_areas(V, F))
    assert [shape.area for shape in shapes] == pytest.approx(size, rel=1e-6)  # one to one, and to scale
    widest = max(shapely.minimum_bounding_radius(shape) for shape in shapes) * 2
    tree = shapely.STRtree(shapes)
    near = tree.query(shapes, predicate="dwithin", distance=0.6 * widest)
    assert (near[0] == near[1]).all()


def test_what_can_be_unrolled_keeps_all_lengths():
    cells = grow_cells(Mesh(*cylinder(4000)), 20)
    atlas = cell_atlas(cells)
    stretch = singular_values(cells.mesh.V, cells.mesh.F, atlas.uv, atlas.F_uv)
    assert np.percentile(np.abs(stretch - 1), 99) < 0.02


def test_a_flat_sheet_is_only_moved():
    cells = grow_cells(Mesh(*disc(1000)), 10)
    atlas = cell_atlas(cells)
    stretch = singular_values(cells.mesh.V, cells.mesh.F, atlas.uv, atlas.F_uv)
    assert np.abs(stretch - 1).max() < 1e-6


def test_cells_that_fold_are_rescued():
    V, F = sphere(2000)
    G, kept = compact(F[V[F, 2].min(1) < 48])
    ball = one_cell((V[kept], G))
    atlas = cell_atlas(ball)
    assert atlas.facts == {"rescued": 1, "flips": 0}
    assert singular_values(ball.mesh.V, ball.mesh.F, atlas.uv, atlas.F_uv).max() < 12


def test_cells_that_lie_whole_in_a_plane_stay_as_they_are_there():
    V, F = disc(2000)
    cells = grow_cells(Mesh(V, F), 6)
    plane = cells.mesh.V[:, :2] @ np.array([[0.0, 1.0], [-1.0, 0.0]]) * [1.1, 1.0]
    known = plane[cells.mesh.F]
    torn = cells.cell == 2
    half = torn & (known.mean(1)[:, 0] > np.median(known[torn].mean(1)[:, 0]))
    known[half] += [500.0, 0.0]  # a seam runs through this one
    atlas = cell_atlas(cells, known)
    stretch = singular_values(cells.mesh.V, cells.mesh.F, atlas.uv, atlas.F_uv)
    as_known = singular_values(cells.mesh.V, cells.mesh.F, plane)
    np.testing.assert_allclose(stretch[~torn], as_known[~torn] / np.sqrt(1.1), rtol=1e-6)
    np.testing.assert_allclose(stretch[torn], 1.0, rtol=1e-6)


@pytest.mark.parametrize("seed", range(5))
def test_vertices_that_were_pushed_over_their_neighbours_come_back(seed):
    V, F = disc(1500)
    p = patches(Mesh(V, F), np.zeros(len(F), np.int64))
    uv = p.V[:, :2].copy()
    rng = np.random.default_rng(seed)
    inner = np.setdiff1d(np.arange(len(p.V)), p.F.ravel()[border_halfedges(p.F)])
    pushed = rng.choice(inner, 12, replace=False)
    uv[pushed] += rng.normal(scale=6.0, size=(12, 2))
    assert mirrored(p, uv).sum() > 10
    assert folded(p, uv).all()
    flat = untangle(p, uv)
    assert not mirrored(p, flat).any()
    still = (flat == uv).all(1)
    assert still.sum() > 0.75 * len(uv)
    np.testing.assert_array_equal(np.isin(np.flatnonzero(~still), inner), True)


def test_a_fold_at_the_rim_is_left_rather_than_made_worse():
    V, F = disc(400)
    p = patches(Mesh(V, F), np.zeros(len(F), np.int64))
    uv = p.V[:, :2].copy()
    rim = p.F.ravel()[border_halfedges(p.F)[0]]
    uv[rim] *= 0.2
    before = mirrored(p, uv).sum()
    assert before > 0
    assert mirrored(p, untangle(p, uv)).sum() <= before
    np.testing.assert_array_equal(untangle(p, uv)[rim], uv[rim])
