"""Make puzzles with a checkout, each in a process of its own, and write down what they are."""

import hashlib
import json
import os
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from importlib.util import find_spec
from pathlib import Path

from oracles.make import WRONG_CHECKOUT

COMMON = {"size": 150.0, "pieces": 40}
SETS = {
    "defaults": {},
    "tiles": {"layout": "tiles"},
    "stretch": {"layout": "tiles", "clearance_method": "stretch"},
    "random": {"random": 0.5},
    "unique": {"unique": True},
    "plates": {"plate": "220x220"},
    "labels": {"labels": True},
    "core": {"core": True},
}


def record(checkout: Path, file: Path, more: list[Path], only: list[str], sets: list[str], jobs: int) -> int:
    """Make every mesh with every set of options, and write the file anew after each puzzle."""
    bunny = Path(find_spec("pymeshlab").origin).parent / "tests/sample_meshes/bunny.obj"
    meshes = [*sorted((checkout / "data").glob("*.ply")), bunny, *(path.resolve() for path in more)]
    meshes = [path for path in meshes if not only or path.stem in only]
    if not meshes:
        print("no such meshes", file=sys.stderr)
        return 1
    asked = ["git", "-C", str(checkout), "describe", "--always", "--dirty", "--abbrev=12"]
    commit = subprocess.run(asked, capture_output=True, encoding="utf-8", check=False).stdout.strip()
    cases = [(mesh, name) for mesh in meshes for name in sets]
    puzzles = {}
    with ThreadPoolExecutor(jobs) as pool:
        made = pool.map(lambda case: _make(checkout, case[0], COMMON | SETS[case[1]]), cases)
        for (mesh, name), (puzzle, seconds) in zip(cases, made, strict=True):
            said = puzzle.get("failure") or f"{len(puzzle['pieces'])} pieces"
            print(f"{mesh.name:16} {name:9} {seconds:5.1f} s  {said}", flush=True)
            puzzles[f"{mesh.name} {name}"] = puzzle
            file.write_text(json.dumps({"commit": commit, "puzzles": puzzles}, indent=1), encoding="utf-8")
    return 0


def _make(checkout: Path, mesh: Path, options: dict) -> tuple[dict, float]:
    start = time.perf_counter()
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "made.json"
        script = Path(__file__).with_name("make.py")
        command = [sys.executable, script, checkout, mesh, json.dumps(options), out]
        # a variable of the environment, so that children of this child find the same meshjig
        environment = os.environ | {"PYTHONPATH": str(checkout)}
        done = subprocess.run(command, env=environment, capture_output=True, encoding="utf-8", check=False)
        made = json.loads(out.read_text(encoding="utf-8")) if out.is_file() else None
    if done.returncode == WRONG_CHECKOUT:
        raise SystemExit(f"another meshjig was imported than that of {checkout}")
    if made is None:
        made = {"failure": f"exit code {done.returncode}: {done.stderr.strip()[-600:]}"}
    return {"input": hashlib.sha256(mesh.read_bytes()).hexdigest(), **made}, time.perf_counter() - start
