"""Make one puzzle and write down what it is: make.py CHECKOUT MESH OPTIONS OUT."""

import hashlib
import json
import sys
from pathlib import Path

NOT_COMPARED = {"timings_s", "peak_memory_mb", "meshjig"}
WRONG_CHECKOUT = 77


def make(checkout: Path, mesh: str, options: dict, out: Path) -> int:
    """Make a puzzle; the exit code is WRONG_CHECKOUT where another meshjig was imported."""
    import meshjig

    if checkout not in Path(meshjig.__file__).resolve().parents:
        return WRONG_CHECKOUT
    try:
        puzzle = meshjig.make_puzzle(mesh, **options)
        if "plate" in options:  # pieces are laid on plates when they are written
            puzzle.save(out.parent / "puzzle", formats=("stl",), preview=False, viewer=False, guide=False)
    except Exception as error:
        made = {"failure": f"{type(error).__name__}: {error}".replace(mesh, Path(mesh).name)}
    else:
        report = {key: value for key, value in puzzle.report.items() if key not in NOT_COMPARED}
        report["input"] = {key: value for key, value in report["input"].items() if key != "file"}
        made = {"pieces": _solids(puzzle.pieces), "core": _solids(puzzle.core), "report": report}
    out.write_text(json.dumps(made, default=lambda array: array.tolist()), encoding="utf-8")
    return 0


def _solids(pieces: list) -> dict[str, dict]:
    """Give shape, type and hash of the arrays of every piece, and the box that it fills, mm."""
    return {
        piece.name: {
            "V": [list(piece.V.shape), str(piece.V.dtype), _hash(piece.V.tobytes())],
            "F": [list(piece.F.shape), str(piece.F.dtype), _hash(piece.F.tobytes())],
            "box": [*piece.V.min(0).tolist(), *piece.V.max(0).tolist()] if len(piece.V) else [],
        }
        for piece in pieces
    }


def _hash(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()


if __name__ == "__main__":
    sys.exit(make(Path(sys.argv[1]), sys.argv[2], json.loads(sys.argv[3]), Path(sys.argv[4])))
