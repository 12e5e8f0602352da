import numpy as np
import pytest

from meshjig.cells.distances import nearest, within
from meshjig.cells.surface import surface_graph
from meshjig.mesh.types import Mesh
from tests.meshes import creased_box, cylinder, disc, sphere


def around(V):
    """Unroll a tube of radius 25."""
    return np.column_stack([25 * np.arctan2(V[:, 1], V[:, 0]), V[:, 2]])


def on_tube(V, a):
    far = around(V) - around(V[[a]])
    far[:, 0] = (far[:, 0] + 25 * np.pi) % (50 * np.pi) - 25 * np.pi
    return np.linalg.norm(far, axis=1)


EXACT = {
    "flat": (disc(3000), lambda V, a: np.linalg.norm(V - V[a], axis=1)),
    "tube": (cylinder(6000), on_tube),
    "sphere": (sphere(5000), lambda V, a: 50 * np.arccos(np.clip(V @ V[a] / 2500, -1, 1))),
}


@pytest.mark.parametrize(("shape", "exact"), EXACT.values(), ids=EXACT.keys())
def test_distances_are_geodesic_within_a_few_per_cent(shape, exact):
    mesh = Mesh(*shape)
    V = mesh.V
    sources = np.array([0, len(V) // 2])
    source, distance = within(V, surface_graph(mesh), sources, 20.0)
    for k in range(2):
        row, column = np.nonzero(source == k)
        truth = exact(V, sources[k])
        reach = truth[row] > 5
        ratio = distance[row, column][reach] / truth[row][reach]
        assert ratio.min() > 0.98
        assert ratio.max() < 1.09
        assert ratio.mean() < 1.06


def test_every_source_in_reach_is_listed_nearest_first():
    mesh = Mesh(*sphere(3000))
    V = mesh.V
    sources = np.random.default_rng(0).choice(len(V), 30, replace=False)
    source, distance = within(V, surface_graph(mesh), sources, 30.0, kept=30)
    assert (np.diff(np.where(np.isfinite(distance), distance, 1e9), axis=1) >= 0).all()
    straight = np.linalg.norm(V[:, None] - V[sources], axis=2)
    listed = np.zeros((len(V), 30), bool)
    row, column = np.nonzero(source >= 0)
    listed[row, source[row, column]] = True
    assert listed[straight < 0.9 * 30].all()
    assert (distance[row, column] >= straight[row, source[row, column]] - 1e-9).all()


def test_vertices_out_of_reach_still_have_their_nearest_source():
    mesh = Mesh(*disc(2000))
    V = mesh.V
    graph = surface_graph(mesh)
    sources = np.array([0, 5])
    source, distance = within(V, graph, sources, 4.0)
    assert (source[:, 0] >= 0).all()
    assert np.isfinite(distance[:, 0]).all()
    assert (source[:, 0] == nearest(graph, sources)).mean() > 0.99


def test_a_way_over_a_crease_costs_more_where_asked():
    mesh = Mesh(*creased_box(3000))
    V = mesh.V
    places = np.array([[0, 0, 50], [50, 0, 0], [20, 20, 50]])
    top, side, other = np.linalg.norm(V[:, None] - places, axis=2).argmin(0).tolist()
    graphs = [surface_graph(mesh, bend) for bend in (0.0, 30.0)]
    plain, bent = (within(V, graph, np.array([top]), 200.0)[1][:, 0] for graph in graphs)
    assert bent[other] == pytest.approx(plain[other])
    assert bent[side] - plain[side] == pytest.approx(30 * np.radians(90 - 2 * 8), rel=0.02)
