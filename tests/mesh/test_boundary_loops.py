import numpy as np

from meshjig.mesh.boundary_loops import border_loop
from tests.meshes import disc, sphere


def test_the_border_loop_runs_with_the_chart_on_its_left():
    V, F = disc(600)
    loop = border_loop(F)
    np.testing.assert_allclose(np.linalg.norm(V[loop], axis=1), 50)
    x, y = V[np.append(loop, loop[0]), :2].T
    assert (x[:-1] * y[1:] - x[1:] * y[:-1]).sum() > 0
    assert len(np.unique(loop)) == len(loop)
    assert len(border_loop(sphere(100)[1])) == 0
