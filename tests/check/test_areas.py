import numpy as np
import pytest

from meshjig.check import area_cv, area_error


def test_equal_areas_do_not_vary():
    assert area_cv(np.full(7, 3.0)) == 0


def test_variation_is_deviation_over_mean_in_any_unit():
    assert area_cv(np.array([1.0, 3.0])) == pytest.approx(0.5)
    assert area_cv(np.array([100.0, 300.0])) == pytest.approx(0.5)


def test_no_areas_have_no_variation():
    assert area_cv(np.zeros(0)) is None
    assert area_error(np.zeros(0), np.zeros(0)) is None


def test_missing_and_doubled_area_are_both_errors():
    surface = np.full(10, 2.0)
    assert area_error(np.array([15.0, 5.0]), surface) == pytest.approx(0)
    assert area_error(np.array([15.0]), surface) == pytest.approx(0.25)
    assert area_error(np.array([15.0, 10.0]), surface) == pytest.approx(0.25)
