"""A face that holds a whole text once ended the puzzle with a ValueError."""

import numpy as np
import pytest

from meshjig.extras.engrave import LETTERING, LabelFacts, engrave
from meshjig.extras.label_ground import label_grounds
from tests.extras.sheets import whole_shell
from tests.meshes import Shape


@pytest.mark.parametrize("height", [0.0, 4.0], ids=["one face", "two that meet in a fold beside it"])
def test_text_within_a_single_face_is_engraved(height):
    V = np.array([[-40.0, -30, 0], [40, -30, 0], [0, 60, 0], [0, -90, -height]])
    F = np.array([[0, 1, 2], [1, 0, 3]])[: 1 + bool(height)]
    piece, outer, D = whole_shell(Shape(V[: 3 + bool(height)], F), 2.0)
    _, facts = engrave([piece], ["4"], label_grounds([piece], outer, D), LETTERING["fdm"])
    assert facts == LabelFacts(1, 5.0, {})
