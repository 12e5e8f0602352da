"""One model of options for keywords, flags and TOML keys."""

import inspect

import pytest

from meshjig.cli.commands import make
from meshjig.cli.config import read_options
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
    own = {"mesh", "output", "config", "dry_run", "debug_dir", "as_json", "verbose", "quiet"}
    assert flags - set(Options.model_fields) == own


OWN = {"resin-x": {"clearance": 0.12, "min-wall": 0.6}}


def test_a_process_of_ones_own_sets_what_it_has_and_fdm_the_rest():
    options = Options.of(process="resin-x", processes=OWN)
    assert (options.process, options.clearance, options.min_wall) == ("resin-x", 0.12, 0.6)
    assert (options.thickness, options.min_neck) == (
        PROCESSES["fdm"]["thickness"],
        PROCESSES["fdm"]["min_neck"],
    )
    assert Options.of(process="resin-x", processes=OWN, clearance=0.3).clearance == 0.3


def test_an_unknown_process_names_those_that_are_known():
    with pytest.raises(OptionError, match=r"^process: 'knitting'.*fdm, sla, polyjet, foam, resin-x$"):
        Options.of(process="knitting", processes=OWN)


@pytest.mark.parametrize("processes", [{"x": {"colour": 3}}, {"x": 3}, ["x"]])
def test_a_process_has_four_figures_only(processes):
    with pytest.raises(OptionError, match=r"^processes: .*min_neck, min_wall"):
        Options.of(processes=processes)


def test_a_figure_of_a_process_is_checked_like_any_other():
    with pytest.raises(OptionError, match=r"^clearance: "):
        Options.of(process="x", processes={"x": {"clearance": -1}})


@pytest.mark.parametrize("process", [["fdm"], {"fdm": {}}, 3])
def test_a_process_is_named_by_a_word(process):
    with pytest.raises(OptionError, match=r"^process: "):
        Options.of(process=process)


@pytest.mark.parametrize(
    ("toml", "flags"),
    [
        ('process = "resin-x"\n[processes.resin-x]\nclearance = 0.12\nmin-wall = 0.6\n', {}),
        ("[process.resin-x]\nclearance = 0.12\nmin_wall = 0.6\n", {"process": "resin-x"}),
    ],
)
def test_a_config_file_holds_processes(toml, flags, tmp_path):
    (tmp_path / "shop.toml").write_text(toml)
    options = read_options(tmp_path / "shop.toml", flags)
    assert (options.process, options.clearance, options.min_wall) == ("resin-x", 0.12, 0.6)


@pytest.mark.parametrize(
    ("given", "name"),
    [
        ({"layout": "cells", "tile": "hex"}, "tile"),
        ({"layout": "cells", "pole": "wedge"}, "pole"),
        ({"layout": "tiles", "style": "quad"}, "style"),
        ({"charts": "lscm", "crease_aware": True}, "crease-aware"),
    ],
)
def test_what_the_layout_has_not_is_refused(given, name):
    with pytest.raises(OptionError, match=f"^{name}: the layout of"):
        Options.of(**given)


def test_an_option_of_tiles_asks_for_them():
    assert Options.of(pole="wedge").layout == "tiles"
    assert Options.of(angle=10.0).layout == "tiles"
    assert Options.of().layout == "cells"
