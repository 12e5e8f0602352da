"""STL, PLY and OBJ, written in one go."""

from collections.abc import Iterable
from pathlib import Path

import numpy as np

from meshjig.mesh.arrays import Floats, Ints
from meshjig.output.piece import Piece
from meshjig.output.texture import colour_of_vertex

__all__ = ["write_obj", "write_ply", "write_stl"]


_FACET = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])

_VERTEX = np.dtype([("place", "<f4", 3), ("colour", "u1", 3)])
_FACE = np.dtype([("n", "u1"), ("corners", "<i4", 3)])
_TINTED = np.dtype([("n", "u1"), ("corners", "<i4", 3), ("colour", "u1", 3)])
_CHANNELS = ("red", "green", "blue")


def write_stl(path: Path, V: Floats, F: Ints, name: str = "") -> None:
    """Write a mesh as binary STL.

    Parameters
    ----------
    path : Path
    V : (n, 3) float64, mm; pass it through ``printable`` first if the file is to be printed
    F : (m, 3) int64
    name : str, stands in the header beside the unit, which the format itself does not have
    """
    facets = np.zeros(len(F), _FACET)
    corners = V.astype(np.float32)[F]
    facets["corners"] = corners
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]).astype(np.float64)
    facets["normal"] = normal / np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-30)
    header = f"meshjig, units: mm, {name}".encode("ascii", "replace")[:80].ljust(80)
    with path.open("wb") as file:
        file.write(header + len(F).to_bytes(4, "little"))
        file.write(facets.tobytes())


def write_ply(path: Path, piece: Piece) -> None:
    """Write one piece, in mm; its colour, or the scan's picture on its outer side, is in its vertices.

    Where the scan has a colour a face, it is in the faces too.

    Parameters
    ----------
    path : Path
    piece : Piece
    """
    vertices = np.zeros(len(piece.V), _VERTEX)
    vertices["place"] = piece.V
    rgb = np.array(piece.colour) if piece.texture is None else colour_of_vertex(piece.F, piece.texture)
    vertices["colour"] = np.rint(255 * rgb)
    tints = None if piece.texture is None else piece.texture.colour_of_faces
    faces = np.zeros(len(piece.F), _FACE if tints is None else _TINTED)
    faces["n"], faces["corners"] = 3, piece.F
    if tints is not None:
        faces["colour"] = np.rint(255 * tints)
    channels = [f"property uchar {channel}" for channel in _CHANNELS]
    header = [
        "ply",
        "format binary_little_endian 1.0",
        f"comment meshjig {piece.name}, units: mm",
        f"element vertex {len(vertices)}",
        *(f"property float {axis}" for axis in "xyz"),
        *channels,
        f"element face {len(faces)}",
        "property list uchar int vertex_indices",
        *(channels if tints is not None else ()),
        "end_header",
    ]
    path.write_bytes("\n".join([*header, ""]).encode() + vertices.tobytes() + faces.tobytes())


def write_obj(path: Path, pieces: Iterable[Piece]) -> None:
    """Write pieces as one OBJ, and their colours as an MTL beside it.

    Parameters
    ----------
    path : Path
        The MTL has the same name but for its ending; so has the PNG of a picture. Colours of vertices follow
        their coordinates, as many readers know it; there is no MTL then, whose colours would go before them.
    pieces : Piece
        Coordinates in mm keep nine significant digits: what 32-bit floats hold comes back unchanged.
    """
    materials: list[str] = []
    offset = uv_offset = 1
    picture = None
    library = path.with_suffix(".mtl")
    with path.open("wb") as file:
        file.write(b"# meshjig, units: mm\n")
        for piece in pieces:
            name = piece.name.replace(" ", "_")
            texture = piece.texture
            tinted = texture is not None and texture.picture is None
            if offset == 1 and not tinted:
                file.write(f"mtllib {library.name}\n".encode())
            if texture is not None and tinted:
                rows = np.hstack([piece.V, colour_of_vertex(piece.F, texture)])
                file.write(_rows("v %.9g %.9g %.9g %.4f %.4f %.4f\n", rows))
            else:
                file.write(_rows("v %.9g %.9g %.9g\n", piece.V))
            if texture is not None and texture.picture is not None:
                picture = texture.picture
                uv, corner = np.unique(texture.shown.reshape(-1, 2), axis=0, return_inverse=True)
                file.write(_rows("vt %.6f %.6f\n", uv))
                file.write(f"g {name}\nusemtl picture\n".encode())
                pairs = np.stack([piece.F + offset, corner.reshape(-1, 3) + uv_offset], 2)
                file.write(_rows("f %d/%d %d/%d %d/%d\n", pairs.reshape(-1, 6)))
                uv_offset += len(uv)
            else:
                file.write(f"g {name}\n".encode() + (b"" if tinted else f"usemtl {name}\n".encode()))
                file.write(_rows("f %d %d %d\n", piece.F + offset))
                if not tinted:
                    materials.append(
                        "newmtl {}\nKd {:.4f} {:.4f} {:.4f}\nillum 1".format(name, *piece.colour)
                    )
            offset += len(piece.V)
    if picture is not None:
        path.with_suffix(".png").write_bytes(picture.png)
        materials.append(f"newmtl picture\nKd 1 1 1\nillum 1\nmap_Kd {path.with_suffix('.png').name}")
    if materials:
        library.write_text("\n".join(["# meshjig", *materials]) + "\n", encoding="utf-8")


def _rows(pattern: str, rows: np.ndarray) -> bytes:
    return (pattern * len(rows) % tuple(rows.ravel().tolist())).encode()
