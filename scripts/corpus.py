"""Make a puzzle of every mesh in a folder and write down what came of it, as JSON.

    scripts/corpus.py --corpus DIR [--out FILE] [--against OLDER] [--keep DIR] [-- OPTIONS OF make]

Each mesh runs in a process of its own. Two runs can be compared. With --slicer, `prusa-slicer --info`
reads every file that was written; with or without it, lib3mf reads the 3MF in strict mode.
"""

import argparse
import json
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

SUFFIXES = {".obj", ".off", ".stl", ".ply", ".glb", ".3mf"}


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--corpus", type=Path, required=True, help="folder of meshes")
    parser.add_argument("--out", type=Path, default=Path("corpus.json"))
    parser.add_argument("--against", type=Path, help="an older report to compare with")
    parser.add_argument("--keep", type=Path, help="keep the puzzles in this folder")
    parser.add_argument("--samples", action="store_true", help="also run the scans that pymeshlab brings")
    parser.add_argument("--slicer", action="store_true", help="have prusa-slicer judge every file")
    parser.add_argument("--only", nargs="*", default=[], help="names of meshes to run")
    parser.add_argument("options", nargs="*", help="options of meshjig make, after --")
    a = parser.parse_args()
    meshes = sorted(p for p in a.corpus.iterdir() if p.suffix.lower() in SUFFIXES)
    meshes += _samples() if a.samples else []
    meshes = [p for p in meshes if not a.only or p.stem in a.only]
    if not meshes:
        print(f"no meshes in {a.corpus}", file=sys.stderr)
        return 1
    keep = a.keep or Path(tempfile.mkdtemp(prefix="corpus-"))
    keep.mkdir(parents=True, exist_ok=True)
    rows = {}
    for mesh in meshes:
        rows[mesh.stem] = _run(mesh, keep / mesh.stem, a.options, a.slicer)
        print(_line(mesh.stem, rows[mesh.stem]), flush=True)
        a.out.write_text(json.dumps(rows, indent=1), encoding="utf-8")
    if a.against:
        _compare(json.loads(a.against.read_text(encoding="utf-8")), rows)
    if not a.keep:
        shutil.rmtree(keep)
    return 0


def _samples() -> list[Path]:
    import pymeshlab

    folder = Path(pymeshlab.__file__).parent / "tests/sample_meshes"
    return [folder / "bunny.obj", folder / "rangemaps/face000.ply"]


def _run(mesh: Path, target: Path, options: list[str], slicer: bool) -> dict:
    shutil.rmtree(target, ignore_errors=True)
    command = [sys.executable, "-m", "meshjig", "make", str(mesh), "-o", str(target), "-q", *options]
    start = time.perf_counter()
    done = subprocess.run(command, capture_output=True, encoding="utf-8", check=False)
    row = {"exit": done.returncode, "wall_s": time.perf_counter() - start, "said": done.stderr.strip()[-600:]}
    if not (target / "report.json").is_file():
        return row
    report = json.loads((target / "report.json").read_text(encoding="utf-8"))
    n = len(report["pieces"])
    row |= {"pieces": n} | {
        k: report[k] for k in ("charts", "checks", "timings_s", "peak_memory_mb", "failures")
    }
    row["strict_3mf"] = _strict_3mf(target / "puzzle.3mf")
    if slicer:
        row["not_manifold"] = [p.name for p in sorted(target.rglob("*")) if not _slicer_agrees(p)]
    return row


def _slicer_agrees(path: Path) -> bool:
    """Read what the slicer prints: its exit code says nothing."""
    if path.suffix not in {".stl", ".3mf"}:
        return True
    said = subprocess.run(
        ["prusa-slicer", "--info", str(path)], capture_output=True, encoding="utf-8", check=False
    )
    verdicts = [
        line.split("=")[1].strip() for line in said.stdout.splitlines() if line.startswith("manifold")
    ]
    return bool(verdicts) and set(verdicts) == {"yes"}


def _strict_3mf(path: Path) -> dict | None:
    if not path.is_file():
        return None
    import lib3mf

    wrapper = lib3mf.get_wrapper()
    model = wrapper.CreateModel()
    reader = model.QueryReader("3mf")
    reader.SetStrictModeActive(True)
    reader.ReadFromFile(str(path))
    objects, sound = model.GetMeshObjects(), []
    while objects.MoveNext():
        sound.append(objects.GetCurrentMeshObject().IsManifoldAndOriented())
    return {"warnings": reader.GetWarningCount(), "objects": len(sound), "not_sound": sound.count(False)}


def _line(name: str, row: dict) -> str:
    if "pieces" not in row:
        return f"{name:16} exit {row['exit']}  {row['wall_s']:5.1f} s  {row['said']}"
    c, t = row["checks"], row["timings_s"]
    stages = " ".join(f"{stage} {seconds:.1f}" for stage, seconds in t.items())
    return (
        f"{name:16} exit {row['exit']}  {row['wall_s']:5.1f} s  {row['peak_memory_mb']:.0f} MB"
        f"  {row['pieces']} pieces  {row['charts']['n_charts']} charts  crossing {c['self_intersections']}"
        f"  overlap {c['overlap_mm3']}  gap {c['gap_mm']}  outer gap {c.get('gap_outer_mm')}"
        f"  area error {c['area_error']:.1e}  locked {c['interlocked_borders']}  head/neck {c['head_neck']}"
        f"  cv {c['area_cv']:.2f}  discarded {c['discarded_volume_share']}  3mf {row['strict_3mf']}"
        f"  not manifold {row.get('not_manifold', 'not asked')}\n    {stages}\n    {list(row['failures'])}"
    )


def _compare(old: dict, new: dict) -> None:
    for name in sorted(set(old) & set(new)):
        a, b = old[name], new[name]
        print(
            f"{name:16} exit {a['exit']} -> {b['exit']}  pieces {a.get('pieces')} -> {b.get('pieces')}"
            f"  {a['wall_s']:.1f} -> {b['wall_s']:.1f} s"
        )


if __name__ == "__main__":
    sys.exit(main())
