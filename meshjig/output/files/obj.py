"""Wavefront OBJ with its material file: one group a piece, and its colour or the scan's picture."""

from collections.abc import Iterable
from pathlib import Path

import numpy as np

from meshjig.output.piece import Piece
from meshjig.output.texture import colour_of_vertex

__all__ = ["write_obj"]


def write_obj(path: Path, pieces: Iterable[Piece]) -> None:
    """Write pieces as one OBJ, and their colours as an MTL beside it.

    Parameters
    ----------
    path : Path
        The MTL has the same name but for its ending; so has the PNG of a picture. Colours of vertices
        follow their coordinates, as many readers know it.
    pieces : Piece
        Coordinates in mm keep nine significant digits: what 32-bit floats hold comes back unchanged.
    """
    materials = path.with_suffix(".mtl")
    colours = ["# meshjig"]
    offset = uv_offset = 1
    picture = None
    with path.open("wb") as file:
        file.write(f"# meshjig, units: mm\nmtllib {materials.name}\n".encode())
        for piece in pieces:
            name = piece.name.replace(" ", "_")
            if piece.coat is not None and piece.coat.uv is None:
                tinted = np.hstack([piece.V, colour_of_vertex(piece.F, piece.coat)])
                file.write(_rows("v %.9g %.9g %.9g %.4f %.4f %.4f\n", tinted))
            else:
                file.write(_rows("v %.9g %.9g %.9g\n", piece.V))
            if piece.coat is not None and piece.coat.uv is not None:
                picture = piece.coat.image
                uv, corner = np.unique(piece.coat.uv.reshape(-1, 2), axis=0, return_inverse=True)
                file.write(_rows("vt %.6f %.6f\n", uv))
                file.write(f"g {name}\nusemtl picture\n".encode())
                pairs = np.stack([piece.F + offset, corner.reshape(-1, 3) + uv_offset], 2)
                file.write(_rows("f %d/%d %d/%d %d/%d\n", pairs.reshape(-1, 6)))
                uv_offset += len(uv)
            else:
                file.write(f"g {name}\nusemtl {name}\n".encode())
                file.write(_rows("f %d %d %d\n", piece.F + offset))
                colours.append("newmtl {}\nKd {:.4f} {:.4f} {:.4f}\nillum 1".format(name, *piece.colour))
            offset += len(piece.V)
    if picture is not None:
        picture.save(path.with_suffix(".png"))
        colours.append(f"newmtl picture\nKd 1 1 1\nillum 1\nmap_Kd {path.with_suffix('.png').name}")
    materials.write_text("\n".join(colours) + "\n", encoding="utf-8")


def _rows(pattern: str, rows: np.ndarray) -> bytes:
    return (pattern * len(rows) % tuple(rows.ravel().tolist())).encode()
