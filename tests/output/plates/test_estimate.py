import numpy as np
import pytest

from meshjig.options import PROCESSES
from meshjig.output.piece import Piece
from meshjig.output.plates.estimate import RATES, estimate, estimate_plates, estimate_volume
from meshjig.output.plates.pack import pack
from meshjig.output.plates.printers import Plate
from tests.meshes import creased_box, sphere
from tests.output.plates.test_pack import tile


def test_every_process_has_its_rate():
    assert set(RATES) == set(PROCESSES)


def test_the_estimate_is_for_the_volume_of_all_pieces():
    pieces = [Piece("a", *creased_box(300), (0, 0, 0)), Piece("b", *sphere(5000), (0, 0, 0))]
    found = estimate(pieces, "fdm")
    assert found["volume_mm3"] == pytest.approx(100**3 + 523_600, rel=0.01)
    half = estimate(pieces[:1], "fdm")
    assert found["hours"] / half["hours"] == pytest.approx(1.5236, rel=0.01)


def test_a_hundred_pieces_two_mm_thick_of_a_bunny_as_sliced():
    """PrusaSlicer with 0.2 mm layers and supports: 224 cm3 of PLA; 30 h at 60 mm/s, 20 h at 170 mm/s."""
    found = estimate_volume(49_000, 2.0, "fdm")
    assert found["volume_mm3"] == 98_000
    assert found["grams"] == pytest.approx(224 * 1.24, rel=0.05)
    assert 20 < found["hours"] < 30


def test_own_processes_count_as_fdm_and_what_is_cut_takes_no_printing():
    assert estimate_volume(100, 2, "my printer") == estimate_volume(100, 2, "fdm")
    assert estimate_volume(100, 2, "foam")["hours"] is None


@pytest.mark.parametrize("n", [1, 20, 100, 300])
@pytest.mark.parametrize("plate", [Plate(145, 145), Plate(250, 210), Plate(360, 360)])
def test_plates_estimated_are_about_those_needed(n, plate):
    rng = np.random.default_rng(n)
    sides = 20 * 1.2 * np.exp(rng.normal(0, 0.2, (n, 2)))  # rectangles around pieces of about 400 mm2
    needed = pack([tile(*size) for size in sides], plate, 5.0).n_plates
    assert abs(estimate_plates(n, 400.0 * n, plate, 5.0) - needed) <= 0.5 + 0.1 * needed
