"""What meshjig exports, as a user's code and a user's type checker meet it."""

import ast
import importlib
import os
import pkgutil
import subprocess
import sys
import typing
from pathlib import Path

import numpy as np
import pytest
from pydantic import BaseModel

import meshjig
from meshjig.options import OptionKeywords, Options
from meshjig.runtime.child import Child
from meshjig.runtime.worker import Background
from tests.meshes import sphere

ROOT = Path(meshjig.__file__).parent.parent

EXPORTED = set(
    [
        "Atlas",
        "BatchSettings",
        "ChartError",
        "CutError",
        "CutMesh",
        "InputError",
        "MappedAtlas",
        "Mesh",
        "MeshjigError",
        "OptionError",
        "Options",
        "Outlines",
        "OutputError",
        "Piece",
        "Puzzle",
        "ResourceError",
        "SolidError",
        "__version__",
        "atlas",
        "batch",
        "build_atlas",
        "cell_atlas",
        "check",
        "displacement",
        "get_family",
        "grow_cells",
        "kerf",
        "knob_outlines",
        "make_puzzle",
        "overlay",
        "read_scan",
        "repair",
        "shell",
        "solidify",
        "stitch",
        "tile_charts",
    ]
)

GOOD = """
import numpy as np
from numpy.typing import NDArray

import meshjig


def thickest(puzzle: meshjig.Puzzle) -> meshjig.Piece:
    return max(puzzle.pieces, key=lambda piece: float(np.ptp(piece.V[:, 2])))


def heard(stage: str, event: str) -> None:
    print(stage, event)


puzzle = meshjig.make_puzzle("scan.ply", size=150, pieces=100, layout="tiles", progress=heard)
reveal_type(puzzle)
options = meshjig.Options.of(faces="all", format="stl,ply", processes={"resin": {"clearance": 0.1}})
reveal_type(options.thickness)
reveal_type(meshjig.make_puzzle((np.eye(3), np.eye(3)), options=options).pieces[0])
name: str = thickest(puzzle).name
atlas = meshjig.atlas("scan.ply", charts="single")
reveal_type(atlas)
face, bary, xyz = atlas.lift(0, np.zeros((1, 2)))
lines: list[NDArray[np.float64]] = atlas.curve(0, np.zeros((2, 2)))
scan = meshjig.read_scan("scan.ply", faces=5000)
unit = meshjig.get_family("hex")
outlines, knobs = meshjig.tile_charts(meshjig.build_atlas(scan.mesh), 20.0, unit=unit)
cut = meshjig.overlay(atlas, outlines)
sheets = meshjig.shell(scan.mesh.V, scan.mesh.F, 2.0)
solids, facts = meshjig.kerf(cut.V, cut.F, cut.region, sheets.D, 0.2)
verdict = meshjig.check.judge(solids, clearance=0.2)
print(puzzle.save("out", formats=("stl",)).name, verdict.ok, meshjig.__version__, cut.region)
"""

REVEALED = ["Puzzle", "float", "Piece", "MappedAtlas"]

BAD = {
    'meshjig.make_puzzle("a", sise=150)': 'Unexpected keyword argument "sise"',
    'meshjig.make_puzzle("a", size="big")': 'Argument "size"',
    'meshjig.make_puzzle("a", layout="cell")': 'Argument "layout"',
    "meshjig.Options.of(clearence=1)": 'Unexpected keyword argument "clearence"',
    'meshjig.atlas("a", charts="lcsm")': 'Argument "charts"',
    'meshjig.atlas("a").lift(0)': 'Missing positional argument "uv"',
    'meshjig.read_scan("a", sizes=1)': 'Unexpected keyword argument "sizes"',
    "meshjig.Options().thicknes": 'has no attribute "thicknes"',
    'meshjig.make_puzzle("a").piece': 'has no attribute "piece"',
    "meshjig.make_puzle": 'has no attribute "make_puzle"',
}  # a line, and what must be said about it


def run(*words, cwd=None):
    environment = os.environ | {"PYTHONPATH": str(ROOT), "MYPYPATH": str(ROOT)}
    return subprocess.run(
        [sys.executable, *words], capture_output=True, encoding="utf-8", env=environment, cwd=cwd, check=False
    )


def test_the_exported_names_are_these():
    assert sorted(meshjig.__all__) == sorted(EXPORTED)
    assert set(dir(meshjig)) == set(EXPORTED)


def test_type_checkers_see_what_is_exported():
    tree = ast.parse((ROOT / "meshjig" / "__init__.pyi").read_text(encoding="utf-8"))
    seen = [alias.asname for node in tree.body if isinstance(node, ast.ImportFrom) for alias in node.names]
    seen += [node.target.id for node in tree.body if isinstance(node, ast.AnnAssign)]
    assert sorted(seen) == sorted(EXPORTED)
    homes = {
        alias.name: node.module
        for node in tree.body
        if isinstance(node, ast.ImportFrom)
        for alias in node.names
    }
    for name in set(EXPORTED) - {"__version__", "check"}:
        assert getattr(importlib.import_module(homes[name]), name) is getattr(meshjig, name)


