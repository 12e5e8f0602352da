import numpy as np
import pytest
import shapely

from meshjig.cells import cell_atlas, grow_cells
from meshjig.cells.cell_mesh import CellMesh
from meshjig.mesh.components import components
from meshjig.mesh.halfedges import compact
from meshjig.mesh.measure import face_areas, singular_values
from meshjig.mesh.types import Mesh
from tests.meshes import cylinder, disc, genus2, noisy, open_cup, sphere, torus


def one_cell(shape):
    """Take a whole disc for a cell."""
    V, F = shape
    none = np.zeros(len(V), np.int64)
    return CellMesh(Mesh(V, F), np.arange(len(F)), none, np.ones((len(V), 3)), np.zeros(len(F), np.int64))


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
