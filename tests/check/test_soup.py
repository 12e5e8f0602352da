import numpy as np
import pytest

from meshjig.check.soup import area_samples, soup
from tests.check.pieces import box, turned
from tests.meshes import sphere

BIG, SMALL = turned(box([0, 0, 0], [30, 20, 10], 3), 1), sphere(300, 4)


def test_samples_lie_on_the_faces_they_name():
    s = soup([BIG, SMALL])
    P, face = area_samples(s, 2000)
    height = np.einsum("ij,ij->i", P - s.V[s.F[face, 0]], s.N[face])
    np.testing.assert_allclose(height, 0, atol=1e-9)
    assert (np.diff(face) >= 0).all()


def test_each_piece_gets_samples_by_its_area():
    s = soup([BIG, SMALL])
    share = (s.piece[area_samples(s, 5000).face] == 0).mean()
    assert s.area[s.piece == 0].sum() == pytest.approx(2200)
    assert share == pytest.approx(2200 / s.area.sum(), abs=1e-3)


def test_samples_are_even_within_a_face():
    corners = np.array([[0, 0, 0], [90, 0, 0], [0, 90, 0.0]])
    P, _ = area_samples(soup([(corners, np.array([[0, 1, 2]]))]), 5000)
    np.testing.assert_allclose(P.mean(0), [30, 30, 0], atol=0.5)
    assert (P[:, 0] + P[:, 1] < 45).mean() == pytest.approx(0.25, abs=0.01)
    assert (P[:, 0] < 45).mean() == pytest.approx(0.75, abs=0.01)
