"""Measure meshjig: against the projected-cutter route, and as meshes grow.

    scripts/bench.py --corpus DIR --peer FILE   bunny and nefertiti, ours and the peer's, in one go
    scripts/bench.py --growth                   seconds and memory by stage at 50k, 200k and 1M faces

The peer is a script called as `FILE MESH --grid 10 --thickness 2 --gap 0.2 --axis auto --out DIR
--json`, which prints its wall_s. Both start from the same clean mesh, and both count their imports.
"""

import argparse
import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path

MESHES = ("stanford-bunny.obj", "nefertiti.obj")
SIZES = (50_000, 200_000, 1_000_000)
NOT_MAKING = ("check", "preview")  # the peer neither judges nor draws


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--corpus", type=Path, help="folder with stanford-bunny.obj and nefertiti.obj")
    parser.add_argument("--peer", type=Path, help="script of the projected-cutter route")
    parser.add_argument("--runs", type=int, default=3, help="runs of each, in turn; the median is quoted")
    parser.add_argument("--growth", action="store_true", help="measure growth with the number of faces")
    parser.add_argument("--worker", nargs=2, help=argparse.SUPPRESS)
    a = parser.parse_args()
    if a.worker:
        return _worker(Path(a.worker[0]), Path(a.worker[1]))
    if not a.growth and not (a.corpus and a.peer):
        parser.error("give --corpus and --peer, or --growth")
    if a.corpus and a.peer:
        for name in MESHES:
            _against_peer(a.corpus / name, a.peer, a.runs)
    if a.growth:
        _growth()
    return 0


def _against_peer(mesh: Path, peer: Path, runs: int) -> None:
    with tempfile.TemporaryDirectory() as folder:
        clean = Path(folder) / "clean.ply"
        _write_clean(mesh, clean)
        ours, theirs = [], []
        for _ in range(runs):
            ours.append(_ours(clean, Path(folder) / "ours"))
            theirs.append(_theirs(clean, peer, Path(folder) / "theirs"))
    ours.sort(key=lambda r: r["total"])
    theirs.sort(key=lambda r: r["wall_s"])
    mine, other = ours[len(ours) // 2], theirs[len(theirs) // 2]
    rest = mine["total"] - mine["stages"]["charts"]
    print(
        f"\n{mesh.name}: {mine['pieces']} pieces of ours, {other['pieces']} of the peer's; median of {runs}"
    )
    for stage, seconds in mine["stages"].items():
        print(f"  {stage:16} {seconds:7.2f} s")
    for what, seconds in (("total", mine["total"]), ("without charts", rest)):
        ratio = seconds / other["wall_s"]
        print(f"  {what:16} {seconds:7.2f} s   peer {other['wall_s']:.2f} s   ratio {ratio:.2f}")
    print("  beside that: " + ", ".join(f"{k} {v:.2f} s" for k, v in mine["beside"].items()), flush=True)


def _write_clean(mesh: Path, clean: Path) -> None:
    """Repair and scale a mesh, and close its holes: the peer takes closed meshes only."""
    import pymeshlab
    import trimesh

    from meshjig import read_scan

    surface = read_scan(mesh, size=150.0, faces="all").mesh
    filled = pymeshlab.MeshSet(verbose=False)
    filled.add_mesh(pymeshlab.Mesh(surface.V, surface.F))
    filled.meshing_close_holes(maxholesize=1000, selfintersection=False)
    made = filled.current_mesh()
    surface = read_scan((made.vertex_matrix(), made.face_matrix()), size=150.0, faces="all").mesh
    trimesh.Trimesh(surface.V, surface.F, process=False).export(clean)


def _ours(clean: Path, out: Path) -> dict:
    start = time.perf_counter()
    said = subprocess.run(
        [sys.executable, __file__, "--worker", str(clean), str(out)],
        capture_output=True,
        text=True,
        check=True,
    )
    wall = time.perf_counter() - start
    row = json.loads(said.stdout)
    stages = {k: v for k, v in row["stages"].items() if k not in NOT_MAKING}
    beside = {k: v for k, v in row["stages"].items() if k in NOT_MAKING}
    total = wall - sum(beside.values())
    stages["imports, the rest"] = total - sum(stages.values())
    return {
        "pieces": row["pieces"],
        "stages": stages,
        "beside": beside,
        "total": total,
        "memory": row["memory"],
    }


def _theirs(clean: Path, peer: Path, out: Path) -> dict:
    command = [sys.executable, str(peer), str(clean), "--grid", "10", "--thickness", "2", "--gap", "0.2"]
    command += ["--axis", "auto", "--out", str(out), "--json"]
    return json.loads(subprocess.run(command, capture_output=True, text=True, check=True).stdout)


def _worker(mesh: Path, out: Path) -> int:
    """Make a puzzle and write its STL files; print seconds and peak memory by stage."""
    import meshjig
    from meshjig.progress import peak_memory_mb

    memory = {}

    def note(stage: str, event: str) -> None:
        if event == "end":
            memory[stage] = peak_memory_mb()

    puzzle = meshjig.make_puzzle(mesh, size=150.0, pieces=100, faces="all", progress=note)
    start = time.perf_counter()
    puzzle.save(out, formats=("stl",), preview=False)
    stages = puzzle.report["timings_s"] | {"write": time.perf_counter() - start}
    print(json.dumps({"pieces": len(puzzle.pieces), "stages": stages, "memory": memory}))
    return 0


def _growth() -> None:
    sys.path.insert(0, str(Path(__file__).parent))
    from make_models import vase

    print(f"\n{'faces':>10}  seconds by stage, and peak memory so far")
    for faces in SIZES:
        rows = round((faces / 2 * 0.55) ** 0.5)
        model = vase(around=round(faces / 2 / rows), rows=rows)
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "vase.ply"
            model.export(path)
            row = _ours(path, Path(folder) / "ours")
        shown = "  ".join(
            f"{k} {v:.2f} s" + (f" {row['memory'][k]:.0f} MB" if k in row["memory"] else "")
            for k, v in (row["stages"] | row["beside"]).items()
        )
        print(f"{len(model.faces):>10}  {shown}", flush=True)


if __name__ == "__main__":
    sys.exit(main())
