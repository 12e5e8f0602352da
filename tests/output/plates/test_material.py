"""Grams and hours."""

from dataclasses import replace

import numpy as np
import pytest

from meshjig.options import PROCESSES
from meshjig.output.piece import Piece
from meshjig.output.plates.material import (
    RATES,
    Bulk,
    bulk_of,
    bulk_of_surface,
    material_of,
)
from tests.meshes import creased_box, sphere
from tests.output.plates.tiles import bent


def test_every_other_process_has_its_rate():
    assert set(RATES) == set(PROCESSES) - {"fdm"}


# As PrusaSlicer 2.5 sliced them: 0.4 mm nozzle, 0.2 mm layers, 15 % infill, supports, PLA, its own speeds.
@pytest.mark.parametrize(
    ("bulk", "grams", "hours"),
    [
        (Bulk(80_020, 108_429, 29_754, 108_670), 233, 28.6),  # three plates of pieces of the bunny
        (Bulk(137_858, 125_462, 20_750, 111_567), 239, 25.9),  # fandisk and its core
        (Bulk(69_190, 87_970, 27_813, 148_461), 215, 24.0),  # duck
    ],
)
def test_what_lies_on_plates_takes_what_was_sliced(bulk, grams, hours):
    found = material_of(bulk, "fdm")
    assert found["grams"] == pytest.approx(grams, rel=0.2)
    assert found["hours"] == pytest.approx(hours, rel=0.2)


def test_the_volume_is_that_of_all_pieces():
    pieces = [Piece("a", *creased_box(300), (0, 0, 0)), Piece("b", *sphere(5000), (0, 0, 0))]
    assert bulk_of(pieces).volume == pytest.approx(100**3 + 523_600, rel=0.01)
    assert bulk_of([]) == (0, 0, 0, 0)


def test_a_few_of_many_stand_for_all():
    one = Piece("a", *bent(30, 20, 0.03, n=9), (0, 0, 0))
    many = bulk_of([replace(one, name=str(k)) for k in range(100)])
    np.testing.assert_allclose(many, 100 * np.array(bulk_of([one])), rtol=1e-9)
    assert many.support > 0


def test_own_processes_count_as_fdm_and_what_is_cut_takes_no_printing():
    bulk = bulk_of_surface(1000, 2, 10)
    assert material_of(bulk, "my printer") == material_of(bulk, "fdm")
    assert material_of(bulk, "foam")["hours"] is None
    assert material_of(bulk, "sla")["hours"] < material_of(bulk, "fdm")["hours"]
