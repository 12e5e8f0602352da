"""A function runs beside its caller, or in it, with the same outcome."""

import os

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
    assert not beside._child.alive()


def test_a_child_that_has_answered_is_asked_again():
    V, F = sphere(500)
    first = Background(face_areas, V, F)
    first.result()
    second = Background(face_areas, V, F)
    assert second._child is first._child
    np.testing.assert_array_equal(second.result(), face_areas(V, F))


def test_work_done_gently_has_a_child_of_its_own():
    plain = Background(niceness)
    assert Background(niceness, gently=True).result() > plain.result()


def test_a_child_that_has_ended_meanwhile_is_replaced():
    first = Background(niceness)
    first.result()
    first._child.kill()
    second = Background(niceness)
    assert second._child is not first._child
    assert second.result() == first.result()


def niceness():
    return os.nice(0)
