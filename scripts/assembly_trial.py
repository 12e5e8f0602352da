"""How many pieces of puzzles go in, and what that costs: a row for every mesh.

    scripts/assembly_trial.py MESH... [--pieces N] [--process sla] [--layout cells|tiles] [--assembly any|off]

Each puzzle is made at 150 mm with a gap of 0.2 mm, and judged by the library as `meshjig check` does.
"""

import argparse
import sys
import time
from pathlib import Path

import meshjig


def row(mesh: str, options: argparse.Namespace) -> str:
    """Make a puzzle, and tell what became of it."""
    begun, cpu = time.perf_counter(), time.process_time()
    try:
        puzzle = meshjig.make_puzzle(
            mesh,
            size=150.0,
            clearance=0.2,
            pieces=options.pieces,
            process=options.process,
            layout=options.layout,
            assembly=options.assembly,
            through=options.through,
            give=options.give,
        )
    except meshjig.MeshjigError as error:
        return f"{Path(mesh).stem:18} {error}"
    wall, cpu = time.perf_counter() - begun, time.process_time() - cpu
    report = puzzle.report
    a, checks, seconds = report.get("assembly"), report["checks"], report["timings_s"]
    planned = (
        f"{a['proved']:4d} proved {a['straight']:4d} straight; volume {a['volume_error']:.2f};"
        f" tilt {a['tilt']['median']:.0f}/{a['tilt']['p95']:.0f}/{a['tilt']['max']:.0f};"
        f" angle {a['wall_angle']['min']:.0f}, under 50: {a['wall_angle']['under_50_share']:.3f};"
        f" plain {a['plain_borders']}, joined {a['joined_pieces']}, islands {a['islands']}"
        if a
        else "no plan"
    )
    broken = {promise: len(names) for promise, names in report["failures"].items()}
    return (
        f"{Path(mesh).stem:18} {len(puzzle.pieces):4d} pieces; {planned};"
        f" locks {checks['interlocked_length']:.3f}; cv {checks['area_cv']:.3f};"
        f" gap {checks['gap_mm']['min']:.3f}; {wall:.0f} s, solid {seconds['solid']:.0f}, cpu {cpu:.0f};"
        f" broken {broken}"
    )


def main() -> int:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("meshes", nargs="+")
    parser.add_argument("--pieces", type=int, default=100)
    parser.add_argument("--process", default="sla")
    parser.add_argument("--layout", default="cells")
    parser.add_argument("--assembly", default="any")
    parser.add_argument("--through", default="auto")
    parser.add_argument("--give", type=float)
    options = parser.parse_args()
    for mesh in options.meshes:
        print(row(mesh, options), flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
