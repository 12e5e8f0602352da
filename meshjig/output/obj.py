"""Wavefront OBJ with its material file: one group and one colour a piece."""

from collections.abc import Iterable
from pathlib import Path

import numpy as np

from meshjig.output.piece import Piece

__all__ = ["write_obj"]


def write_obj(path: Path, pieces: Iterable[Piece]) -> None:
    """Write pieces as one OBJ, and their colours as an MTL beside it.

    Parameters
    ----------
    path : Path
        The MTL has the same name but for its ending.
    pieces : Piece
        Coordinates in mm keep nine significant digits: what 32-bit floats hold comes back unchanged.
    """
    materials = path.with_suffix(".mtl")
    colours = ["# meshjig"]
    offset = 1
    with path.open("wb") as file:
        file.write(f"# meshjig, units: mm\nmtllib {materials.name}\n".encode())
        for piece in pieces:
            name = piece.name.replace(" ", "_")
            file.write(_rows("v %.9g %.9g %.9g\n", piece.V))
            file.write(f"g {name}\nusemtl {name}\n".encode())
            file.write(_rows("f %d %d %d\n", piece.F + offset))
            colours.append("newmtl {}\nKd {:.4f} {:.4f} {:.4f}\nillum 1".format(name, *piece.colour))
            offset += len(piece.V)
    materials.write_text("\n".join(colours) + "\n", encoding="utf-8")


def _rows(pattern: str, rows: np.ndarray) -> bytes:
    return (pattern * len(rows) % tuple(rows.ravel().tolist())).encode()
