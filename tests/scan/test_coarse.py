"""Coordinates whose numbers are too coarse for the mesh are refused; all others pass."""

import numpy as np
import pytest

from meshjig.errors import InputError
from meshjig.scan.coarse import refuse_coarse
from tests.meshes import half_sphere, sphere, torus

UTM = np.array([432_000.0, 5_321_000.0, 520.0])  # metres: a survey in Vienna


def as_float32(V):
    return V.astype(np.float32).astype(np.float64)


def with_six_digits(V):
    return np.array([[float(f"{x:.6g}") for x in row] for row in V])


@pytest.mark.parametrize("mesh", [sphere(20_000), half_sphere(20_000)], ids=["closed", "open"])
@pytest.mark.parametrize(("rounded", "step"), [(as_float32, "0.5"), (with_six_digits, "10")])
def test_a_survey_with_too_few_digits_is_refused(mesh, rounded, step):
    with pytest.raises(InputError, match=rf"steps of {step}, .*offset") as refused:
        refuse_coarse(rounded(mesh.V / 10 + UTM), mesh.F, "survey.ply")
    assert "survey.ply" in str(refused.value)
    assert "y = 5321000" in str(refused.value)


@pytest.mark.parametrize(
    "V",
    [
        sphere(2000).V / 10 + UTM,
        as_float32(sphere(2000).V),
        as_float32(sphere(2000).V + np.array([3000, 0, 0])),
        as_float32(sphere(2000).V * 1e4 + UTM),
        with_six_digits(sphere(2000).V + 300),
        np.round(sphere(2000).V),
    ],
    ids=["in double", "near", "not far", "large", "few digits", "on a grid"],
)
def test_numbers_that_do_pass(V):
    refuse_coarse(V, sphere(2000).F, "scan.stl")


def test_a_mesh_without_any_extent_is_left_to_others():
    refuse_coarse(np.ones((3, 3)), np.array([[0, 1, 2]]), "point.stl")
    refuse_coarse(torus(300).V * 0, torus(300).F, "point.stl")
