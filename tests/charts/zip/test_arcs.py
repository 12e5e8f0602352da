import numpy as np
import pytest

from meshjig.charts.zip.arcs import fits

SHAPE = np.exp(1j * np.linspace(0, 2, 200)) * 30  # an arc of 60 mm
LENGTH = np.full(200, 60 / 200)


def worthiest(first, second, least=5.0):
    return max(fits(first, second, LENGTH, least), key=lambda fit: fit.worth)


@pytest.mark.parametrize("angle", [0.0, 1.0, 3.0])
def test_a_moved_curve_is_moved_back_as_a_whole(angle):
    moved = SHAPE * np.exp(1j * angle) + 7 - 3j
    fit = worthiest(SHAPE, moved)
    assert (fit.begin, fit.end) == (0, 200)
    assert fit.worth == pytest.approx(60)
    np.testing.assert_allclose(moved * fit.turn + fit.shift, SHAPE, atol=1e-9)


def test_where_curves_part_the_part_that_fits_is_worth_most():
    other = SHAPE.copy()
    other[100:] += 1j * np.linspace(0, 40, 100)
    fit = worthiest(SHAPE, other)
    assert fit.end <= 110
    assert fit.worth > 20


def test_a_mirrored_curve_hardly_fits():
    assert worthiest(SHAPE, SHAPE.conj()).worth < 0.6 * worthiest(SHAPE, SHAPE).worth


def test_no_stretch_is_shorter_than_asked():
    found = fits(SHAPE, SHAPE, LENGTH, 20.0)
    assert found
    assert min((fit.end - fit.begin) * LENGTH[0] for fit in found) >= 20 - 2 * LENGTH[0]
    assert not fits(SHAPE, SHAPE, LENGTH, 61.0)
