"""A mesh file, read in a process that may crash, or be ended, without ours."""

from __future__ import annotations

import logging
import stat
import warnings
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from meshjig.errors import InputError
from meshjig.mesh.arrays import Floats, Ints
from meshjig.runtime.bounded import allow_file
from meshjig.scan.attachments import PictureReader, resolver_for
from meshjig.scan.formats import FORMATS, check_whole, mentions_faces
from meshjig.scan.from_trimesh import from_trimesh
from meshjig.scan.gltf import read_gltf
from meshjig.scan.scale import import_pymeshlab
from meshjig.scan.source import Source
from meshjig.scan.three_mf import read_3mf_source

__all__ = ["FileMesh", "check_file", "load_by_trimesh", "read_file"]

_log = logging.getLogger(__name__)


class FileMesh(NamedTuple):
    """What a file holds."""

    source: Source
    reader: str
    notes: list[str]  # a sentence for everything that was left out


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

    trimesh reads first; what it can't read, or finds no faces in, is read once more by pymeshlab. 3MF is
    read by lib3mf.

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
        The file is missing, a folder, of unknown format, empty, damaged or cut off.
    """
    path = Path(name)
    check_file(path)
    kind = path.suffix.lower().lstrip(".")
    if kind not in FORMATS:
        known = ", ".join(sorted(FORMATS))
        shown = f"{path} is a .{kind} file" if kind else f"{path} has no file extension"
        raise InputError(f"{shown}, a format that meshjig does not know", hint=f"it reads {known}")
    try:
        allow_file(path)
        check_whole(path, kind)
    except OSError as error:
        raise InputError(f"{path} can't be opened ({error.strerror})") from None
    pictures = PictureReader()
    if kind == "3mf":
        source, notes = read_3mf_source(path, pictures)
        return FileMesh(source, "lib3mf", notes)
    if kind in ("glb", "gltf"):
        source, notes = read_gltf(path, pictures)
        return FileMesh(source, "meshjig", notes)
    first = _by_trimesh(path, pictures)
    if first is not None and len(first.faces):
        return FileMesh(first, "trimesh", pictures.notes)
    if by_pymeshlab and kind not in ("glb", "gltf"):
        second = _by_pymeshlab(path)
        if second is not None and (len(second.faces) or not mentions_faces(path, kind)):
            return FileMesh(second, "pymeshlab", [])
    if first is not None:
        return FileMesh(first, "trimesh", pictures.notes)
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


def _by_trimesh(path: Path, pictures: PictureReader) -> Source | None:
    """Read a mesh, perhaps without faces; None where it fails."""
    try:
        return from_trimesh(load_by_trimesh(path, pictures))
    except InputError:
        raise
    except Exception as error:  # a parser fed a broken file can raise anything
        _log.info("trimesh can't read %s: %r", path, error)
        return None


def _by_pymeshlab(path: Path) -> Source | None:
    pymeshlab = import_pymeshlab()
    meshes = pymeshlab.MeshSet(verbose=False)
    try:
        meshes.load_new_mesh(str(path.resolve()))
        mesh = meshes.current_mesh()
        return _plain(mesh.vertex_matrix(), mesh.face_matrix())
    except Exception as error:  # as above
        _log.info("pymeshlab can't read %s: %r", path, error)
        return None


def _plain(V: Floats, F: Ints) -> Source:
    return Source(V.astype(np.float64), F.astype(np.int64).reshape(-1, 3))
