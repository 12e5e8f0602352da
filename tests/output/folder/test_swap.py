"""A folder is replaced while signals come before and after every call of the system."""

import json
import os
import subprocess
import sys
from collections import Counter
from pathlib import Path

import pytest

SCRIPT = Path(__file__).with_name("interrupted.py")
needs_fork = pytest.mark.skipif(not hasattr(os, "fork"), reason="no processes are forked here")


def cases(folder, how):
    said = subprocess.run(
        [sys.executable, SCRIPT, folder, how], capture_output=True, encoding="utf-8", check=True
    )
    assert said.stderr == ""
    return [json.loads(line) for line in said.stdout.splitlines()]


@needs_fork
@pytest.mark.skipif(sys.platform != "linux", reason="the exchange is tried on Linux")
def test_the_old_or_the_new_folder_is_whole_in_its_place_whatever_comes_when(tmp_path):
    found = cases(tmp_path, "with")
    assert len(found) > 60
    places = Counter((name, place) for name, _, place, *_ in found)
    assert all(
        places[name, version] > 5 for name in ("SIGKILL", "SIGTERM", "SIGINT") for version in ("old", "new")
    )
    assert {place for _, _, place, *_ in found} == {"old", "new"}
    assert all(said in (None, place) for _, _, place, said, *_ in found)  # what is said of it is true


@needs_fork
@pytest.mark.parametrize("how", ["with", "without"])
def test_the_next_run_leaves_nothing_behind(tmp_path, how):
    """Without the exchange, a kill -9 between two renames leaves the place empty; the next run mends that."""
    found = cases(tmp_path, how)
    assert all(after == "next" and left == ["out"] for *_, after, left in found)
    assert {place for name, _, place, *_ in found if name != "SIGKILL"} == {"old", "new"}
