"""Draw the pictures of the README and of docs/: the stages of two puzzles of one scan.

    scripts/pictures.py [MESH]      the bunny that comes with pymeshlab, if no mesh is given

They come to docs/pictures/, as JPEG, and are committed: who reads the documentation need not make them.
"""

import sys
import tempfile
from pathlib import Path

import pymeshlab
from PIL import Image

import meshjig

TARGET = Path(__file__).parent.parent / "docs" / "pictures"
BUNNY = Path(pymeshlab.__file__).parent / "tests/sample_meshes/bunny.obj"
WANTED = {
    "tiles": {"charts": "1_layout", "tiling": "2_outlines", "tiles": "3_cut"},
    "cells": {
        "cells": "1_layout",
        "knobs": "2_outlines",
        "cut": "3_cut",
        "shell": "4_shell",
        "solids": "5_solids",
    },
}
WIDTH = 1200  # pixels


def main() -> int:
    scan = Path(sys.argv[1]) if sys.argv[1:] else BUNNY
    TARGET.mkdir(parents=True, exist_ok=True)
    for layout, pictures in WANTED.items():
        with tempfile.TemporaryDirectory() as folder:
            stages = Path(folder) / "stages"
            puzzle = meshjig.make_puzzle(
                scan, size=150, pieces=80, faces=30_000, layout=layout, debug_dir=stages
            )
            print(puzzle)
            for name, stage in pictures.items():
                image = (
                    Image.open(stages / f"{stage}.png")
                    .convert("RGB")
                    .resize((WIDTH, WIDTH // 2), Image.LANCZOS)
                )
                image.save(TARGET / f"{name}.jpg", quality=82, optimize=True, progressive=True)
                print(f"{name}.jpg  {(TARGET / f'{name}.jpg').stat().st_size / 1000:.0f} kB")
    return 0


if __name__ == "__main__":
    sys.exit(main())
