import numpy as np
import pytest

from meshjig.errors import OptionError
from meshjig.output.plates.pack import pack
from meshjig.output.plates.printers import (
    PRINTERS,
    Plate,
    estimate_plates,
    parse_plate,
)
from tests.output.plates.test_pack import tile


@pytest.mark.parametrize(
    ("text", "plate"),
    [
        ("220x220", Plate(220, 220)),
        ("120.5 X 80", Plate(120.5, 80)),
        ("300x200x100", Plate(300, 200, 100)),
        ("Prusa-MK4", Plate(250, 210, 220)),
        (" formlabs-3 ", Plate(145, 145, 185)),
    ],
)
def test_sizes_and_names_are_read(text, plate):
    assert parse_plate(text) == plate


@pytest.mark.parametrize("plate", PRINTERS.values(), ids=PRINTERS.keys())
def test_a_printers_plate_reads_as_its_size(plate):
    assert parse_plate(str(plate).removesuffix(" mm")) == plate
    assert min(plate) > 100
    assert max(plate) < 500


@pytest.mark.parametrize(
    "text", ["", "220", "x220", "220x", "0x200", "200x0.0x10", "-5x20", "anycubic", "1x2x3x4"]
)
def test_what_is_no_plate_is_told_with_what_would_be(text):
    with pytest.raises(OptionError, match=r"plate: .*WIDTHxDEPTH"):
        parse_plate(text)


@pytest.mark.parametrize("n", [1, 20, 100, 300])
@pytest.mark.parametrize("plate", [Plate(145, 145), Plate(250, 210), Plate(360, 360)])
def test_plates_estimated_are_about_those_needed(n, plate):
    rng = np.random.default_rng(n)
    sides = 20 * 1.2 * np.exp(rng.normal(0, 0.2, (n, 2)))  # rectangles around pieces of about 400 mm2
    needed = pack([tile(*size) for size in sides], plate, 5.0).n_plates
    assert abs(estimate_plates(n, 400.0 * n, plate, 5.0) - needed) <= 0.5 + 0.1 * needed
