import numpy as np
import pytest

from meshjig.errors import OptionError
from meshjig.output.pictures.view import axis_of, guess_up, up_of, view_of
from tests.meshes import closed_cylinder, half_sphere, sphere


def turned(V, up):
    """Turn z to up."""
    other = np.cross(up, [0.3, 0.5, 0.8])
    other /= np.linalg.norm(other)
    return V @ np.stack([other, np.cross(up, other), up])


def bust(up):
    """A half sphere standing on its flat side, its top towards up."""
    V, F = half_sphere(1500)
    rim = np.flatnonzero(np.isclose(V[:, 2], V[:, 2].min()))
    ring = rim[np.argsort(np.arctan2(V[rim, 1], V[rim, 0]))]
    base = np.stack([np.full(len(ring), len(V)), np.roll(ring, -1), ring], 1)
    V = np.concatenate([V, V[ring].mean(axis=0, keepdims=True)])
    return turned(V, up), np.concatenate([F, base])


@pytest.mark.parametrize("up", [[0, 1, 0], [0, 0, 1], [0, 0.8, 0.6], [0.6, 0.8, 0]])
def test_a_model_stands_on_its_flat_base(up):
    np.testing.assert_allclose(guess_up(*bust(np.array(up, float))), up, atol=0.03)


def test_without_a_base_y_is_up():
    np.testing.assert_array_equal(guess_up(*sphere(1500)), [0, 1, 0])


def test_axes_have_names():
    np.testing.assert_array_equal(axis_of("-z"), [0, 0, -1])
    with pytest.raises(OptionError, match="'w'"):
        axis_of("w")


@pytest.mark.parametrize("up", [[0, 1, 0], [0, 0, 1], [1, 0, 0], [-0.6, 0, 0.8]])
@pytest.mark.parametrize("azimuth", [30, 210])
def test_a_view_is_upright_and_filled(up, azimuth):
    V, _ = closed_cylinder(800)
    V = V + 500
    up = np.array(up, float)
    view = view_of(V, up, azimuth, 18)
    np.testing.assert_allclose(view.axes @ view.axes.T, np.eye(3), atol=1e-12)
    assert view.axes[0] @ up == pytest.approx(0, abs=1e-12)
    assert view.axes[1] @ up > 0.9
    seen = (V - view.eye) @ view.axes.T
    assert seen[:, 2].min() > 0
    place = (seen[:, :2] / seen[:, 2:] - view.centre) / view.half
    assert np.abs(place).max() == pytest.approx(1)


def test_a_report_says_what_is_up_before_the_shape_does():
    V, F = bust(np.array([0.0, 0, 1]))
    np.testing.assert_array_equal(up_of({"up": [2.0, 0, 0]}, V, F), [1, 0, 0])
    np.testing.assert_allclose(up_of({}, V, F), [0, 0, 1], atol=0.03)
