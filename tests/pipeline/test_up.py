"""Which way is up."""

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


@pytest.mark.parametrize("axis", [1, 2])
def test_a_flat_base_is_below_where_nothing_else_is_said(axis):
    assert up_axis("auto", _bust(np.eye(3)[axis])) == axis


def test_the_file_wins_over_the_shape_and_what_is_asked_over_both():
    source = _bust(np.eye(3)[2], told="y")
    assert up_axis("auto", source) == 1
    assert up_axis("x", source) == 0
    np.testing.assert_array_equal(
        up_direction("auto", source, Mesh(source.vertices, source.faces)), [0, 1, 0]
    )


def test_a_tilted_base_is_guessed_between_the_axes():
    up = np.array([0.0, np.sin(0.4), np.cos(0.4)])
    source = _bust(up)
    assert up_axis("auto", source) == 2
    np.testing.assert_allclose(
        up_direction("auto", source, Mesh(source.vertices, source.faces)), up, atol=0.03
    )


def test_there_are_three_axes():
    with pytest.raises(OptionError, match="no axis 'w'"):
        up_axis("w", _bust(np.eye(3)[2]))
