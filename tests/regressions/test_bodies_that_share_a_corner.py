"""Bodies that share a corner: the thickness that was advised was refused again."""

import re

import numpy as np
import pytest

from meshjig import make_puzzle
from meshjig.errors import SolidError
from meshjig.options import Options
from meshjig.pipeline.plan import plan_puzzle
from tests.meshes import Shape

CORNERS = np.array([[0.0, 0, 0], [1, 0.2, 0], [1, -0.2, 0], [1, 0, 0.3]])


def star(points):
    """Tetrahedra 40 mm long around the origin; each has its own corner there."""
    turns = 2 * np.pi * np.arange(points) / points
    V = [
        CORNERS @ np.array([[np.cos(t), np.sin(t), 0], [-np.sin(t), np.cos(t), 0], [0, 0, 1]]) for t in turns
    ]
    F = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    return Shape(40 * np.concatenate(V), np.concatenate([F + 4 * k for k in range(points)]))


def refused(bodies, thickness):
    with pytest.raises(SolidError, match=f"walls of {thickness:g} mm are too thick") as error:
        plan_puzzle(star(bodies), Options.of(pieces=4 * bodies, thickness=thickness, through="off"))
    return str(error.value)


def test_what_is_advised_makes_a_sound_puzzle():
    advised = float(re.search(r"a thickness of ([0-9.]+) mm works", refused(2, 6.0))[1])
    report = make_puzzle(
        star(2), pieces=8, thickness=advised, min_wall=0, through="off"
    ).report  # corners are thin
    assert report["ok"], report["failures"]
    assert report["exempt"] == {}


@pytest.mark.slow
def test_thinner_walls_are_not_called_too_thick_where_they_work():
    assert make_puzzle(star(5), pieces=20, thickness=1.0, min_wall=0, through="off").report["ok"]
    assert "so are thinner ones" not in refused(5, 6.0)
