"""Make a puzzle in a process of its own, and see what that takes."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from pathlib import Path
from typing import Any, NamedTuple

__all__ = ["Run", "make"]

_MAKE = """
import json, sys
import meshjig
try:
    puzzle = meshjig.make_puzzle(sys.argv[1], **json.loads(sys.argv[3]))
except meshjig.MeshjigError as error:
    sys.exit(str(error))
puzzle.save(sys.argv[2], formats=("stl",), preview=False, viewer=False, guide=False)
"""


class Run(NamedTuple):
    """What came of a puzzle, and what it took."""

    said: str  # why there is none, else empty
    wall: float  # s, imports and files with it
    cpu: float  # s, of all processes


def make(mesh: Path, folder: Path, options: dict[str, Any]) -> Run:
    """Make a puzzle and save it as STL files without pictures."""
    command = [sys.executable, "-c", _MAKE, str(mesh), str(folder), json.dumps(options)]
    start = time.perf_counter()
    process = subprocess.Popen(command, stderr=subprocess.PIPE, encoding="utf-8")
    assert process.stderr is not None
    said = process.stderr.read().strip()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    wall = time.perf_counter() - start
    process.stderr.close()
    why = said.splitlines()[-1] if said else f"ended with {process.returncode}"
    return Run(why if process.returncode else "", wall, usage.ru_utime + usage.ru_stime)
