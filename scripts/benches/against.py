"""Two checkouts of meshjig, in turn: seconds, processor seconds and memory of one puzzle."""

import os
import statistics
import subprocess
import sys
import tarfile
import tempfile
import time
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).parent.parent.parent

# the checkout comes first, so that an installed meshjig does not stand in for it
_MAKE = """
import sys
sys.path.insert(0, sys.argv[1])
import meshjig
assert meshjig.__file__.startswith(sys.argv[1]), meshjig.__file__
meshjig.make_puzzle(sys.argv[2], size=150.0, pieces=int(sys.argv[4])).save(sys.argv[3])
"""


class Cost(NamedTuple):
    """What one run took."""

    wall: float  # s
    cpu: float  # s, of all processes that it started, too
    memory: float  # MB, of the largest of them


UNITS = ("s", "s of processors", "MB")


def run(reference: str, meshes: list[Path], runs: int, pieces: int) -> None:
    """Print old, new and their ratio for each mesh: medians of runs that were made in turn."""
    with tempfile.TemporaryDirectory() as folder:
        old = checkout(reference, Path(folder) / "old")
        for mesh in meshes:
            taken: tuple[list[Cost], list[Cost]] = ([], [])
            for turn in range(runs):
                for which, tree in ((0, old), (1, ROOT)):
                    taken[which].append(cost(tree, mesh, Path(folder) / f"{turn}-{which}", pieces))
            print(f"\n{mesh.name}, {pieces} pieces: {reference}, this checkout, ratio; medians of {runs}")
            for k, unit in enumerate(UNITS):
                before, after = (statistics.median(one[k] for one in side) for side in taken)
                print(f"  {before:9.2f} {after:9.2f}  {after / before:6.3f}  {unit}", flush=True)


def checkout(reference: str, folder: Path) -> Path:
    """Give the folder of a checkout; that of a revision is filled first."""
    if (Path(reference) / "meshjig" / "__init__.py").is_file():
        return Path(reference).resolve()
    packed = folder.with_suffix(".tar")
    command = ["git", "-C", str(ROOT), "archive", "-o", str(packed), reference, "meshjig", "pyproject.toml"]
    made = subprocess.run(command, capture_output=True, encoding="utf-8", check=False)
    if made.returncode:
        sys.exit(f"bench: {reference} is neither a checkout nor a revision: {made.stderr.strip()}")
    with tarfile.open(packed) as archive:
        archive.extractall(folder, filter="data")
    return folder.resolve()


def cost(tree: Path, mesh: Path, out: Path, pieces: int) -> Cost:
    """Make and save a puzzle with a checkout, in a process of its own."""
    command = [sys.executable, "-c", _MAKE, str(tree), str(mesh.resolve()), str(out), str(pieces)]
    start = time.perf_counter()
    process = subprocess.Popen(command, cwd=tree, env=os.environ | {"PYTHONPATH": ""})
    _, status, usage = os.wait4(process.pid, 0)
    wall = time.perf_counter() - start
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode:
        sys.exit(f"bench: {tree} made no puzzle of {mesh}")
    kilobytes = usage.ru_maxrss / (1024 if sys.platform == "darwin" else 1)
    return Cost(wall, usage.ru_utime + usage.ru_stime, kilobytes / 1024)
