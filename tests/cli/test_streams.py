"""Standard output holds the answer and nothing else, whatever libraries print."""

import json
import os
import subprocess
import sys

import pytest

NOISY = """
import os, sys, warnings
from meshjig.tiling.families.regular import hexagons

def noisy(seed, columns):
    print("hello")
    print("hello", file=sys.stderr)
    os.write(1, b"native hello\\n")
    os.write(2, b"native hello\\n")
    warnings.warn("hello", RuntimeWarning)
    return hexagons()

def leaves(seed, columns):
    os._exit(9)
"""


@pytest.fixture(scope="module")
def tiles(tmp_path_factory):
    """Run `meshjig tiles` where another package brings tilings."""
    folder = tmp_path_factory.mktemp("packages")
    (folder / "noisy_tilings.py").write_text(NOISY)
    info = folder / "noisy_tilings-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: noisy-tilings\nVersion: 1.0\n")
    points = "[meshjig.tilings]\nnoisy = noisy_tilings:noisy\nleaves = noisy_tilings:leaves\n"
    (info / "entry_points.txt").write_text(points)
    path = os.pathsep.join([str(folder), *filter(None, [os.environ.get("PYTHONPATH")])])

    def run(*words):
        return subprocess.run(
            [sys.executable, "-m", "meshjig", "tiles", *words],
            capture_output=True,
            encoding="utf-8",
            env=os.environ | {"PYTHONPATH": path},
            check=False,
        )

    return run


def test_what_libraries_print_goes_nowhere(tiles):
    said = tiles("noisy", "--json")
    assert (said.returncode, said.stderr) == (0, "")
    assert set(json.loads(said.stdout)) == {"tiles", "edges", "knobs"}
    assert "hello" in tiles("noisy", "--verbose").stderr


def test_a_library_that_ends_the_process_is_told(tiles):
    said = tiles("leaves", "--json")
    told = json.loads(said.stdout)
    assert said.returncode == told["exit"] == 70
    assert told["error"]["kind"] == "bug"
    assert len(said.stderr.splitlines()) == 1
