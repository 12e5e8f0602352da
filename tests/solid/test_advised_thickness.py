"""A thickness that is advised works when it is given; where none is advised, none was found."""

import re

import pytest

from meshjig.errors import SolidError
from meshjig.solid.shell import shell
from tests.meshes import Shape, sphere, torus

THIN = {
    "ball": (sphere(1500, 10.0), 50.0),
    "lens": (Shape(sphere(1500).V * [1, 1, 0.06], sphere(1500).F), 6.0),
    "ring": (torus(1500), 40.0),
}


@pytest.mark.parametrize("name", THIN)
@pytest.mark.parametrize("side", ["in", "both"])
def test_an_advised_thickness_is_taken(name, side):
    (V, F), thickness = THIN[name]
    with pytest.raises(SolidError, match=f"walls of {thickness:g} mm are too thick") as error:
        shell(V, F, thickness, side=side)
    said = str(error.value)
    advised = re.search(r"a thickness of ([0-9.]+) mm works", said)
    if advised is None:
        assert "no thinner ones were found that surely work" in said
        with pytest.raises(SolidError):
            shell(V, F, thickness / 10, side=side)
    else:
        assert 0 < float(advised[1]) < thickness
        shell(V, F, float(advised[1]), side=side)