def test_names_stay_what_they_are_once_everything_is_imported():
    modules = sorted(m.name for m in pkgutil.walk_packages(meshjig.__path__, "meshjig."))
    said = run(
        "-c",
        "import importlib, inspect, meshjig\n"
        "before = {name: getattr(meshjig, name) for name in meshjig.__all__}\n"
        f"for module in {modules!r}:\n"
        "    if not module.endswith('__main__'): importlib.import_module(module)\n"
        "for name, value in before.items():\n"
        "    assert getattr(meshjig, name) == value, name\n"
        "    assert inspect.ismodule(value) == (name == 'check'), name\n"
        "    assert callable(value) or name in ('check', '__version__'), name\n",
    )
    assert said.returncode == 0, said.stderr


def test_a_fresh_import_loads_nothing_heavy():
    said = run(
        "-c", "import sys, meshjig; print(sorted({'numpy', 'scipy', 'igl', 'pydantic'} & set(sys.modules)))"
    )
    assert said.stdout.strip() == "[]"


def test_keywords_for_type_checkers_are_the_fields_of_options():
    hints = typing.get_type_hints(OptionKeywords)
    assert set(hints) - {"processes"} == set(Options.model_fields)
    for name, field in Options.model_fields.items():
        if name != "format":  # a string, too, is taken apart
            assert plain(hints[name]) == plain(field.annotation) | {type(None)}, name


def plain(annotation):
    """Take a union apart, without what pydantic checks beyond types."""
    if typing.get_origin(annotation) is typing.Annotated:
        return plain(typing.get_args(annotation)[0])
    if typing.get_origin(annotation) is typing.Literal:
        return {typing.Literal[value] for value in typing.get_args(annotation)}
    parts = typing.get_args(annotation)
    return set().union(*map(plain, parts)) if parts else {annotation}


def test_options_are_a_model_whose_fields_are_known():
    assert issubclass(meshjig.Options, BaseModel)
    assert meshjig.Options.of(size=150).size == 150


@pytest.mark.slow
def test_a_users_script_is_typed_throughout(tmp_path):
    (tmp_path / "good.py").write_text(GOOD, encoding="utf-8")
    (tmp_path / "bad.py").write_text("\n".join(["import meshjig", *BAD]) + "\n", encoding="utf-8")
    said = run("-m", "mypy", "--strict", "--follow-imports=silent", "good.py", "bad.py", cwd=tmp_path)
    lines = said.stdout.splitlines()
    good = [line for line in lines if line.startswith("good.py")]
    assert [line.split('"')[1].rsplit(".")[-1] for line in good] == REVEALED, good
    for number, says in enumerate(BAD.values(), 2):
        assert any(line.startswith(f"bad.py:{number}: error:") and says in line for line in lines), (
            says,
            lines,
        )
    assert len(GOOD.strip().splitlines()) >= 30


def test_a_puzzle_says_what_it_is_in_a_line_and_can_be_compared():
    one, other = (meshjig.make_puzzle(sphere(600), pieces=6, faces=600, seed=seed) for seed in (0, 1))
    assert repr(one) == f"<Puzzle of a mesh, 99 x 99 x 99 mm: {len(one.pieces)} pieces, promises kept>"
    assert "\n" not in repr(one.pieces[0])
    assert one == one
    assert one != other
    assert one != "puzzle"
    assert one.pieces[0] != one.pieces[1]
    first = one.pieces[0]
    again = meshjig.Piece(first.name, first.V.copy(), first.F.copy(), (0, 0, 0), first.id)
    assert again == first
    assert meshjig.Puzzle([again, *one.pieces[1:]], {}) == one
    moved = meshjig.Piece(first.name, first.V + np.spacing(first.V), first.F, first.colour, first.id)
    assert moved != first


def test_a_run_leaves_no_warning_behind():
    made = f"p = meshjig.make_puzzle({str(ROOT / 'data' / 'duck.ply')!r}, pieces=8, faces=2000)"
    said = run("-X", "dev", "-W", "error", "-c", f"import meshjig\n{made}\nprint(len(p.pieces))")
    assert (said.returncode, said.stderr) == (0, "")
    assert int(said.stdout) >= 8


def test_children_still_at_work_are_ended_with_the_program():
    said = run(
        "-X", "dev", "-W", "error", "-c",
        "import time\nfrom meshjig.runtime.worker import Background\n"
        "task = Background(time.sleep, 60)\nprint(task._child.process.pid)\n"
        "assert task._child.alive()",
    )  # fmt: skip
    assert (said.returncode, said.stderr) == (0, "")
    with pytest.raises(ProcessLookupError):
        os.kill(int(said.stdout), 0)


def test_an_ended_child_is_forgotten():
    from meshjig.runtime import child

    made = Child()
    assert made in child._running
    made.end()
    assert made not in child._running
    assert Background(len, [], alone=True).result() == 0
