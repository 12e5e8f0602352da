"""Read pieces back from one file that holds them all, meshjig's own OBJ and GLB, and from text STL."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from meshjig.errors import InputError
from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.halfedges import compact
from meshjig.mesh.validated import validated, weld
from meshjig.output.files.glb import MODEL
from meshjig.scan.files.attachments import PictureReader
from meshjig.scan.files.formats import gltf_shortfall
from meshjig.scan.files.reading import load_by_trimesh
from meshjig.scan.files.stl import read_stl

__all__ = ["NamedPiece", "is_own_obj", "read_glb", "read_own_obj", "read_text_stl"]

NamedPiece = tuple[str, Floats, Ints]  # V (n, 3), mm; F (m, 3)
_MM = 1000.0  # glTF has metres as its unit


def is_own_obj(path: Path) -> bool:
    """Tell whether meshjig wrote an OBJ: then its groups are pieces. In others they may be anything."""
    with path.open("rb") as file:
        return path.suffix.lower() == ".obj" and file.read(9) == b"# meshjig"


def read_own_obj(path: Path) -> list[NamedPiece]:
    """Read the groups of an OBJ that meshjig wrote: triangles only, corners without normals.

    Raises
    ------
    InputError
        The file is damaged.
    """
    lines = path.read_bytes().decode("utf-8", "replace").split("\n")
    groups = [i for i, line in enumerate(lines) if line.startswith("g ")]
    try:
        V = _numbers(lines, "v ", float)
        pieces = []
        for start, end in zip(groups, [*groups[1:], len(lines)], strict=True):
            F = _numbers(lines[start:end], "f ", int).astype(np.int64) - 1
            pieces.append(_part(V, F, lines[start][2:].strip(), path))
    except ValueError:
        raise InputError(f"{path} can't be read as OBJ (a line is damaged)") from None
    if not pieces:
        raise InputError(f"{path} holds no pieces")
    return pieces


def read_glb(path: Path) -> list[NamedPiece]:
    """Read the nodes of a GLB, each where the scene puts it; metres in the file become mm.

    Where meshjig wrote it, the pieces are where they are in the other files: not turned to have y upward.

    Raises
    ------
    InputError
        No GLB, or no meshes in it.
    """
    shortfall = gltf_shortfall(path)
    if shortfall:
        raise InputError(f"{path} is cut off: {shortfall}", hint="export it again")
    try:
        scene = load_by_trimesh(path, PictureReader(), force="scene")
        whole = MODEL if MODEL in scene.graph.nodes else scene.graph.base_frame
        placed = {name: scene.graph.get(name, whole) for name in sorted(scene.graph.nodes_geometry)}
        parts = [(name, M, scene.geometry[key]) for name, (M, key) in placed.items()]
        arrays = [
            (
                name,
                _MM * (np.asarray(mesh.vertices) @ M[:3, :3].T + M[:3, 3]),
                np.asarray(mesh.faces, np.int64),
            )
            for name, M, mesh in parts
        ]
    except InputError:
        raise
    except Exception as error:  # trimesh's readers raise whatever their parsers do
        raise InputError(
            f"{path} can't be read as GLB ({(str(error) or type(error).__name__).splitlines()[0]})"
        ) from None
    if not arrays:
        raise InputError(f"{path} holds no meshes")
    return [_part(V, F, name, path) for name, V, F in arrays]


def read_text_stl(path: Path) -> tuple[Floats, Ints]:
    """Read a soup of corners, from an STL file of text in whatever coding.

    Raises
    ------
    InputError
        It is cut off, or damaged.
    """
    read = read_stl(path, PictureReader())
    if read.found < read.announced:
        raise InputError(
            f"{path} is damaged: {read.announced - read.found} of its {read.announced} facets can't be read",
            hint="export it again",
        )
    return read.source.vertices, read.source.faces


def _part(V: Floats, F: Ints, name: str, path: Path) -> NamedPiece:
    V, F = validated(V, F, f"{name} in {path}")
    F, kept = compact(F)
    return name, *validated(*weld(V[kept], F), f"{name} in {path}")


def _numbers(lines: list[str], start: str, kind: type) -> Floats:
    """The first three numbers on every line that starts so, (n, 3); what follows them is colour."""
    chosen = [line[2:] for line in lines if line.startswith(start)]
    rows = re.sub(r"/\d+", "", " ".join(chosen)).split()  # corner/picture: the corner matters here
    table: Floats = np.array(rows, dtype=object).astype(kind).reshape(max(len(chosen), 1), -1)
    if table.shape[1] not in (3, 6):
        raise ValueError(f"{table.shape[1]} numbers on a line")
    return table[:, :3]
