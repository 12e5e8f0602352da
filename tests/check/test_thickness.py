import numpy as np
import pytest

from meshjig.check import measure_thickness
from tests.check.pieces import box, hemisphere_shells, shell, turned
from tests.meshes import disc

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
    V, F = disc(3000, 20)
    inner = V - [0, 0, 2.0]
    inner[np.linalg.norm(V[:, :2], axis=1) < 10] += [0, 0, 1.0]  # a quarter of the area at half thickness
    facts = measure_thickness([shell(V, inner, F)]).facts(2.0)
    assert facts["min"] == pytest.approx(1.0, abs=1e-5)
    assert facts["median"] == pytest.approx(2.0, abs=1e-5)
    assert facts["thin_area_share"] == pytest.approx(0.25, abs=0.03)


def test_walls_towards_a_neighbour_are_no_thickness():
    narrow = [box([3.1 * k, 0, 0], [3.1 * k + 3, 30, 2]) for k in range(8)]  # walls hold 40 % of the area
    samples = measure_thickness(narrow[1:] + narrow[:1])
    inner = np.isin(samples.piece, range(6))
    between = samples.samples[inner]
    assert np.isclose(between, 2.0, atol=1e-5).mean() > 0.95  # but for the far ends, 30 mm apart


def test_unknown_thickness_leaves_the_share_unknown():
    assert measure_thickness(PLATES).facts(None)["thin_area_share"] is None
