"""From a glTF or GLB file to one mesh with all that it shows."""

from __future__ import annotations

import struct
from pathlib import Path
from typing import Any

import numpy as np

from meshjig.errors import InputError
from meshjig.mesh.arrays import Floats
from meshjig.runtime.child import allow
from meshjig.scan.files.attachments import PictureReader
from meshjig.scan.files.gltf.container import Container, Item, open_gltf
from meshjig.scan.files.gltf.materials import Materials
from meshjig.scan.files.gltf.nodes import Placed, placed_meshes
from meshjig.scan.files.gltf.pose import morphed, skinned
from meshjig.scan.files.gltf.primitives import Primitive, read_primitive
from meshjig.scan.files.join import join
from meshjig.scan.source import Look, Source, Unit

__all__ = ["read_gltf"]

_METRE = Unit(1000.0, "m", binding=False)  # many programs write whatever they have
_FEW_FACES = 2_000_000  # so many may be placed, whatever the file's size
_FACES_A_BYTE = 5
_A_FACE = 400.0, 5e-6  # bytes and s that placing takes
_DAMAGES = (
    ArithmeticError,
    AttributeError,
    LookupError,
    RecursionError,
    TypeError,
    ValueError,
    struct.error,
)


def read_gltf(path: Path, pictures: PictureReader) -> tuple[Source, list[str]]:
    """Read what a glTF file's scene shows, each mesh in its place, in the pose in which it is saved.

    Parameters
    ----------
    path : Path, of a .gltf or .glb file
    pictures : PictureReader

    Returns
    -------
    source : Source
        In metres, y upward. Colours are sRGB: those of the file are linear, as the standard has it, but for
        files of programs that are known to write sRGB.
    notes : list of str, a sentence for everything that was left out

    Raises
    ------
    InputError
        The file is damaged, needs a file that is missing or an extension that is not known, or places more
        than any honest file does.
    """
    notes: list[str] = []
    try:
        file = open_gltf(path)
        source = join(_Scene(file, pictures, notes).parts())
    except InputError:
        raise
    except _DAMAGES as error:
        raise InputError(f"{path} can't be read as glTF: {_reason(error)}", hint="export it again") from error
    return source, [*notes, *pictures.notes]


class _Scene:
    """What is read of a file once, and placed perhaps many times."""

    def __init__(self, file: Container, pictures: PictureReader, notes: list[str]) -> None:
        self._file, self._notes = file, notes
        self._materials = Materials(file, pictures, notes)
        pictures.expected = max(len(file.items("images")), 1)
        self._read: dict[int, list[tuple[Item, Primitive, Look]]] = {}
        self._other = 0

    def parts(self) -> list[Source]:
        placed = placed_meshes(self._file, self._notes)
        self._bound(placed)
        found = [part for place in placed for part in self._parts_of(place)]
        if self._other:
            self._notes.append(f"left out: {self._other} part{'s' * (self._other > 1)} of points or lines")
        if self._file.items("animations"):
            self._notes.append("the model moves: it was taken in the pose in which it is saved")
        return found or [Source(np.zeros((0, 3)), np.zeros((0, 3), np.int64), Look(), _METRE, "y")]

    def _bound(self, placed: list[Placed]) -> None:
        """Refuse what places beyond measure, before it is made."""
        faces = sum(
            len(place.matrices) * sum(len(mesh.F) for _, mesh, _ in self._primitives(place.mesh))
            for place in placed
        )
        held = self._file.path.stat().st_size + sum(map(len, self._file.buffers.values()))
        if faces > max(_FEW_FACES, _FACES_A_BYTE * held):
            raise InputError(
                f"{self._file.path} has {held} bytes and places its objects again and again, {faces} faces"
                " together",
                hint="export fewer copies",
            )
        allow(_A_FACE[0] * faces, _A_FACE[1] * faces)

    def _primitives(self, mesh: Any) -> list[tuple[Item, Primitive, Look]]:
        if mesh not in self._read:
            self._read[mesh] = []
            primitives = self._file.item("meshes", mesh)["primitives"]
            if not primitives:
                self._notes.append(f"left out: mesh {mesh}, which has nothing in it")
            for primitive in primitives:
                wanted = self._materials.attributes(primitive) | {"JOINTS_0", "WEIGHTS_0"}
                read = read_primitive(self._file, primitive, wanted)
                if read is None:
                    self._other += 1
                else:
                    self._read[mesh].append((primitive, read, self._materials.look(primitive, read)))
        return self._read[mesh]

    def _parts_of(self, place: Placed) -> list[Source]:
        weights = place.node.get("weights", self._file.item("meshes", place.mesh).get("weights"))
        found = []
        for primitive, mesh, look in self._primitives(place.mesh):
            V = morphed(self._file, primitive, weights, mesh.V)
            posed = skinned(self._file, place.node["skin"], mesh, V) if "skin" in place.node else None
            if posed is not None:
                found.append(Source(posed, mesh.F, look, _METRE, "y"))
            else:
                found += [_moved(V, mesh, look, matrix) for matrix in place.matrices]
        return found


def _moved(V: Floats, mesh: Primitive, look: Look, matrix: Floats) -> Source:
    """A part in its place; one that is mirrored there has its faces turned."""
    F = mesh.F
    if np.linalg.det(matrix[:3, :3]) < 0:
        F, look = F[:, ::-1], look.turned()
    return Source(V @ matrix[:3, :3].T + matrix[:3, 3], F, look, _METRE, "y")


def _reason(error: Exception) -> str:
    if isinstance(error, KeyError):
        return f"{error} is missing or unknown"
    if isinstance(error, UnicodeDecodeError) or type(error).__name__ == "JSONDecodeError":
        return "its JSON is damaged or cut off"
    if type(error) is ValueError and str(error):
        return str(error)
    return "it is damaged"
