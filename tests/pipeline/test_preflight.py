"""What is refused beforehand comes with advice that holds when it is followed."""

import re

import numpy as np
import pytest

import meshjig
from meshjig.errors import OptionError
from meshjig.mesh.types import Mesh
from meshjig.options import Options
from meshjig.pipeline.preflight import refuse_hollow_piece, refuse_too_small_pieces
from tests.meshes import sphere


def advice(size, area, **asked):
    """Give what is said about pieces of one size, or nothing where they are let through."""
    try:
        refuse_too_small_pieces(size, area, Options.of(**asked))
    except OptionError as error:
        return error.hint
    return ""


@pytest.mark.parametrize("layout", ["cells", "tiles"])
@pytest.mark.parametrize("size", [3.1, 9.7, 14.14, 20.05, 33.3, 47.77])
def test_a_clearance_that_is_advised_is_taken(layout, size):
    said = advice(size, 1e5, layout=layout, clearance=10.0)
    most = re.search(r"a clearance of at most ([0-9.]+) mm", said)
    assert most is not None, said
    assert not advice(size, 1e5, layout=layout, clearance=float(most[1]))
    assert advice(size, 1e5, layout=layout, clearance=1.3 * float(most[1]) + 0.02)


@pytest.mark.parametrize("clearance", [0.2, 0.37, 0.777, 2.3])
def test_a_number_or_a_size_of_pieces_that_is_advised_is_taken(clearance):
    area = 2e4
    said = advice(0.5, area, clearance=clearance, piece_size=0.5)
    least = re.search(r"pieces of at least ([0-9.]+) mm", said)
    assert not advice(float(least[1]), area, clearance=clearance, piece_size=float(least[1]))
    most = re.search(r"at most ([0-9]+) pieces", advice(0.5, area, clearance=clearance))
    assert not advice(np.sqrt(area / int(most[1])), area, clearance=clearance)


def test_nothing_is_advised_that_is_nothing():
    for said in (advice(0.3, 1e4), advice(0.1, 1.0), advice(0.1, 0.01, clearance=5.0)):
        assert said
        assert "at most 0" not in said
    assert advice(0.1, 0.01, clearance=5.0) == "use a larger --size"


@pytest.mark.parametrize(("least", "advised"), [(1.0, "a smaller --min-piece than 1"), (0.25, "more pieces")])
def test_a_single_hollow_piece_is_refused_with_what_made_it_one(least, advised):
    mesh = Mesh(*sphere(300))
    with pytest.raises(OptionError, match="a single hollow piece") as error:
        refuse_hollow_piece(mesh, np.zeros(len(mesh.F), np.int64), Options.of(min_piece=least))
    assert advised in error.value.hint


@pytest.mark.parametrize("call", [meshjig.make_puzzle, meshjig.atlas])
@pytest.mark.parametrize("options", [{}, {"pieces": 30}, "sla"])
def test_options_of_another_type_are_refused(call, options):
    with pytest.raises(OptionError, match=r"^options: a (dict|str) is no Options: make them with"):
        call(tuple(sphere(100)), options=options)
