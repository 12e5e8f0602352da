"""A function runs beside its caller, or in it, with the same outcome."""

import os
import time

import numpy as np
import pytest

from meshjig.errors import SolidError
from meshjig.mesh.measure import face_areas
from meshjig.runtime.worker import Background
from meshjig.solid import displacement
from tests.meshes import sphere

needs_cores = pytest.mark.skipif((os.cpu_count() or 1) < 2, reason="on one core nothing runs beside")


@pytest.mark.parametrize("alone", [False, True])
def test_the_result_is_that_of_the_function(alone):
    V, F = sphere(500)
    np.testing.assert_array_equal(Background(face_areas, V, F, alone=alone).result(), face_areas(V, F))


@pytest.mark.parametrize("alone", [False, True])
def test_what_the_function_raises_is_raised_when_the_result_is_asked_for(alone):
    beside = Background(displacement, *sphere(500), 90.0, alone=alone)
    with pytest.raises(SolidError, match="thick"):
        beside.result()


@needs_cores
def test_a_cancelled_child_is_gone():
    beside = Background(displacement, *sphere(20_000), 2.0)
    beside.cancel()
    assert not beside._child.alive()


@needs_cores
def test_a_child_that_has_answered_is_asked_again():
    V, F = sphere(500)
    first = Background(face_areas, V, F)
    first.result()
    second = Background(face_areas, V, F)
    assert first._child is not None
    assert second._child is first._child
    np.testing.assert_array_equal(second.result(), face_areas(V, F))


@needs_cores
@pytest.mark.skipif(os.nice(0) >= 19, reason="there is nothing gentler")
def test_work_done_gently_has_a_child_of_its_own():
    plain = Background(os.nice, 0)
    assert Background(os.nice, 0, gently=True).result() > plain.result()


@needs_cores
def test_a_child_that_has_ended_meanwhile_is_replaced():
    first = Background(os.getpid)
    pid = first.result()
    first._child.kill()
    assert Background(os.getpid).result() not in (pid, os.getpid())


@needs_cores
def test_a_child_that_ends_at_work_leaves_it_to_the_caller():
    beside = Background(time.sleep, 60)
    beside._child.kill()
    beside._function, beside._arguments = os.getpid, ()
    assert beside.result() == os.getpid()


def test_what_cannot_be_sent_is_done_by_the_caller():
    assert Background(len, [lambda: None]).result() == 1
