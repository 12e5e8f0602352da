import numpy as np
import pytest

from meshjig.cells.distances import smooth_distances, within
from meshjig.cells.power import balance
from meshjig.cells.sample_seeds import sample_seeds
from meshjig.cells.surface import surface
from meshjig.mesh.components import components
from meshjig.mesh.types import Mesh
from tests.meshes import cylinder, disc, joined, moved, sphere, torus


def test_weights_give_cells_the_areas_asked_for():
    s = surface(Mesh(*disc(8000)))
    seeds = sample_seeds(s, 20, 0)
    near = within(s.V, s.graph, seeds, float(np.sqrt(s.area.sum() / 20)))
    target = np.random.default_rng(0).uniform(0.6, 1.4, 20)
    target *= s.area.sum() / target.sum()
    _, field = balance(near, s.V[seeds], s.area, target, np.zeros(20))
    found = np.bincount(field.owner, s.area, 20)
    assert (found / target).std() < 0.03


def test_cells_on_a_flat_sheet_are_those_of_the_plane():
    s = surface(Mesh(*disc(8000)))
    seeds = sample_seeds(s, 15, 0)
    spacing = float(np.sqrt(s.area.sum() / 15))
    near = smooth_distances(s, within(s.V, s.graph, seeds, spacing), spacing)
    target = s.targets(seeds, np.ones(15))
    weights, field = balance(near, s.V[seeds], s.area, target, np.zeros(15))
    plane = ((s.V[:, None] - s.V[seeds]) ** 2).sum(2) - weights
    assert (field.owner == plane.argmin(1)).mean() > 0.93


def test_softened_distances_waver_less():
    s = surface(Mesh(*disc(8000)))
    middle = np.array([0, 4000])
    near = within(s.V, s.graph, middle, 30.0)
    soft = smooth_distances(s, near, 30.0)
    listed = (near[0][:, :5] == soft[0]) & (soft[0] == 0) & (near[1][:, :5] > 5) & (near[1][:, :5] < 25)
    row, column = np.nonzero(listed)
    wavers = []
    for source, distance in (near, soft):
        assert (source[row, column] == 0).all()
        ratio = distance[row, column] / np.linalg.norm(s.V[row], axis=1)
        steps = np.abs(ratio[:, None] - ratio[None, :])[np.abs(row[:, None] - row[None, :]) == 1]
        wavers.append(steps.mean())
    assert wavers[1] < 0.8 * wavers[0]


@pytest.mark.parametrize(
    "shape", [sphere(2000), torus(2000), cylinder(2000)], ids=["sphere", "torus", "tube"]
)
def test_seeds_are_spread_evenly(shape):
    s = surface(Mesh(*shape))
    seeds = sample_seeds(s, 40, 0)
    assert len(np.unique(seeds)) == 40
    apart = np.linalg.norm(s.V[seeds][:, None] - s.V[seeds], axis=2) + 1e9 * np.eye(40)
    assert apart.min() > 0.55 * np.sqrt(s.area.sum() / 40)


def test_components_share_seeds_by_area():
    V, F = joined(sphere(2000), moved(sphere(1000, 25.0), [150, 0, 0]), moved(disc(24, 2.0), [-150, 0, 0]))
    s = surface(Mesh(V, F))
    of_vertex = np.zeros(len(V), int)
    of_vertex[F.ravel()] = np.repeat(components(F)[1], 3)
    counts = np.bincount(of_vertex[sample_seeds(s, 50, 0)])
    assert counts.tolist() == [39, 10, 1]
