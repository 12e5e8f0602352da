import numpy as np
import pytest
from scipy.sparse import csr_matrix
from scipy.sparse.csgraph import connected_components

from meshjig.charts.segment.region import Regions, is_neck_free, without_necks
from meshjig.mesh.components import is_disc
from meshjig.mesh.measure import face_areas
from meshjig.mesh.mesh import Mesh
from tests.meshes import creased_box, disc


def marked(shape):
    """Mark the faces of a disc whose centres lie in a part of the plane."""
    mesh = disc(6000)
    return mesh, shape(*mesh.V[mesh.F].mean(1)[:, :2].T)


def dumbbell(width):
    """Two squares with a bridge of some mm between them; faces are 1.5 mm wide."""
    return marked(
        lambda x, y: (
            ((np.abs(np.abs(x) - 25) < 10) & (np.abs(y) < 10)) | ((np.abs(x) < 25) & (y > 0) & (y < width))
        )
    )


def with_thorn(width):
    """A square with a thorn 30 mm long and some mm wide."""
    body = 15
    return marked(
        lambda x, y: (
            ((np.abs(x + body) < body) & (np.abs(y) < body)) | ((x >= 0) & (x < 30) & (y > 0) & (y < width))
        )
    )


def stout(mesh, chosen):
    region = Regions(mesh.F).disc(np.flatnonzero(chosen))
    return region is not None and is_neck_free(region)


def test_thin_necks_and_thorns_are_not_stout_and_wide_ones_are():
    assert stout(*dumbbell(6.0))
    assert not stout(*dumbbell(1.2))
    assert stout(*with_thorn(6.0))
    assert not stout(*with_thorn(1.2))


@pytest.mark.parametrize("seed", range(30))
def test_a_disc_with_a_neck_of_a_single_edge_is_not_stout(seed):
    mesh, rng = disc(1500), np.random.default_rng(seed)
    centre = mesh.V[mesh.F].mean(1)
    spots = rng.uniform(-35, 35, (4, 2))
    near = np.linalg.norm(centre[:, None, :2] - spots, axis=2).min(1) < rng.uniform(10, 30)
    region = Regions(mesh.F).disc(np.flatnonzero(near))
    if region is None:
        return
    inner = np.setdiff1d(np.arange(len(region.kept)), region.loop)
    graph = csr_matrix((len(region.kept),) * 2, dtype=np.int8).tolil()
    for a, b, c in region.F:
        graph[a, b] = graph[b, c] = graph[c, a] = 1
    n_cores, _ = connected_components(graph.tocsr()[inner][:, inner], directed=False)
    if n_cores > 1:
        assert not is_neck_free(region)


def test_a_neck_is_cut_and_a_thorn_given_away():
    mesh, chosen = dumbbell(1.2)
    label = without_necks(Mesh(*mesh), chosen.astype(np.int64), face_areas(*mesh))
    x = mesh.V[mesh.F].mean(1)
    left, right = label[(np.abs(x - [-25, 0, 0]).max(1) < 7)], label[(np.abs(x - [25, 0, 0]).max(1) < 7)]
    assert np.ptp(left) == np.ptp(right) == 0
    assert left[0] != right[0]
    mesh, chosen = with_thorn(1.2)
    label = without_necks(Mesh(*mesh), chosen.astype(np.int64), face_areas(*mesh))
    x = mesh.V[mesh.F].mean(1)
    assert np.ptp(label[x[:, 0] > 5]) == 0


def test_a_region_is_a_disc_when_topology_says_so():
    mesh = creased_box(1200)
    regions = Regions(mesh.F)
    x = mesh.V[mesh.F].mean(1)
    for chosen in (x[:, 2] > 20, np.abs(x[:, 2]) < 20, x[:, 2] > -60, np.abs(x[:, 0]) > 40, x[:, 0] > 49.9):
        faces = np.flatnonzero(chosen)
        region = regions.disc(faces)
        assert (region is not None) == is_disc(mesh.F[faces])
        if region is not None:
            assert (region.kept[region.F] == mesh.F[faces]).all()
            ring = mesh.V[region.kept[region.loop]]
            assert np.linalg.norm(ring - np.roll(ring, -1, 0), axis=1).max() < 15
