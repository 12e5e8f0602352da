"""A model has the size that was asked for, or a plausible one; with fewer faces it stays what it is."""

import numpy as np
import pytest

from meshjig.errors import OptionError
from meshjig.mesh.measure import mesh_volume
from meshjig.scan import decimate, read_scan, to_millimetres
from meshjig.scan.source import Unit
from tests.meshes import (
    border,
    creased_box,
    cylinder,
    genus2,
    half_sphere,
    noisy,
    open_cup,
    sphere,
    topology,
    torus,
    two_components,
)

V = torus(300).V


@pytest.mark.parametrize(
    ("extent", "size", "result", "rule"),
    [
        (100.0, None, 100.0, "taken as mm"),
        (20.0, None, 20.0, "taken as mm"),
        (500.0, None, 500.0, "taken as mm"),
        (19.9, None, 150.0, "scaled to 150 mm"),
        (501.0, None, 150.0, "scaled to 150 mm"),
        (0.1, None, 150.0, "scaled to 150 mm"),
        (0.1, 80.0, 80.0, "as asked"),
        (100.0, 700.0, 700.0, "as asked"),
    ],
)
def test_the_largest_extent_follows_the_rule_that_is_named(extent, size, result, rule):
    scaled = to_millimetres(V * extent / np.ptp(V, axis=0).max(), size)
    assert np.ptp(scaled.V, axis=0).max() == pytest.approx(result)
    assert scaled.facts.size_mm == pytest.approx(np.ptp(scaled.V, axis=0))
    assert scaled.facts.scale == pytest.approx(result / extent)
    assert rule in scaled.facts.units


METRE, MILLIMETRE = Unit(1000.0, "m", False), Unit(1.0, "mm", True)
INCH = Unit(25.4, "inch", True)


@pytest.mark.parametrize(
    ("extent", "size", "unit", "said", "result", "rule"),
    [
        (600.0, None, "auto", MILLIMETRE, 600.0, "600 mm, as the file says"),
        (0.5, None, "auto", INCH, 12.7, "0.5 inch, as the file says"),
        (0.2, None, "auto", METRE, 200.0, "0.2 m, as the file says"),
        (100.0, None, "auto", METRE, 150.0, "100 m, as the file says, is unlikely: scaled to 150 mm"),
        (100.0, None, "m", METRE, 1e5, "100 m as asked"),
        (3.0, None, "inch", None, 76.2, "3 inch as asked"),
        (3.0, None, "cm", MILLIMETRE, 30.0, "3 cm as asked"),
        (600.0, None, "mm", None, 600.0, "600 mm as asked"),
        (600.0, 80.0, "m", MILLIMETRE, 80.0, "set to 80 mm as asked"),
    ],
)
def test_size_goes_before_the_unit_asked_and_that_before_the_files(extent, size, unit, said, result, rule):
    scaled = to_millimetres(V * extent / np.ptp(V, axis=0).max(), size, unit, said)
    assert np.ptp(scaled.V, axis=0).max() == pytest.approx(result)
    assert rule in scaled.facts.units


@pytest.mark.parametrize("offset", [0.0, 300.0, 5e5])
@pytest.mark.parametrize("size", [None, 42.0])
def test_the_matrix_leads_back_to_the_source(offset, size):
    source = V + np.array([offset, -offset, 1])
    scaled = to_millimetres(source, size)
    back = np.column_stack([scaled.V, np.ones(len(V))]) @ scaled.to_source.T
    np.testing.assert_allclose(back[:, :3], source, atol=1e-9 * max(1, offset))


def test_only_a_model_far_away_is_moved():
    assert to_millimetres(V + 200).facts.moved_mm is None
    np.testing.assert_array_equal(to_millimetres(V + 200).V, V + 200)
    far = to_millimetres(V + np.array([5000, 0, 0]))
    assert far.facts.moved_mm == pytest.approx([-5000, 0, 0], abs=1)
    assert np.abs(far.V).max() < 100


@pytest.mark.parametrize("maker", [sphere, torus, genus2, creased_box, open_cup, cylinder, half_sphere])
def test_simplifying_keeps_topology_borders_and_shape(maker):
    mesh = noisy(maker(4000), 0.05)
    V, F = decimate(*mesh, 1500)
    assert 1400 < len(F) <= 1500
    assert topology(F) == topology(mesh.F)
    assert border(V, F)[1] == pytest.approx(border(*mesh)[1], rel=0.03)
    assert mesh_volume(V, F) == pytest.approx(mesh_volume(*mesh), rel=0.01, abs=1.0)
    np.testing.assert_allclose(np.ptp(V, axis=0), np.ptp(mesh.V, axis=0), rtol=0.03)


def test_simplifying_keeps_every_component():
    scan = read_scan(two_components(4000), faces=1000)
    assert scan.facts.components == 2
    assert scan.facts.genus == 1
    assert scan.facts.working_faces == len(scan.mesh.F) <= 1000
    assert scan.facts.decimated_from == len(two_components(4000).F)


@pytest.mark.parametrize("faces", [5000, "all"])
def test_a_mesh_within_its_resolution_is_left_alone(faces):
    mesh = torus(4000)
    scan = read_scan(mesh, faces=faces)
    np.testing.assert_array_equal(scan.mesh.F, mesh.F)
    assert scan.facts.decimated_from is None


@pytest.mark.parametrize(
    "size", [0, -1.0, np.nan, np.inf, 10**400, np.float64(-2), "150", "x" * 500, [150], True]
)
def test_a_size_that_is_no_length_is_refused(size):
    for call in (
        lambda: read_scan(tuple(sphere(100)), size=size),
        lambda: to_millimetres(sphere(100).V, size),
    ):
        with pytest.raises(OptionError, match=r"^size: .* is no (number|length): give ") as error:
            call()
        assert error.value.option == "size"
        assert len(str(error.value)) < 100
