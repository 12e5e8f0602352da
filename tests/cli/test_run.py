"""Whatever goes wrong ends in one sentence, one object and an exit code that tells what kind it was."""

import json

import pytest
import typer

from meshjig.cli import commands
from meshjig.cli.run import exit_code
from meshjig.errors import ChartError, InputError, MeshjigError, OptionError, OutputError, ResourceError


@pytest.fixture
def ended(capsys, monkeypatch):
    """Run a command line in this process; give its exit code, its sentence and its object."""
    monkeypatch.setattr(commands, "set_verbosity", lambda *given, **more: None)

    def run(*words):
        code = exit_code([*map(str, words), "--json"])
        said = capsys.readouterr()
        assert len(said.err.splitlines()) == 1, said.err
        return code, said.err.strip(), json.loads(said.out)

    return run


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["make"], "make needs a MESH, such as meshjig make scan.stl"),
        (["make", "a.stl", "b.stl"], "a word too many for meshjig make, 'b.stl': put names that have spaces"),
        (["make", "a.stl", "--peices", "3"], "there is no option --peices: did you mean --pieces?"),
        (["make", "a.stl", "--no-veiwer"], "there is no option --no-veiwer: did you mean --no-viewer?"),
        (["make", "a.stl", "--zzz"], "there is no option --zzz: meshjig make --help lists"),
        (["make", "a.stl", "--pieces", "abc"], "--pieces: 'abc' is no whole number"),
        (["make", "a.stl", "--dry-run=3"], "--dry-run takes no value"),
        (["make", "a.stl", "--pieces", "5", "--piece-size", "9"], "--pieces: piece-size is given as well"),
        (["make", "a.stl", "-o", ""], "--output: the name is empty"),
        (["make", "a.stl", "-o"], "--output needs a folder, and --json follows"),
        (["make", ""], "the name of the mesh is empty"),
        (["make", "a.stl", "--out", "b"], "there is no option --out: did you mean --output?"),
        (["make", "a.stl", "--silent"], "there is no option --silent: meshjig make --help lists"),
        (["make", "a.stl", "--config", "none.toml"], "--config: none.toml does not exist: check the name"),
        (
            ["make", "a.stl", "--plate", "prusa-mk5"],
            "--plate: 'prusa-mk5' is not known: did you mean prusa-mk4?",
        ),
        (["mak", "a.stl"], "there is no command mak: did you mean make?"),
        (["scan.STL"], "there is no command scan.STL: did you mean meshjig make scan.STL?"),
        (["tiles", "hexx"], "there is no tiling 'hexx': did you mean hex?"),
        (["tiles", "--seed", "x"], "--seed: 'x' is no whole number"),
        (["info", "a.stl", "--method", "lcsm"], "--method: 'lcsm' is none of"),
        (["check", "a", "--clearance", "-1"], "--clearance: '-1' is too small: give at least 0"),
        ([], "there is no option --json: meshjig --help lists"),
    ],
)
def test_wrong_usage_is_told_in_one_sentence_and_one_object(ended, words, sentence):
    code, said, told = ended(*words)
    assert code == told["exit"] == 2
    assert sentence in said
    assert told["ok"] is False
    error = told["error"]
    assert (error["kind"], error["stage"]) == ("usage", "options")
    assert said == f"meshjig: {error['message']}" + (f": {error['hint']}" if error["hint"] else "")


def test_an_option_at_the_end_needs_its_value(capsys):
    assert exit_code(["make", "a.stl", "--json", "--pieces"]) == 2
    said = capsys.readouterr()
    assert said.err == "meshjig: --pieces needs a value: see meshjig make --help\n"
    assert json.loads(said.out)["error"]["kind"] == "usage"


@pytest.mark.parametrize(
    ("error", "code", "kind"),
    [
        (InputError("bad", hint="mend it"), 4, "input"),
        (OptionError("bad"), 2, "usage"),
        (ChartError("bad"), 1, "chart"),
        (OutputError("bad"), 1, "output"),
        (ResourceError("bad"), 5, "resources"),
        (MeshjigError("bad"), 1, "failure"),
        (MemoryError(), 5, "resources"),
        (KeyError("x"), 70, "bug"),
        (KeyboardInterrupt(), 130, "interrupted"),
    ],
)
def test_the_exit_code_tells_the_kind(ended, monkeypatch, error, code, kind):
    def fail(*given):
        raise error

    monkeypatch.setattr(commands, "read_options", fail)
    found, said, told = ended("tiles", "hex")
    assert (found, told["exit"], told["error"]["kind"]) == (code, code, kind)
    assert said.startswith("meshjig: ")
    assert "Traceback" not in said


def test_without_json_nothing_is_printed(capsys):
    assert exit_code(["mak"]) == 2
    assert exit_code(["make", "--", "--json", "b"]) == 2  # a file of that name
    assert capsys.readouterr().out == ""


def test_help_tells_exit_codes_choices_and_defaults(capsys):
    assert exit_code(["--help"]) == 0
    said = capsys.readouterr().out
    assert "70 a bug" in said
    assert '"kind", "message"' in said
    assert exit_code(["make", "-h"]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "<bool>" not in said
    for shown in (
        "--dry-run only say",
        "--join miter|round",
        "(default: miter)",
        "--faces N|all",
        "--thickness MM",
        "(default: fdm 2, sla 2, polyjet 2.5, foam 7)",
        "--format stl,ply,3mf,obj,glb",
        "(default: stl,3mf)",
        "--piece-size MM",
        "--viewer / --no-viewer write viewer.html (default: on)",
    ):
        assert shown in said, shown


def test_broken_promises_are_in_the_report_that_is_printed(capsys):
    report = {"ok": False, "pieces": [], "failures": {"gap_mm": ["piece_001", "piece_002"]}}
    with pytest.raises(typer.Exit) as ending:
        commands._answer(report, report["failures"])
    said = capsys.readouterr()
    told = json.loads(said.out)
    assert ending.value.exit_code == told["exit"] == 3
    assert {**report, "error": told["error"], "exit": 3} == told
    assert told["error"]["kind"] == "promise"
    assert said.err == "meshjig: broken promise: gap_mm (piece_001, piece_002)\n"
