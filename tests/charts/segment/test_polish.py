import numpy as np

from meshjig.charts.segment.accept import Judge
from meshjig.charts.segment.dual_graph import dual
from meshjig.charts.segment.polish import polish
from tests.meshes import disc, half_sphere


def seam(graph, label):
    return graph.length[label[graph.first] != label[graph.second]].sum()


def test_a_winding_border_gets_nearly_straight():
    V, F = disc(3000)
    graph = dual(V, F)
    x, y = V[F].mean(1)[:, :2].T
    label = (x > 9 * np.sin(y / 4)).astype(np.int64)
    smooth = polish(F, graph, label, Judge(V, F))
    assert seam(graph, smooth) < 0.65 * seam(graph, label)
    assert seam(graph, smooth) < 1.4 * 100
    assert set(smooth) == {0, 1}


def test_charts_stay_good():
    V, F = half_sphere(3000)
    graph, judge = dual(V, F), Judge(V, F)
    x, y, z = V[F].mean(1).T
    label = np.where(z > 35 + 4 * np.sin(8 * np.arctan2(y, x)), 0, np.where(np.abs(y) > x, 1, 2))
    assert not judge.accepts(np.arange(len(F)))
    good = [judge.accepts(np.flatnonzero(label == k)) for k in range(3)]
    smooth = polish(F, graph, label, judge)
    assert seam(graph, smooth) < seam(graph, label)
    for k in range(3):
        assert judge.accepts(np.flatnonzero(smooth == k)) >= good[k]
