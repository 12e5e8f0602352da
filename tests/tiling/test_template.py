"""A template finds the neck and the head of whatever knob is drawn."""

import numpy as np
import pytest

from meshjig.tiling.template import Template, classic, rectangular

KNOBS = {"classic": classic, "rectangular": rectangular}


def leaning(template, by):
    return Template(template.points + by * template.points[:, 1:] * [1.0, 0.0])


@pytest.mark.parametrize("name", sorted(KNOBS))
@pytest.mark.parametrize("n", [4, 9, 30])
@pytest.mark.parametrize("lean", [0.0, 0.3, -0.4])
def test_neck_and_head_are_where_the_drawing_has_them(name, n, lean):
    knob = leaning(KNOBS[name](n), lean)
    head = np.linalg.norm(np.diff(knob.points[list(knob.head)], axis=0))
    assert knob.neck_width == pytest.approx(0.13, rel=0.06)
    assert head == pytest.approx(0.25, rel=0.06)
    assert 0 < knob.neck[0] < knob.head[0] < knob.head[1] < knob.neck[1] < len(knob.points)


def test_height_and_reach_are_those_of_the_knob():
    knob = rectangular(8)
    assert knob.height == pytest.approx(0.2)
    assert knob.reach == pytest.approx(0.125)
