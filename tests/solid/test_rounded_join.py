import igl
import numpy as np
import pytest

from meshjig.solid.rounded_join import rounded
from meshjig.solid.shell import shell
from meshjig.solid.surface_distance import SurfaceDistance
from tests.meshes import creased_box, torus

T = 2.0


@pytest.mark.parametrize("mesh", [torus(3000), creased_box(20000)], ids=["torus", "box"])
@pytest.mark.parametrize("side", ["in", "out"])
def test_vertices_lie_at_the_exact_distance(mesh, side):
    V, F = mesh
    wall = shell(V, F, T, side=side, join="round")
    sheet = wall.outer + wall.D if side == "in" else wall.outer
    away = np.sqrt(igl.point_mesh_squared_distance(sheet, V, F)[0])
    assert (np.abs(away - T) < 0.02 * T).mean() > 0.98
    assert wall.facts.join_method == "libigl offset_surface"
    assert 0.5 < wall.facts.join_cell < 1.1


def test_a_sheet_out_of_reach_is_left_as_it_is():
    V, F = creased_box(3000)
    D = -0.1 * V  # far above the offset surface for a wall of 30 mm
    after, facts = rounded(V, F, D, 30.0, SurfaceDistance(V, F))
    assert (after == D).all()
    assert facts.joined_share == 0
