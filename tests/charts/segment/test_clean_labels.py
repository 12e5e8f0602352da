import numpy as np
import pytest

from meshjig.charts.segment.clean_labels import clean_labels
from meshjig.mesh.components import components, is_disc
from meshjig.mesh.halfedges import edges
from meshjig.mesh.measure import face_areas
from meshjig.mesh.mesh import Mesh
from tests.meshes import disc, noisy, open_cup, sphere


@pytest.mark.parametrize("mesh", [sphere(3000), open_cup(3000), noisy(disc(3000), 0.3)])
def test_speckled_labels_come_out_as_whole_regions_without_pinches(mesh):
    rng = np.random.default_rng(4)
    x = mesh.V[mesh.F].mean(1)[:, 0]
    wanted = np.digitize(x, [-15, 15])
    speckled = np.where(rng.random(len(x)) < 0.15, rng.integers(-1, 3, len(x)), wanted)
    label = clean_labels(Mesh(*mesh), speckled, face_areas(*mesh))
    assert (label == wanted)[np.abs(np.abs(x) - 15) > 8].all()
    for k in range(3):
        G = mesh.F[label == k]
        assert components(G)[0] == 1
        e = edges(G)
        rim = e.E[e.n_faces == 1]
        assert np.bincount(rim.ravel()).max() == 2


def test_a_checkerboard_band_gets_one_plain_border():
    mesh = disc(2400)
    x = mesh.V[mesh.F].mean(1)[:, 0]
    jagged = (x + 3 * (-1.0) ** np.arange(len(x)) > 0).astype(np.int64)
    label = clean_labels(Mesh(*mesh), jagged, face_areas(*mesh))
    assert is_disc(mesh.F[label == 0])
    assert is_disc(mesh.F[label == 1])
