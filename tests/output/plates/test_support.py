"""What a printer has to hold up."""

import numpy as np
import pytest
import trimesh

from meshjig.output.plates.support import support_under
from tests.meshes import sphere


def table(height):
    """A slab of 40 x 20 x 2 on one leg of 4 x 4, both as one mesh of two bodies."""
    top = trimesh.creation.box((40, 20, 2), trimesh.transformations.translation_matrix([0, 0, height + 1]))
    leg = trimesh.creation.box((4, 4, height), trimesh.transformations.translation_matrix([0, 0, height / 2]))
    both = trimesh.util.concatenate([top.subdivide().subdivide().subdivide(), leg])
    return np.array(both.vertices), np.array(both.faces)


@pytest.mark.parametrize("height", [5.0, 30.0])
@pytest.mark.parametrize("lifted", [0.0, 7.0])
def test_a_table_top_rests_on_what_fills_the_room_below(height, lifted):
    V, F = table(height)
    found = support_under(V + np.array([100, 0, lifted]), F)
    assert found.overhang == pytest.approx(40 * 20, rel=0.01)
    assert found.room == pytest.approx(40 * 20 * height, rel=0.03)


def test_a_block_needs_none_and_what_is_steep_holds_itself():
    box = trimesh.creation.box((10, 10, 10))
    assert support_under(np.array(box.vertices), np.array(box.faces)) == (0, 0)
    cone = trimesh.creation.cone(10, 12)  # on its tip
    assert support_under(np.array(cone.vertices) * [1, 1, -1], np.array(cone.faces)[:, ::-1]) == (0, 0)


def test_a_ball_within_a_ball_rests_on_the_floor_of_the_hollow():
    V, F = sphere(3000, 20.0)
    inner = V / 2
    both, faces = np.concatenate([V, inner]), np.concatenate([F, F[:, ::-1] + len(V)])
    alone, hollow = support_under(V, F), support_under(both, faces)
    steep = 10 * np.sin(np.pi / 4)  # radius within which the ceiling leans over
    room = 2 * np.pi * 2 / 3 * (10**3 - (10**2 - steep**2) ** 1.5)
    assert hollow.room - alone.room == pytest.approx(room, rel=0.05)
