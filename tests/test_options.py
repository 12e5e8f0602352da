"""One model of options for keywords, flags and TOML keys."""

import inspect

import pytest

from meshjig.cli import make
from meshjig.errors import OptionError
from meshjig.options import PROCESSES, Options


@pytest.mark.parametrize("process", sorted(PROCESSES))
def test_a_process_sets_what_is_not_given(process):
    options = Options.of(process=process)
    assert {name: getattr(options, name) for name in PROCESSES[process]} == PROCESSES[process]


def test_an_explicit_value_wins_over_the_process():
    options = Options.of(process="sla", clearance=0.33)
    assert options.clearance == 0.33
    assert options.thickness == PROCESSES["sla"]["thickness"]


@pytest.mark.parametrize(
    ("given", "named"),
    [
        ({"pieces": 0}, "pieces"),
        ({"thickness": -1}, "thickness"),
        ({"faces": "some"}, "faces"),
        ({"faces": 3}, "faces"),
        ({"tile": "round"}, "tile"),
        ({"process": "knitting"}, "process"),
        ({"format": "stl,dwg"}, "format"),
        ({"format": ""}, "format"),
        ({"colour": "red"}, "colour"),
        ({"size": float("nan")}, "size"),
        ({"clearance": float("inf")}, "clearance"),
    ],
)
def test_what_is_wrong_is_named(given, named):
    with pytest.raises(OptionError, match=f"^{named}: "):
        Options.of(**given)


def test_formats_are_a_list_with_commas():
    assert Options.of(format="stl, glb").format == ("stl", "glb")


def test_every_option_is_a_flag():
    flags = set(inspect.signature(make).parameters)
    assert set(Options.model_fields) <= flags
    assert flags - set(Options.model_fields) == {"mesh", "output", "config", "as_json", "verbose", "quiet"}
