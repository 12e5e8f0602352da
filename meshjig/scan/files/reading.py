"""A mesh file, read in a process that may crash, or be ended, without ours."""

from __future__ import annotations

import hashlib
import logging
import stat
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from meshjig.errors import InputError
from meshjig.mesh.arrays import Floats, Ints
from meshjig.runtime.bounded import allow_file
from meshjig.scan.files.attachments import PictureReader, resolver_for
from meshjig.scan.files.file_mesh import FileMesh
from meshjig.scan.files.formats import check_whole
from meshjig.scan.files.gltf import read_gltf
from meshjig.scan.files.kinds import check_kind
from meshjig.scan.files.obj import read_obj
from meshjig.scan.files.off import read_off
from meshjig.scan.files.ply import read_ply
from meshjig.scan.files.stl import read_stl
from meshjig.scan.files.three_mf import read_3mf_source
from meshjig.scan.scale import import_pymeshlab
from meshjig.scan.source import Source

__all__ = ["FileMesh", "check_file", "load_by_trimesh", "read_file"]

_log = logging.getLogger(__name__)


def check_file(path: Path) -> None:
    """Refuse what is no file with something in it.

    Raises
    ------
    InputError
        It is missing, a folder, a pipe or a device, or empty.
    """
    try:
        kind = path.stat()
    except (OSError, ValueError) as error:
        if isinstance(error, OSError) and not isinstance(error, FileNotFoundError):
            raise InputError(f"{path} can't be opened ({error.strerror})") from None
        raise InputError(f"{path} does not exist", hint="check the name") from None
    if stat.S_ISDIR(kind.st_mode):
        raise InputError(f"{path} is a folder", hint="give the mesh file inside it")
    if not stat.S_ISREG(kind.st_mode):
        raise InputError(f"{path} is no regular file", hint="save the mesh to a file first")
    if kind.st_size == 0:
        raise InputError(f"{path} is empty", hint="export it again")


def read_file(name: str, by_pymeshlab: bool = True) -> FileMesh:
    """Read a mesh file.

    What a reader gives is compared with what the file says that it holds. Where more than a tenth of the
    faces is missing, pymeshlab reads once more; fewer are named in a note.

    Parameters
    ----------
    name : str
    by_pymeshlab : bool, whether pymeshlab may try

    Returns
    -------
    FileMesh, perhaps with points only

    Raises
    ------
    InputError
        The file is missing, a folder, of unknown format, of another than its name says, empty, damaged or cut
        off.
    """
    path = Path(name)
    check_file(path)
    kind = path.suffix.lower().lstrip(".")
    try:
        allow_file(path)
        check_kind(path, kind)
        check_whole(path, kind)
        with np.errstate(all="ignore"):
            read = _read(path, kind, by_pymeshlab and kind in _OF_PYMESHLAB)
        with path.open("rb") as file:
            return read._replace(sha256=hashlib.file_digest(file, "sha256").hexdigest())
    except OSError as error:
        raise InputError(f"{path} can't be opened ({error.strerror})") from None


def _read(path: Path, kind: str, twice: bool) -> FileMesh:
    try:
        first = _READERS[kind](path, PictureReader())
    except (InputError, OSError):
        raise
    except Exception as error:  # a parser fed a broken file can raise anything
        _log.info("%s can't be read: %r", path, error)
        first = None
    if first is not None and len(first.source.faces):
        lost = first.announced - first.found
        if not lost:
            return first
        if lost <= _SMALL_LOSS * first.announced:
            note = f"{lost} of {first.announced} faces are left out: they name vertices that are not there,"
            return first._replace(notes=[*first.notes, f"{note} or places that are no numbers"])
    announced = first.announced if first is not None else 0
    second = _by_pymeshlab(path) if twice else None
    if second is not None and len(second.faces) >= max(1, (1 - _SMALL_LOSS) * announced):
        notes = ["colours and pictures, if it has any, are left out"]
        return FileMesh(second, "pymeshlab", notes)
    if announced and first is not None:
        raise InputError(
            f"{path} is damaged: {announced - first.found} of its {announced} faces can't be read, as they"
            " name vertices that are not there, or places that are no numbers",
            hint="export it again",
        )
    if first is not None:
        return first
    raise InputError(
        f"{path} can't be read as {kind.upper()}: it is damaged or cut off", hint="export it again"
    )


def load_by_trimesh(path: Path, pictures: PictureReader, **options: Any) -> Any:
    """Read a file by trimesh, which opens no other files than regular ones, and pictures by our reader only.

    Raises
    ------
    InputError
        The file names a pipe or a device.
    Exception
        Whatever a parser fed a broken file raises.
    """
    import trimesh

    resolver = resolver_for(path, pictures)
    try:
        with warnings.catch_warnings(), np.errstate(all="ignore"), pictures.instead():
            warnings.simplefilter("ignore")
            return trimesh.load(path, process=False, resolver=resolver, **options)
    finally:
        if resolver.refused is not None:  # trimesh goes on without materials it can't have
            raise resolver.refused


def _read_gltf(path: Path, pictures: PictureReader) -> FileMesh:
    source, notes = read_gltf(path, pictures)
    return FileMesh(source, "meshjig", notes)


def _read_3mf(path: Path, pictures: PictureReader) -> FileMesh:
    source, notes = read_3mf_source(path, pictures)
    return FileMesh(source, "lib3mf", notes)


def _by_pymeshlab(path: Path) -> Source | None:
    """Read a mesh; None where that fails."""
    pymeshlab = import_pymeshlab()
    meshes = pymeshlab.MeshSet(verbose=False)
    try:
        meshes.load_new_mesh(str(path.resolve()))
        mesh = meshes.current_mesh()
        source = _plain(mesh.vertex_matrix(), mesh.face_matrix())
        sound = not len(source.faces) or (
            source.faces.min() >= 0 and source.faces.max() < len(source.vertices)
        )
        return source if sound else None
    except Exception as error:  # as above
        _log.info("pymeshlab can't read %s: %r", path, error)
        return None


def _plain(V: Floats, F: Ints) -> Source:
    return Source(V.astype(np.float64), F.astype(np.int64).reshape(-1, 3))


_READERS: dict[str, Callable[[Path, PictureReader], FileMesh]] = {
    "obj": read_obj,
    "stl": read_stl,
    "ply": read_ply,
    "off": read_off,
    "glb": _read_gltf,
    "gltf": _read_gltf,
    "3mf": _read_3mf,
}
# what it is better at than no reader; of OFF it follows faces to vertices beyond its memory
_OF_PYMESHLAB = ("obj", "stl", "ply")
_SMALL_LOSS = 0.1  # of the faces: what a note is enough for
