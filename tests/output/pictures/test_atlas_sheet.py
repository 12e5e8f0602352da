import numpy as np
from PIL import Image

from meshjig.charts import build_atlas
from meshjig.mesh.halfedges import edges
from meshjig.mesh.mesh import Mesh
from meshjig.output.pictures.atlas_sheet import cuts
from meshjig.output.pictures.scene import draw_lines, scene_of
from meshjig.output.pictures.view import view_of
from tests.meshes import cylinder, sphere


def test_cuts_are_where_charts_end_and_the_mesh_does_not():
    for mesh in (cylinder(600), sphere(800)):
        atlas = build_atlas(Mesh(*mesh))
        found = cuts(atlas)
        ends = [int((edges(F).n_faces == 1).sum()) for F in (atlas.F_uv, mesh.F)]
        assert 2 * len(found) + ends[1] == ends[0]
        sides = np.sort(edges(mesh.F).E, axis=1).tolist()
        assert all(side in sides for side in np.sort(found, axis=1).tolist())


def test_lines_behind_the_model_are_hidden():
    V, F = sphere(800)
    scene = scene_of(V, F, np.ones((len(F), 3)), np.zeros(len(F), np.int64))
    view = view_of(V, np.array([0.0, 1.0, 0.0]), 0.0, 0.0)  # from +z
    E = edges(F).E

    def inked(depth):
        image = Image.new("RGB", (200, 200), "white")
        draw_lines(image, scene, view, V[E[depth(V[E][..., 2].mean(1))]], 200)
        return (np.asarray(image) < 128).any(2)

    assert not inked(lambda z: z < -10).any()
    rows, columns = np.nonzero(inked(lambda z: z > 30))
    reach = np.hypot(rows - 99.5, columns - 99.5)
    assert len(rows) > 1000
    assert reach.max() < 90
