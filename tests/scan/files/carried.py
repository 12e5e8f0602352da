"""A model that shows all that a mesh file can carry, and whether what was read back shows it."""

import numpy as np

from meshjig.mesh.components import components
from meshjig.mesh.measure import area_vectors, mesh_volume

OUTLINE = [(0, 0), (30, 0), (30, 10), (10, 10), (10, 20), (0, 20)]  # an L, whose caps are concave
HEIGHT, AREA, VOLUME, EXTENT = 10, 1800, 4000, (30, 20, 10)
V = np.array([(x, y, z) for z in (0, HEIGHT) for x, y in OUTLINE], float)
N = len(OUTLINE)
POLYGONS = [list(range(N))[::-1], list(range(N, 2 * N))]
POLYGONS += [[k, (k + 1) % N, N + (k + 1) % N, N + k] for k in range(N)]
TRIANGLES = [[0, 2, 1], [0, 3, 2], [0, 5, 3], [3, 5, 4], [6, 7, 8], [6, 8, 9], [6, 9, 11], [9, 10, 11]]
TRIANGLES += [t for a, b, c, d in POLYGONS[2:] for t in ([a, b, c], [c, d, a])]
PICTURE = np.zeros((8, 8, 3), np.uint8)
PICTURE[:, :4], PICTURE[:, 4:] = (250, 0, 0), (0, 0, 250)


def colour_at(points):
    """The colour of vertices, (..., 3) uint8."""
    return np.rint(np.asarray(points) * (8, 12, 25)).astype(np.uint8)


def colour_towards(normals):
    """The colour of faces by their unit normals, (..., 3) uint8, of 32 levels that all formats can carry."""
    return np.rint((np.rint(np.asarray(normals)) + 1) * 15).astype(np.uint8) * 8


def uv_at(points):
    """Places in the picture, (..., 2): its left is red, its right blue."""
    return np.asarray(points)[..., :2] / (30, 20)


def normals(polygons):
    """The unit normals of polygons."""
    first = np.array([[V[p[1]] - V[p[0]], V[p[2]] - V[p[1]]] for p in polygons])
    n = np.cross(first[:, 0], first[:, 1])
    return n / np.linalg.norm(n, axis=1, keepdims=True)


def assert_polygons(source):
    F = source.faces
    assert len(F) == len(TRIANGLES)
    assert np.linalg.norm(area_vectors(source.vertices, F), axis=1).sum() / 2 == _near(AREA)
    assert mesh_volume(source.vertices, F) == _near(VOLUME)


def assert_several_bodies(source):
    """Two of the model, the other 50 further along x."""
    W, F = np.unique(source.vertices[source.faces].reshape(-1, 3), axis=0, return_inverse=True)
    assert components(F.reshape(-1, 3))[0] == 2
    assert np.ptp(W, axis=0).tolist() == [80, 20, 10]
    assert mesh_volume(source.vertices, source.faces) == _near(2 * VOLUME)


def assert_vertex_colours(source):
    np.testing.assert_allclose(
        source.look.rgb.astype(int), colour_at(source.vertices[source.faces]).astype(int), atol=1
    )


def assert_face_colours(source):
    n = area_vectors(source.vertices, source.faces)
    wanted = colour_towards(n / np.linalg.norm(n, axis=1, keepdims=True)).astype(int)
    np.testing.assert_allclose(source.look.rgb.astype(int), np.repeat(wanted[:, None], 3, axis=1), atol=8)


def assert_texture(source):
    middle = source.vertices[source.faces].mean(axis=1)
    height, width = source.look.picture.shape[:2]
    x, y = (source.look.uv.mean(axis=1) * (1, -1) + (0, 1)).T * [[width], [height]]
    seen = source.look.picture[np.clip(y.astype(int), 0, height - 1), np.clip(x.astype(int), 0, width - 1)]
    left = middle[:, 0] < 15
    assert left.any()
    assert not left.all()
    np.testing.assert_allclose(seen[left], [[250, 0, 0]] * left.sum(), atol=30)
    np.testing.assert_allclose(seen[~left], [[0, 0, 250]] * (~left).sum(), atol=30)


def _near(value):
    import pytest

    return pytest.approx(value, rel=1e-5)
