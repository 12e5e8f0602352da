"""A function runs beside its caller, or in it, with the same outcome."""

import numpy as np
import pytest

from meshjig.background import Background
from meshjig.errors import SolidError
from meshjig.measure import face_areas
from meshjig.solid import displacement
from tests.meshes import sphere


@pytest.mark.parametrize("alone", [False, True])
def test_the_result_is_that_of_the_function(alone):
    V, F = sphere(500)
    np.testing.assert_array_equal(Background(face_areas, V, F, alone=alone).result(), face_areas(V, F))


@pytest.mark.parametrize("alone", [False, True])
def test_what_the_function_raises_is_raised_when_the_result_is_asked_for(alone):
    beside = Background(displacement, *sphere(500), 90.0, alone=alone)
    with pytest.raises(SolidError, match="thick"):
        beside.result()


def test_a_cancelled_child_is_gone():
    beside = Background(displacement, *sphere(20_000), 2.0)
    beside.cancel()
    assert beside._child.poll() is not None
