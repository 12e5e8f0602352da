"""Which way is up."""

from types import SimpleNamespace

import numpy as np
import pytest

from meshjig.errors import OptionError
from meshjig.mesh.mesh import Mesh
from meshjig.pipeline.up import up_axis, up_direction
from meshjig.scan.source import Source
from tests.meshes import sphere


def _bust(up, told=None):
    """A ball of radius 10 cut flat 6 below its middle, as seen along an axis that is up."""
    V, F = sphere(1500)
    V = 10 * V / np.linalg.norm(V, axis=1, keepdims=True)
    height = V @ up
    return Source(V + np.outer(np.maximum(-6 - height, 0), up), F, up=told)


def _scan(source, floor=None):
    """What is asked of a scan here."""
    facts = SimpleNamespace(floor=floor and SimpleNamespace(axis=floor))
    return SimpleNamespace(source=source, mesh=Mesh(source.vertices, source.faces), facts=facts)


@pytest.mark.parametrize("axis", [1, 2])
def test_a_flat_base_is_below_in_pictures_where_nothing_else_is_said(axis):
    up = up_direction("auto", _scan(_bust(np.eye(3)[axis])))
    np.testing.assert_allclose(up, np.eye(3)[axis], atol=0.03)


@pytest.mark.parametrize("axis", [1, 2])
def test_a_floor_is_cut_off_along_z_where_nothing_else_is_said_and_pictures_stand_on_it(axis):
    source = _bust(np.eye(3)[axis])
    assert up_axis("auto", source) == 2
    np.testing.assert_array_equal(up_direction("auto", _scan(source, "z")), [0, 0, 1])


def test_the_file_wins_over_the_shape_and_what_is_asked_over_both():
    source = _bust(np.eye(3)[2], told="y")
    assert up_axis("auto", source) == 1
    assert up_axis("x", source) == 0
    np.testing.assert_array_equal(up_direction("auto", _scan(source)), [0, 1, 0])
    np.testing.assert_array_equal(up_direction("x", _scan(source)), [1, 0, 0])


def test_a_tilted_base_is_guessed_between_the_axes():
    up = np.array([0.0, np.sin(0.4), np.cos(0.4)])
    np.testing.assert_allclose(up_direction("auto", _scan(_bust(up))), up, atol=0.03)


def test_there_are_three_axes():
    with pytest.raises(OptionError, match="no axis 'w'"):
        up_axis("w", _bust(np.eye(3)[2]))
