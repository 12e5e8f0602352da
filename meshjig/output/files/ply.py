"""Binary PLY: a file a piece, with a colour a vertex."""

from pathlib import Path

import numpy as np

from meshjig.output.piece import Piece
from meshjig.output.texture import colour_of_vertex

__all__ = ["write_ply"]

_VERTEX = np.dtype([("place", "<f4", 3), ("colour", "u1", 3)])
_FACE = np.dtype([("n", "u1"), ("corners", "<i4", 3)])


def write_ply(path: Path, piece: Piece) -> None:
    """Write one piece, in mm; its colour, or the scan's picture on its outer side, is in its vertices.

    Parameters
    ----------
    path : Path
    piece : Piece
    """
    vertices = np.zeros(len(piece.V), _VERTEX)
    vertices["place"] = piece.V
    rgb = np.array(piece.colour) if piece.coat is None else colour_of_vertex(piece.F, piece.coat)
    vertices["colour"] = np.rint(255 * rgb)
    faces = np.zeros(len(piece.F), _FACE)
    faces["n"], faces["corners"] = 3, piece.F
    header = [
        "ply",
        "format binary_little_endian 1.0",
        f"comment meshjig {piece.name}, units: mm",
        f"element vertex {len(vertices)}",
        *(f"property float {axis}" for axis in "xyz"),
        *(f"property uchar {channel}" for channel in ("red", "green", "blue")),
        f"element face {len(faces)}",
        "property list uchar int vertex_indices",
        "end_header",
    ]
    path.write_bytes("\n".join([*header, ""]).encode() + vertices.tobytes() + faces.tobytes())
