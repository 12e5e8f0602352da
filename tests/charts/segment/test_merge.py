import numpy as np

from meshjig.charts.segment.accept import Acceptance
from meshjig.charts.segment.dual_graph import dual_graph
from meshjig.charts.segment.merge import polish
from meshjig.mesh.mesh import Mesh
from tests.meshes import disc, half_sphere


def seam(graph, label):
    return graph.length[label[graph.first] != label[graph.second]].sum()


def test_a_winding_border_gets_nearly_straight():
    V, F = disc(3000)
    graph = dual_graph(V, F)
    x, y = V[F].mean(1)[:, :2].T
    label = (x > 9 * np.sin(y / 4)).astype(np.int64)
    smooth = polish(Mesh(V, F), graph, label, Acceptance(V, F))
    assert seam(graph, smooth) < 0.65 * seam(graph, label)
    assert seam(graph, smooth) < 1.4 * 100
    assert set(smooth) == {0, 1}


def test_charts_stay_good():
    V, F = half_sphere(3000)
    graph, acceptance = dual_graph(V, F), Acceptance(V, F)
    x, y, z = V[F].mean(1).T
    label = np.where(z > 35 + 4 * np.sin(8 * np.arctan2(y, x)), 0, np.where(np.abs(y) > x, 1, 2))
    assert not acceptance.accepts(np.arange(len(F)))
    good = [acceptance.accepts(np.flatnonzero(label == k)) for k in range(3)]
    smooth = polish(Mesh(V, F), graph, label, acceptance)
    assert seam(graph, smooth) < seam(graph, label)
    for k in range(3):
        assert acceptance.accepts(np.flatnonzero(smooth == k)) >= good[k]
