import numpy as np
import pytest

from meshjig.errors import SolidError
from meshjig.solid.crossing_pairs import crossing_pairs
from meshjig.solid.shell import shell
from tests.meshes import creased_box, genus2, noisy, open_cup, sphere, torus, two_components

T = 2.0
SHAPES = {
    "torus": torus(3000),
    "genus2": genus2(16000),
    "cup": open_cup(3000),
    "two": two_components(3000),
    "noisy": noisy(sphere(6000), 0.2),
}


def crossings(wall, F):
    both = np.concatenate([F, F[:, ::-1] + len(wall.outer)])
    return len(crossing_pairs(np.concatenate([wall.outer, wall.outer + wall.D]), both)[0])


@pytest.mark.parametrize(
    ("side", "join", "outer", "inner"),
    [
        ("in", "miter", 50, 48),
        ("out", "miter", 52, 50),
        ("both", "miter", 51, 49),
        ("in", "round", 50, 48),
        ("both", "round", 51, 49),
    ],
)
def test_a_ball_gets_its_wall_on_the_side_that_was_asked_for(side, join, outer, inner):
    V, F = sphere(3000)
    wall = shell(V, F, T, side=side, join=join)
    assert np.linalg.norm(wall.outer, axis=1) == pytest.approx(np.full(len(V), outer), abs=0.15)
    assert np.linalg.norm(wall.outer + wall.D, axis=1) == pytest.approx(np.full(len(V), inner), abs=0.15)
    assert wall.facts.side == side
    assert wall.facts.join == join
    assert wall.facts.min_thickness == pytest.approx(T, abs=0.15)


@pytest.mark.parametrize("side", ["in", "out", "both"])
@pytest.mark.parametrize("name", SHAPES)
def test_sheets_cross_nothing_on_any_side(name, side):
    V, F = SHAPES[name]
    wall = shell(V, F, T, side=side)
    assert crossings(wall, F) == 0
    assert wall.facts.crossings_left == 0
    assert wall.facts.thin_area_share < 0.05


@pytest.mark.parametrize(("join", "corner"), [("miter", 2.0), ("round", 2.0 / np.sqrt(3))])
def test_the_corner_of_a_box_grown_outward_is_sharp_or_round(join, corner):
    V, F = creased_box(20000)
    wall = shell(V, F, T, side="out", join=join)
    assert crossings(wall, F) == 0
    half = V.max(0)
    at = np.abs(np.abs(V) - half).max(1) < 1e-6
    assert at.sum() == 8
    away = np.abs(wall.outer[at]) - half
    assert away == pytest.approx(np.full((8, 3), corner), abs=0.2)


@pytest.mark.parametrize("side", ["in", "out", "both"])
def test_an_open_surface_has_no_rounded_join(side):
    with pytest.raises(SolidError, match="closed"):
        shell(*SHAPES["cup"], T, side=side, join="round")


def test_the_thinnest_place_is_told():
    V, F = sphere(6000)
    V = V * np.array([1, 1, 1]) * (1 - 0.97 * np.exp(-((V[:, [2]] / 12) ** 2)) * np.array([1, 1, 0]))
    wall = shell(V, F, T)  # an hourglass with a waist of 3 mm
    assert abs(wall.facts.thinnest_at[2]) < 5
    assert 0 < wall.facts.min_thickness < 1.0
    assert 0 < wall.facts.thin_area_share < 0.2


def test_the_outer_sheet_is_the_surface_itself():
    V, F = SHAPES["torus"]
    assert (shell(V, F, T).outer == V).all()
