"""What a file does to meshjig, by the real command or in this process, and whether that is right."""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
import time
import traceback
from dataclasses import dataclass
from pathlib import Path

import psutil

__all__ = ["Answer", "by_command", "faults", "in_process"]

LONGEST, LARGEST = 60.0, 2e9  # s, and bytes of the process tree
KEPT = 0.9  # of the unhurt file's faces
KNOWN_CODES = {0, 1, 2, 3, 4, 5}
_EVERY = 0.03  # s between two looks at the memory


@dataclass(frozen=True)
class Answer:
    """What came of one file."""

    code: int
    said: str  # on standard error
    faces: int | None = None  # that are left; None where there is no mesh
    notes: tuple[str, ...] = ()
    seconds: float = 0.0
    memory: float = 0.0  # bytes


def by_command(kind: str, path: Path, mesh: Path) -> Answer:
    """Ask the command line in a process of its own.

    Parameters
    ----------
    kind : str
    path : Path
    mesh : Path, a sound one, for what is no mesh
    """
    words = {
        "svg": ["make", str(mesh), "--dry-run", "--json", "--tile", str(path)],
        "toml": ["make", str(mesh), "--dry-run", "--json", "--config", str(path)],
    }.get(kind, ["info", str(path), "--json"])
    began, most = time.monotonic(), 0.0
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
        run = subprocess.Popen([sys.executable, "-m", "meshjig", *words], stdout=out, stderr=err)
        while run.poll() is None and time.monotonic() - began < LONGEST:
            most = max(most, _resident(run.pid))
            time.sleep(_EVERY)
        seconds = time.monotonic() - began
        run.kill()
        run.wait()
        out.seek(0), err.seek(0)
        printed, said = out.read(), err.read().decode("utf-8", "replace")
    faces, notes = None, ()
    if run.returncode == 0 and kind not in ("svg", "toml"):
        facts = json.loads(printed)
        faces, notes = facts["faces"], tuple(facts["notes"])
    return Answer(run.returncode, said, faces, notes, seconds, most)


def in_process(kind: str, path: Path) -> Answer:
    """Ask the library; any error but a MeshjigError is a fault."""
    from meshjig.cli.config import parse_toml
    from meshjig.errors import MeshjigError
    from meshjig.scan import describe
    from meshjig.tiling.registry import get_family

    began = time.monotonic()
    faces, notes, code, said = None, (), 0, ""
    try:
        if kind == "toml":
            parse_toml(str(path))
        elif kind == "svg":
            get_family(str(path), 0)
        else:
            facts = describe(path)
            faces, notes = facts.faces, tuple(facts.notes)
    except MeshjigError as error:
        code, said = 1, f"meshjig: {error}"
    except Exception:
        code, said = 70, traceback.format_exc()
    return Answer(code, said, faces, notes, time.monotonic() - began)


def faults(answer: Answer, unhurt: Answer, names: list[str]) -> list[str]:
    """List what is wrong with an answer."""
    found = []
    if answer.code not in KNOWN_CODES:
        found.append(f"exit code {answer.code}")
    if "Traceback" in answer.said or "this is a bug" in answer.said:
        found.append("traceback")
    if answer.seconds >= LONGEST:
        found.append(f"took {answer.seconds:.0f} s")
    if answer.memory > LARGEST:
        found.append(f"took {answer.memory / 1e9:.1f} GB")
    if answer.code and len([x for x in answer.said.splitlines() if x.startswith("meshjig:")]) != 1:
        found.append("not one sentence")
    if unhurt.faces and answer.faces is not None and answer.faces < KEPT * unhurt.faces and not answer.notes:
        found.append(f"{answer.faces} of {unhurt.faces} faces without a word")
    if answer.code and all(name.startswith("as_") for name in names):
        found.append("refused, though nothing is wrong")
    return found


def _resident(pid: int) -> float:
    """The memory of a process and all that it started, bytes."""
    try:
        process = psutil.Process(pid)
        return float(sum(one.memory_info().rss for one in [process, *process.children(recursive=True)]))
    except psutil.Error:
        return 0.0
