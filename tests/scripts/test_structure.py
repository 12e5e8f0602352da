import re
import subprocess
import sys
from pathlib import Path

import pytest

SCRIPT = Path(__file__).parents[2] / "scripts/structure.py"

FILES = {
    "__init__.py": "",
    "__main__.py": "import made.top",
    "top.py": """
from typing import TYPE_CHECKING
from made.room import a
from made.room.inner.c import walk
if TYPE_CHECKING:
    from made.mesh import words
""",
    "room/__init__.py": "",
    "room/a.py": """
import numpy as np
from scipy.sparse.csgraph import connected_components as label
from made.room.b import long
def found(graph, n):
    return label(graph), np.cumsum(n) - n
""",
    "room/b.py": """
def long(self, a, b, c, d, e, f, *, g) -> tuple[int, int, int, int] | None:
    from .a import found
    from ..mesh.words import allowed
""",
    "room/inner/c.py": """
from made.room import a
def walk(after, at):
    while at >= 0:
        at = after[at]
def no_walk(values, at):
    while at >= 0:
        at = min(values[at], at - 1)
""",
    "mesh/words.py": """
def allowed(graph, after, at, n):
    while at:
        at = after.pop(at)
    return connected_components(graph), n.cumsum() - n
""",
}


@pytest.fixture
def package(tmp_path):
    for name, text in FILES.items():
        path = tmp_path / "made" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return tmp_path / "made"


def run(package, *flags):
    command = [sys.executable, SCRIPT, "--package", package, *flags]
    return subprocess.run(command, capture_output=True, encoding="utf-8", check=False)


def counted(package):
    """Give what was counted for each figure."""
    found, name = {}, ""
    for line in run(package, "--where").stdout.splitlines():
        if line.startswith(" " * 12):
            found[name].append(line.strip())
        else:
            name = re.fullmatch(r" *\d+  (.*?)(, at most \d+)?", line)[1]
            found[name] = []
    return found


def test_rooms_and_arrows_are_counted_at_the_top_and_inside_folders(package):
    found = counted(package)
    assert found["rooms"] == ["mesh", "room", "top"]
    assert found["rooms, folders inside folders too"] == ["mesh", "room", "room/inner", "top"]
    assert found["arrows"] == ["room -> mesh 1", "top -> room 2"]
    assert len(found["arrows, folders inside folders too"]) == 4
    assert found["modules at the top"] == ["top"]


def test_imports_in_functions_close_a_circle_and_those_for_type_checkers_do_not(package):
    assert counted(package)["circles of files"] == ["room/a.py, room/b.py"]


def test_signatures_are_counted_without_self_and_optional_tuples_count(package):
    found = counted(package)
    assert found["functions with 7 parameters or more"] == ["room/b.py:2 long 7"]
    assert found["functions that return more than 3 unnamed values"] == ["room/b.py:2 long 4"]


def test_words_of_mesh_are_found_under_another_name_and_are_free_in_mesh(package):
    found = counted(package)
    assert found["connected_components outside mesh"] == ["room/a.py:6"]
    assert found["ragged ranges outside mesh"] == ["room/a.py:6"]
    assert found["border walks outside mesh"] == ["room/inner/c.py:4 walk"]


def test_check_names_the_limits_that_are_broken_only(package):
    done = run(package, "--check")
    assert done.returncode == 1
    assert "     1  circles of files, at most 0\n" in done.stdout
    assert "rooms" not in done.stdout


def test_check_passes_a_package_within_all_limits(tmp_path):
    (tmp_path / "made").mkdir()
    (tmp_path / "made/__init__.py").write_text("")
    done = run(tmp_path / "made", "--check")
    assert (done.returncode, done.stdout) == (0, "")
