import numpy as np

from meshjig.charts.locate import locate
from tests.meshes import disc


def test_points_inside_get_the_face_that_holds_them_and_others_none():
    V, F = disc(2000)
    rng = np.random.default_rng(0)
    points = rng.uniform(-70, 70, (3000, 2))
    face, bary = locate(V[:, :2], F, points)
    radius = np.linalg.norm(points, axis=1)
    assert (face[radius < 49] >= 0).all()
    assert (face[radius > 50.001] == -1).all()
    assert np.isnan(bary[face < 0]).all()
    held = face >= 0
    assert bary[held].min() >= -1e-9
    np.testing.assert_allclose(
        np.einsum("kj,kjd->kd", bary[held], V[F[face[held]], :2]), points[held], atol=1e-9
    )


def test_every_corner_is_found_though_it_lies_in_several_faces():
    V, F = disc(500)
    face, bary = locate(V[:, :2], F, V[:, :2])
    assert (F[face] == np.arange(len(V))[:, None]).any(1).all()
    np.testing.assert_allclose(bary.max(1), 1, atol=1e-9)


def test_needles_and_nothing_are_no_trouble():
    uv = np.array([[0, 0], [1000, 1], [0, 1e-3], [0.0, 50]])
    F = np.array([[0, 1, 2], [2, 1, 3]])
    face, _ = locate(uv, F, np.array([[10, 0.0105], [10, 20.0], [np.nan, 0], [1e9, 1e9]]))
    assert face.tolist() == [0, 1, -1, -1]
    assert locate(uv, F[:0], uv)[0].tolist() == [-1] * 4
    assert locate(uv, F, uv[:0])[0].shape == (0,)
