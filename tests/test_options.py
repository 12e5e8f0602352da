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
    fdm = PROCESSES["fdm"]
    assert (options.thickness, options.min_neck, options.give) == (fdm["thickness"], fdm["min_neck"], 0.05)
    assert Options.of(process="resin-x", processes=OWN, clearance=0.3).clearance == 0.3


@pytest.mark.parametrize(("process", "give"), [("fdm", 0.05), ("sla", 0), ("polyjet", 0), ("foam", 1)])
def test_only_what_is_soft_gives(process, give):
    assert Options.of(process=process).give == give
    assert Options.of(process=process, give=0.3).give == 0.3


def test_an_unknown_process_names_those_that_are_known():
    with pytest.raises(OptionError, match=r"^process: 'knitting'.*fdm, sla, polyjet, foam, resin-x$"):
        Options.of(process="knitting", processes=OWN)


@pytest.mark.parametrize("processes", [{"x": {"colour": 3}}, {"x": 3}, ["x"]])
def test_a_process_has_five_figures_only(processes):
    with pytest.raises(OptionError, match=r"^processes: .*min_neck, min_wall, give"):
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
    with pytest.raises(OptionError, match=f"^{name}: this is for the layout of .*leave out one"):
        Options.of(**given)


def test_an_option_of_tiles_asks_for_them():
    assert Options.of(pole="wedge").layout == "tiles"
    assert Options.of(angle=10.0).layout == "tiles"
    assert Options.of().layout == "cells"


@pytest.mark.parametrize(
    ("given", "sentence"),
    [
        ({"sise": 150}, "sise: there is no such option: did you mean size?"),
        ({"min_pieces": 1}, "min-pieces: there is no such option: did you mean min-piece?"),
        ({"zzz": 1}, "zzz: there is no such option: meshjig make --help lists them"),
        ({"options": {"size": 3}}, "options: there is no such option: options stand in no table"),
        ({"pieces": "many"}, "pieces: 'many' is no whole number"),
        ({"pieces": 1.5}, "pieces: 1.5 is no whole number"),
        ({"pieces": "1,000"}, "pieces: '1,000' is no whole number: write 1000"),
        ({"pieces": 0}, "pieces: 0 is too small: give at least 1"),
        ({"pieces": 10**6}, "pieces: 1000000 is too large: give at most 100000"),
        ({"pieces": True}, "pieces: true is no value for it: give another, or leave it out"),
        ({"size": "15cm"}, "size: '15cm' is no number: lengths are in mm, so write 150"),
        ({"size": "1,5"}, "size: '1,5' is no number: write 1.5"),
        ({"min_piece": "25%"}, "min-piece: '25%' is no number: write 0.25"),
        ({"size": [1]}, "size: a list is no number"),
        ({"size": float("inf")}, "size: inf is too large, or no number"),
        ({"size": 1e300}, "size: 1e+300 is too large: give at most 100000"),
        ({"clearance": 1e300}, "clearance: 1e+300 is too large: give at most 100000"),
        ({"piece_size": 1e300}, "piece-size: 1e+300 is too large: give at most 100000"),
        (
            {"seed": 10**80},
            "seed: a number of too many digits is too large: give at most 9223372036854775807",
        ),
        ({"thickness": 0}, "thickness: 0 is too small: give more than 0"),
        ({"join": "mitre"}, "join: 'mitre' is none of miter, round: did you mean miter?"),
        ({"faces": "al"}, "faces: 'al' is neither a whole number nor all: did you mean all?"),
        ({"faces": "50k"}, "faces: '50k' is neither a whole number nor all: write 50000"),
        ({"memory": "4GB"}, "memory: '4GB' is no number: write 4"),
        (
            {"keep": "larges"},
            "keep: 'larges' is neither a whole number nor largest nor all: did you mean largest?",
        ),
        ({"angle": "45deg"}, "angle: '45deg' is no number: write 45"),
        ({"faces": 7}, "faces: 7 is too small: give at least 100, or 'all'"),
        ({"format": "stl,3fm"}, "format: '3fm' is none of stl, ply, 3mf, obj, glb: did you mean 3mf?"),
        ({"format": ","}, "format: at least one is needed: known are stl, ply, 3mf, obj, glb"),
        ({"labels": "perhaps"}, "labels: 'perhaps' is neither true nor false"),
        ({"plate": 220}, "plate: 220 is no text: put it in quotes"),
        (
            {"process": "fmd"},
            "process: 'fmd' is not known; known are fdm, sla, polyjet, foam: did you mean fdm?",
        ),
    ],
)
def test_a_sentence_says_what_is_wrong_and_what_to_write(given, sentence):
    with pytest.raises(OptionError) as error:
        Options.of(**given)
    assert str(error.value) == sentence


def test_pieces_and_their_size_can_not_both_be_given(tmp_path):
    with pytest.raises(OptionError, match=r"^pieces: piece-size is given as well.*give one of them"):
        Options.of(pieces=24, piece_size=60)
    (tmp_path / "shop.toml").write_text("pieces = 24\n")
    options = read_options(tmp_path / "shop.toml", {"piece_size": "60"})
    assert (options.piece_size, options.pieces) == (60, 100)
    (tmp_path / "shop.toml").write_text("piece-size = 60\n")
    assert read_options(tmp_path / "shop.toml", {"pieces": "24"}).piece_size is None


def test_a_floor_is_cut_off_in_one_way_only():
    assert Options.of(flat_base="auto").flat_base == "auto"
    assert Options(flat_base=True).flat_base == "auto"
    assert Options(flat_base=False).flat_base is None
    assert Options.of(flat_base=3).flat_base == 3.0
    with pytest.raises(OptionError, match=r"drop-below .*give one of them"):
        Options.of(flat_base=3.0, drop_below=2.0)
