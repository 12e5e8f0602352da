"""Judge from outside whether the thin parts of models are cut through, and nothing of them is lost.

    scripts/thin_trial.py MESH... [--pieces 100 150] [--process fdm sla] [--layout cells tiles]
    scripts/thin_trial.py DIR...             puzzles that were made before
    scripts/thin_trial.py MESH --compare     the same with --through off, for the seconds

It knows neither how pieces were made nor what check/ says of them; from report.json it takes the options.
A row a puzzle:

    ok           or what the report lists as failures; then pieces and how many it calls thin
    thin         share of 20,000 samples of the pieces' faces below which the piece is thinner than 0.9 of the
                 least wall although the model is thicker than it; at most 0.1 %. "Inside" are those of them
                 between walls and inner sheets; "flat" those whose two sides enclose less than 30 degrees:
                 a skin, while the rest is beside a sharp edge
    uncovered    share of 40,000 points of the model's surface that are farther than 0.75 of the clearance
                 from every piece, and the largest distance
    lost         share of 20,000 points in the model's thin parts that are in no piece and in no gap; at most
                 0.5 %. Thin is what rays find below --limit
"""

import argparse
import itertools
import json
import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np
from thin.cover import lost_volume, uncovered
from thin.model import Model
from thin.pictures import draw
from thin.run import Run, make
from thin.walls import thin_share

from meshjig import Puzzle
from meshjig.mesh.mesh import Mesh, concatenate
from meshjig.output.pictures.view import up_of

_MOST_THIN, _MOST_LOST = 0.001, 0.005


def main() -> int:
    a = _arguments()
    asked = list(itertools.product(a.process, a.layout, a.pieces))
    missed = False
    with tempfile.TemporaryDirectory() as scratch:
        for path in a.paths:
            if (path / "report.json").is_file():
                missed |= _row(path, path.name, a)
                continue
            for process, layout, pieces in asked:
                options = {"size": a.size, "process": process, "layout": layout, "pieces": pieces}
                name = f"{path.stem}-{process}-{layout}-{pieces}"
                missed |= _made(path, name, options, Path(a.keep or scratch), a)
    return 1 if missed else 0


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("paths", type=Path, nargs="+", metavar="MESH|DIR")
    parser.add_argument("--pieces", type=int, nargs="+", default=[100])
    parser.add_argument("--process", nargs="+", default=["fdm"])
    parser.add_argument("--layout", nargs="+", choices=("cells", "tiles"), default=["cells"])
    parser.add_argument("--size", type=float, default=150.0, help="mm")
    parser.add_argument("--through", help="MM, auto or off; as meshjig has it if not given")
    parser.add_argument("--limit", type=float, help="mm; what is thin, if not as --through says")
    parser.add_argument("--compare", action="store_true", help="also make each with --through off")
    parser.add_argument("--model", type=Path, help="the mesh of a DIR, if not where its report says")
    parser.add_argument("--keep", type=Path, help="keep the puzzles in this folder")
    parser.add_argument("--pictures", type=Path, help="a folder for pictures from both sides")
    return parser.parse_args()


def _made(mesh: Path, name: str, options: dict[str, Any], folder: Path, a: argparse.Namespace) -> bool:
    """Make a puzzle, judge it, and print its row and what it took; tell whether it misses an aim."""
    if a.through is not None:
        options = options | {"through": a.through if a.through in ("auto", "off") else float(a.through)}
    folder.mkdir(parents=True, exist_ok=True)
    run = make(mesh, folder / name, options)
    if run.said:
        print(f"{name:32} none: {run.said}", flush=True)
        return True
    took = f"{run.wall:.1f} s, {run.cpu:.1f} s of processors"
    if a.compare:
        took += _compared(mesh, folder / f"{name}-off", options, run)
    return _row(folder / name, name, a, mesh, took)


def _compared(mesh: Path, folder: Path, options: dict[str, Any], run: Run) -> str:
    off = make(mesh, folder, options | {"through": "off"})
    if off.said:
        return f" (off: none: {off.said})"
    ratios = f"{run.wall / off.wall:.2f}, {run.cpu / off.cpu:.2f}"
    return f" (off {off.wall:.1f}, {off.cpu:.1f}; ratios {ratios})"


def _row(folder: Path, name: str, a: argparse.Namespace, mesh: Path | None = None, took: str = "") -> bool:
    """Judge the puzzle in a folder and print its row; tell whether it misses an aim."""
    puzzle = Puzzle.load(folder)
    report = puzzle.report
    asked = report["options"]
    if asked["side"] != "in":
        print(f"{name:32} not judged: with --side {asked['side']} the pieces' outside is not the model's")
        return True
    model = Model.of(a.model or mesh or Path(report["input"]["file"]), asked)
    pieces = [Mesh(piece.V, piece.F) for piece in puzzle.pieces]
    thin = thin_share(model, pieces, asked["min_wall"])
    bare = uncovered(model, pieces, asked["clearance"])
    limit = a.limit or _limit(report)
    lost = lost_volume(model, pieces, asked["clearance"], limit)
    verdict = "ok" if report["ok"] else ", ".join(report["failures"])
    walls = f"{len(pieces)} pieces, {report['checks']['thin_walls']} with thin walls"
    print(f"{name:32} {'; '.join(filter(None, (verdict, walls, took)))}")
    print(
        f"{'':8} thin {thin.share:.3%} (inside {thin.inside:.3%}, flat {thin.flat:.3%}; the model itself "
        f"{thin.pardoned:.2%}), from {thin.thinnest:.3f} mm; uncovered {bare.share:.3%}, up to "
        f"{bare.farthest:.3f} mm; lost {lost.share:.2%} below {limit:g} mm, {lost.part:.1%} of the area"
    )
    if thin.share > _MOST_THIN:
        print(f"{'':8} most of it in {', '.join(f'piece {i} ({n})' for i, n in thin.worst)}")
    if bare.farthest > 2 * max(asked["clearance"], 0.1):
        print(f"{'':8} farthest from pieces at {json.dumps(np.round(bare.at, 2).tolist())}")
    sys.stdout.flush()
    if a.pictures:
        a.pictures.mkdir(parents=True, exist_ok=True)
        whole = concatenate(pieces)
        draw(a.pictures / f"{name}.png", pieces, up_of(report, whole.V, whole.F), thin.at)
    return not report["ok"] or thin.share > _MOST_THIN or lost.share > _MOST_LOST


def _limit(report: dict[str, Any]) -> float:
    """Give the thickness below which parts were cut through, or else could not be made of two walls, mm."""
    asked = report["options"]
    return float(report["through"]["limit_mm"] or 2 * asked["min_wall"] + asked["clearance"])


if __name__ == "__main__":
    sys.exit(main())
