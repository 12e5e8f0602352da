import numpy as np
import pytest

from meshjig.check import measure_thickness
from tests.check.pieces import box, hemisphere_shells, turned

PLATES = [box([0, 0, 0], [10, 10, 2], 6), box([10.2, 0, 0], [20, 10, 2], 5)]


@pytest.mark.parametrize("thickness", [0.8, 2.0, 3.0])
def test_half_sphere_shells_are_as_thick_as_made(thickness):
    facts = measure_thickness(hemisphere_shells(20, thickness, 0.2)).facts(thickness)
    assert facts["min"] == pytest.approx(thickness, rel=0.01)
    assert facts["p1"] == pytest.approx(thickness, rel=0.01)
    assert facts["median"] == pytest.approx(thickness, rel=0.01)
    assert facts["thin_area_share"] == 0


@pytest.mark.parametrize("seed", range(3))
def test_plates_are_as_thick_as_made_wherever_they_lie(seed):
    facts = measure_thickness([turned(piece, seed) for piece in PLATES]).facts(2.0)
    assert facts["p1"] == pytest.approx(2.0, abs=1e-5)
    assert facts["median"] == pytest.approx(2.0, abs=1e-5)


def test_the_thin_part_of_a_piece_is_found_with_its_share():
    V, F = box([0, 0, 0], [40, 40, 2], 40)
    V[(V[:, 2] < 0.1) & (V[:, 0] < 10.1), 2] = 1.0  # a quarter of the area at half thickness
    facts = measure_thickness([(V, F)]).facts(2.0)
    assert facts["min"] == pytest.approx(1.0, abs=1e-5)
    assert facts["median"] == pytest.approx(2.0, abs=1e-5)
    assert facts["thin_area_share"] == pytest.approx(0.25, abs=0.03)


def test_walls_towards_a_neighbour_are_no_thickness():
    strips = [box([3.1 * k, 0, 0], [3.1 * k + 3, 30, 2]) for k in range(8)]  # walls hold 40 % of the area
    measured = measure_thickness(strips)
    between = measured.samples[(measured.piece > 0) & (measured.piece < 7)]
    sheet, ends = np.isclose(between, 2.0, atol=1e-5), np.isclose(between, 30.0, atol=1e-4)
    assert (sheet | ends).all()
    assert sheet.mean() == pytest.approx(180 / (180 + 12), abs=0.01)  # the ends face nobody


def test_unknown_thickness_leaves_the_share_unknown():
    assert measure_thickness(PLATES).facts(None)["thin_area_share"] is None


def test_a_body_without_opposite_sides_has_no_thickness():
    corners = np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]], float)
    tetrahedron = corners, np.array([[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]])
    assert measure_thickness([tetrahedron]).facts(2.0) == dict.fromkeys(
        ["min", "p1", "median", "thin_area_share"]
    )
