"""The body of a groove is closed, as deep and as narrow as asked, and its sides don't face each other."""

import numpy as np
import pytest

from meshjig.check.closed import is_closed
from meshjig.check.self_intersection import self_intersections
from meshjig.extras.groove import TOP, groove
from meshjig.extras.text import text_outline
from meshjig.mesh.booleans import arrays
from meshjig.mesh.measure import area_vectors, unit

TEXTS = ["0", "4", "8", "68", "1357", "100", "XB8"]


@pytest.mark.parametrize("text", TEXTS)
@pytest.mark.parametrize(
    ("height", "stroke", "inset"), [(5.0, 0.8, 0.25), (4.0, 0.8, 0.25), (3.0, 0.4, 0.17)]
)
def test_groove_is_closed_and_does_not_cross_itself(text, height, stroke, inset):
    V, F = arrays(groove(text_outline(text, height, stroke), inset))
    assert is_closed(F)
    assert len(self_intersections(V, F, 1e-6)) == 0


@pytest.mark.parametrize("text", TEXTS)
def test_sections_are_the_outline_drawn_in(text):
    outline, inset = text_outline(text, 5.0, 0.8), 0.25
    body = groove(outline, inset)
    for z in (-0.99, -0.5, 0.0, 0.9 * TOP):
        section = sum(_area(loop) for loop in body.slice(z).to_polygons())
        assert section == pytest.approx(outline.buffer(inset * z).area, rel=0.03)


@pytest.mark.parametrize("text", TEXTS)
def test_sides_slope_by_the_inset(text):
    V, F = arrays(groove(text_outline(text, 5.0, 0.8), 0.25))
    N, size = unit(area_vectors(V, F)), np.linalg.norm(area_vectors(V, F), axis=1)
    side = np.abs(N[:, 2]) < 0.999
    slope = np.abs(N[side, 2])
    assert np.average(slope, weights=size[side]) == pytest.approx(0.25 / np.hypot(0.25, 1), rel=0.15)


def _area(loop):
    x, y = np.asarray(loop).T
    return float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2
