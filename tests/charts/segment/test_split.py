import numpy as np

from meshjig.charts.segment.split import split
from meshjig.mesh.components import components, is_disc
from meshjig.mesh.mesh import Mesh
from tests.meshes import cylinder


def test_split_stops_as_soon_as_every_part_is_good():
    mesh = cylinder(600)
    label = split(Mesh(*mesh), np.zeros(len(mesh.F), np.int64), lambda faces: is_disc(mesh.F[faces]), 0)
    assert 2 <= label.max() + 1 <= 4
    assert all(is_disc(mesh.F[label == k]) for k in range(label.max() + 1))
    small = split(Mesh(*mesh), np.zeros(len(mesh.F), np.int64), lambda faces: len(faces) <= 50, 0)
    assert np.bincount(small).max() <= 50
    assert all(components(mesh.F[small == k])[0] == 1 for k in range(small.max() + 1))
