"""Measure meshjig: against the projected-cutter route, and as meshes and puzzles grow.

    scripts/bench.py [peer] --corpus DIR --peer FILE   bunny and nefertiti, ours and the peer's, in one go
    scripts/bench.py growth                            seconds and memory by stage at 50k, 200k and 1M faces
    scripts/bench.py solids                            seconds of the solids by pieces and by faces
    scripts/bench.py charts --corpus DIR               charts, seams and seconds, xatlas beside them
    scripts/bench.py cells --corpus DIR                cells, knobs and cut, against one LSCM a cell
    scripts/bench.py against REV_OR_DIR [--mesh FILE]  another checkout against this one, in turn

Without a name, everything runs that can but `against`. The peer is a script called as `FILE MESH --grid 10
--thickness 2 --gap 0.2 --axis auto --out DIR --json`, which prints its wall_s. Both start from the same
clean mesh, and both count their imports.
"""

import argparse
import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from benches import against, cells, charts

MESHES = ("stanford-bunny.obj", "nefertiti.obj")
SIZES = (50_000, 200_000, 1_000_000)
PIECES = (50, 100, 200, 400)
WHAT = ("peer", "growth", "solids", "charts", "cells", "against")
NOT_MAKING = ("check", "preview", "viewer", "guide")  # the peer neither judges nor draws


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("what", nargs="*", help=", ".join(WHAT))
    parser.add_argument(
        "--corpus", type=Path, help="folder with stanford-bunny.obj, nefertiti.obj and others"
    )
    parser.add_argument("--peer", type=Path, help="script of the projected-cutter route")
    parser.add_argument("--mesh", type=Path, nargs="+", help="for against; else the bunny")
    parser.add_argument("--pieces", type=int, default=100, help="for against")
    parser.add_argument("--runs", type=int, default=3, help="runs of each, in turn; the median is quoted")
    parser.add_argument(
        "--method", default="solid", help="clearance method of ours: solid, stretch or domain"
    )
    parser.add_argument("--worker", nargs=3, metavar=("MESH", "OUT", "PIECES"), help=argparse.SUPPRESS)
    a = parser.parse_args()
    if a.worker:
        return _worker(Path(a.worker[0]), Path(a.worker[1]), int(a.worker[2]), a.method)
    if a.what[:1] == ["against"]:
        if len(a.what) != 2:
            parser.error("against needs one revision or folder")
        against.run(a.what[1], a.mesh or [_bunny()], a.runs, a.pieces)
        return 0
    if set(a.what) - set(WHAT):
        parser.error(f"choose from {', '.join(WHAT)}")
    if "peer" in a.what and not (a.corpus and a.peer):
        parser.error("peer needs --corpus and --peer")
    if {"charts", "cells"} & set(a.what) and not a.corpus:
        parser.error("charts and cells need --corpus")
    if a.corpus and a.peer and (not a.what or "peer" in a.what):
        for name in MESHES:
            _against_peer(a.corpus / name, a.peer, a.runs, a.method)
    if a.corpus and (not a.what or "charts" in a.what):
        charts.run(a.corpus)
    if a.corpus and (not a.what or "cells" in a.what):
        cells.run(a.corpus)
    if not a.what or "growth" in a.what:
        print("\nby faces, 100 pieces of a vase: seconds by stage, and peak memory so far")
        for faces in SIZES:
            row = _vase(faces, 100, a.method)
            print(f"{row['faces']:>10}  {_stages(row)}", flush=True)
    if not a.what or "solids" in a.what:
        print("\nsolids of a vase of 50,000 faces, by pieces; and of 100 pieces, by faces")
        for pieces in PIECES:
            print(
                f"{pieces:>10} pieces  {_vase(50_000, pieces, 'solid')['stages']['solid']:.2f} s", flush=True
            )
        for faces in SIZES[:2]:
            print(f"{faces:>10} faces   {_vase(faces, 100, 'solid')['stages']['solid']:.2f} s", flush=True)
    return 0


def _bunny() -> Path:
    import pymeshlab

    return Path(pymeshlab.__file__).parent / "tests/sample_meshes/bunny.obj"


def _against_peer(mesh: Path, peer: Path, runs: int, method: str) -> None:
    with tempfile.TemporaryDirectory() as folder:
        clean = Path(folder) / "clean.ply"
        _write_clean(mesh, clean)
        ours, theirs = [], []
        for _ in range(runs):
            ours.append(_ours(clean, Path(folder) / "ours", 100, method))
            theirs.append(_theirs(clean, peer, Path(folder) / "theirs"))
    ours.sort(key=lambda r: r["total"])
    theirs.sort(key=lambda r: r["wall_s"])
    mine, other = ours[len(ours) // 2], theirs[len(theirs) // 2]
    rest = mine["total"] - mine["stages"]["charts"]
    print(f"\n{mesh.name}, {method}: {mine['pieces']} pieces of ours, {other['pieces']} of the peer's")
    print(f"median of {runs} runs")
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


def _ours(mesh: Path, out: Path, pieces: int, method: str) -> dict:
    command = [sys.executable, __file__, "--method", method, "--worker", str(mesh), str(out), str(pieces)]
    start = time.perf_counter()
    said = subprocess.run(command, capture_output=True, encoding="utf-8", check=True)
    wall = time.perf_counter() - start
    row = json.loads(said.stdout)
    stages = {k: v for k, v in row["stages"].items() if k not in NOT_MAKING}
    beside = {k: v for k, v in row["stages"].items() if k in NOT_MAKING}
    total = wall - sum(beside.values())
    stages["imports, the rest"] = total - sum(stages.values())
    return row | {"stages": stages, "beside": beside, "total": total}


def _theirs(clean: Path, peer: Path, out: Path) -> dict:
    command = [sys.executable, str(peer), str(clean), "--grid", "10", "--thickness", "2", "--gap", "0.2"]
    command += ["--axis", "auto", "--out", str(out), "--json"]
    return json.loads(subprocess.run(command, capture_output=True, encoding="utf-8", check=True).stdout)


def _worker(mesh: Path, out: Path, pieces: int, method: str) -> int:
    """Make a puzzle and write its STL files; print seconds and peak memory by stage."""
    import meshjig
    from meshjig.runtime.progress import peak_memory_mb

    memory = {}

    def note(stage: str, event: str) -> None:
        if event == "end":
            memory[stage] = peak_memory_mb()

    puzzle = meshjig.make_puzzle(
        mesh, size=150.0, pieces=pieces, faces="all", layout="tiles", clearance_method=method, progress=note
    )
    start = time.perf_counter()
    puzzle.save(out, formats=("stl",), preview=False, viewer=False, guide=False)
    stages = puzzle.report["timings_s"] | {"write": time.perf_counter() - start}
    faces = puzzle.report["input"]["working_faces"]
    print(json.dumps({"pieces": len(puzzle.pieces), "faces": faces, "stages": stages, "memory": memory}))
    return 0


def _vase(faces: int, pieces: int, method: str) -> dict:
    from models.vases import vase

    rows = round((faces / 2 * 0.55) ** 0.5)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "vase.ply"
        vase(around=round(faces / 2 / rows), rows=rows).export(path)
        return _ours(path, Path(folder) / "ours", pieces, method)


def _stages(row: dict) -> str:
    both = row["stages"] | row["beside"]
    memory = {stage: f" {mb:.0f} MB" for stage, mb in row["memory"].items()}
    return "  ".join(f"{stage} {seconds:.2f} s{memory.get(stage, '')}" for stage, seconds in both.items())


if __name__ == "__main__":
    sys.exit(main())
