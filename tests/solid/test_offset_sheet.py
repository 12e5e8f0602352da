import igl
import numpy as np
import pytest

from meshjig.errors import SolidError
from meshjig.solid.crossing_pairs import crossing_pairs
from meshjig.solid.offset_sheet import displacement
from tests.meshes import (
    cavity_shell,
    creased_box,
    disc,
    genus2,
    inside_out,
    joined,
    moved,
    noisy,
    open_cup,
    saddle,
    sphere,
    torus,
    two_components,
)

T = 2.0
CREASED = {"genus2", "box", "cup"}
SHAPES = {
    "sphere": sphere(3000),
    "torus": torus(3000),
    "genus2": genus2(16000),
    "cup": open_cup(3000),
    "saddle": saddle(2000),
    "disc": disc(1000),
    "box": creased_box(3000),
    "two": two_components(3000),
    "cavity": cavity_shell(3000),
    "noisy": noisy(sphere(6000), 0.2),
}


def distances(V, F, D, n=4000):
    """From random points of the surface to the inner sheet."""
    rng = np.random.default_rng(0)
    area = np.linalg.norm(np.cross(V[F[:, 1]] - V[F[:, 0]], V[F[:, 2]] - V[F[:, 0]]), axis=1)
    face = rng.choice(len(F), n, p=area / area.sum())
    points = np.einsum("kj,kjd->kd", rng.dirichlet([1, 1, 1], n), V[F[face]])
    return np.sqrt(igl.point_mesh_squared_distance(points, V + D, F)[0])


@pytest.mark.parametrize("name", SHAPES)
def test_inner_sheet_is_a_thickness_away_and_crosses_nothing(name):
    V, F = SHAPES[name]
    D, facts = displacement(V, F, T)
    away = distances(V, F, D)
    assert ((away > 0.8 * T) & (away < 1.25 * T)).mean() > (0.9 if name in CREASED else 0.97)
    assert facts.folds_left == 0
    both = np.concatenate([F, F[:, ::-1] + len(V)])
    assert len(crossing_pairs(np.concatenate([V, V + D]), both)[0]) == 0


def test_a_sphere_has_its_smaller_sphere_inside():
    V, F = SHAPES["sphere"]
    D, facts = displacement(V, F, T)
    assert np.linalg.norm(V + D, axis=1) == pytest.approx(np.full(len(V), 48.0), abs=0.15)
    assert facts.thin_area_share == 0
    assert facts.min_thickness == pytest.approx(T, abs=0.15)


def test_walls_that_face_each_other_share_the_room():
    top, bottom = moved(disc(1000), [0, 0, 1.5]), moved(inside_out(disc(1000)), [0, 0, -1.5])
    V, F = joined(top, bottom)
    D, facts = displacement(V, F, T)
    assert ((V + D)[:, 2] * np.sign(V[:, 2])).min() > 0.05  # neither passes the middle
    assert np.median(np.linalg.norm(D, axis=1)) > 1.2
    assert facts.thin_area_share > 0.9
    assert facts.folds_left == 0


def test_the_place_of_a_model_does_not_matter():
    shape = SHAPES["torus"]
    D = displacement(*shape, T)[0]
    far = displacement(*moved(shape, [300, -200, 100]), T)[0]
    assert far == pytest.approx(D, abs=1e-2)


@pytest.mark.parametrize("thickness", [25.0, 80.0])
def test_walls_thicker_than_the_model_are_refused_with_the_largest_that_works(thickness):
    V, F = SHAPES["torus"]  # its tube is 30 mm thick
    with pytest.raises(SolidError, match=r"a thickness of (\d+\.?\d*) mm may do") as error:
        displacement(V, F, thickness)
    largest = float(str(error.value).split("a thickness of ")[-1].split()[0])
    assert 5 < largest < 20
    D, _ = displacement(V, F, largest)
    assert np.isfinite(D).all()
