"""From whatever the user has, a path, a trimesh or arrays, to plain vertices and triangles."""

from __future__ import annotations

import logging
import os
import warnings
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from meshjig.errors import InputError
from meshjig.scan.formats import FORMATS, check_whole, mentions_faces
from meshjig.scan.native import read_isolated
from meshjig.types import Floats, Ints

__all__ = ["Loaded", "load"]

_log = logging.getLogger(__name__)
_EXTENTS = (1e-30, 1e30)  # beyond these, products of lengths are no numbers any more


class Loaded(NamedTuple):
    """A mesh as it came."""

    V: Floats  # (n, 3), in the units of the source
    F: Ints  # (m, 3)
    source: Any  # the trimesh.Trimesh, with UVs, textures and colours
    facts: dict[str, Any]


def load(source: Any) -> Loaded:
    """Read a mesh.

    Files are read by trimesh; what it can't read, or finds no faces in, is read once more by pymeshlab
    in a process of its own, so that a crash in native code ends as a sentence.

    Parameters
    ----------
    source : path, trimesh.Trimesh, trimesh.Scene, or (V (n, 3), F (m, 3))

    Returns
    -------
    Loaded
        Checked for shape and finite numbers, not for topology; facts holds ``file`` and ``reader``.

    Raises
    ------
    InputError
        The file is missing, a folder, of unknown format, empty, damaged or cut off; or the mesh has
        points only, no faces, no area, coordinates that are no numbers, or indices out of range.
    """
    if isinstance(source, str | os.PathLike):
        path = Path(source)
        loaded, reader = _read(path)
        return _checked(loaded, path.name, {"file": str(path), "reader": reader})
    if isinstance(source, tuple | list) and len(source) == 2:
        return _checked(_from_arrays(*source), "the mesh", {"file": None, "reader": "arrays"})
    if hasattr(source, "vertices") or hasattr(source, "geometry"):
        return _checked(_flattened(source), "the mesh", {"file": None, "reader": "trimesh"})
    raise InputError(f"a {type(source).__name__} is no mesh", hint="give a path, a trimesh.Trimesh or (V, F)")


def _read(path: Path) -> tuple[Any, str]:
    """Give a trimesh, perhaps without faces, and the reader's name."""
    if path.is_dir():
        raise InputError(f"{path} is a folder", hint="give the mesh file inside it")
    if not path.exists():
        raise InputError(f"{path} does not exist", hint="check the name")
    kind = path.suffix.lower().lstrip(".")
    if kind not in FORMATS:
        known = ", ".join(sorted(FORMATS))
        name = f"{path} is a .{kind} file" if kind else f"{path} has no file extension"
        raise InputError(f"{name}, a format that meshjig does not know", hint=f"it reads {known}")
    try:
        if path.stat().st_size == 0:
            raise InputError(f"{path} is empty", hint="export it again")
        check_whole(path, kind)
    except OSError as error:
        raise InputError(f"{path} can't be opened ({error.strerror})") from None
    first = None if kind == "3mf" else _by_trimesh(path)
    if first is not None and len(getattr(first, "faces", ())):
        return first, "trimesh"
    second = None if kind in ("glb", "gltf") else read_isolated(path)
    if second is not None and (len(second[1]) or not mentions_faces(path, kind)):
        return _from_arrays(*second, name=path.name), "lib3mf" if kind == "3mf" else "pymeshlab"
    if first is not None:
        return first, "trimesh"
    raise InputError(
        f"{path} can't be read as {kind.upper()}: it is damaged or cut off", hint="export it again"
    )


def _by_trimesh(path: Path) -> Any:
    """Give a trimesh, perhaps without faces, or None."""
    import trimesh

    try:
        with warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore")
            return _flattened(trimesh.load(path, process=False))
    except Exception as error:  # a parser fed a broken file can raise anything
        _log.info("trimesh can't read %s: %r", path, error)
        return None


def _flattened(loaded: Any) -> Any:
    """Join a scene's meshes, each in its place."""
    if not hasattr(loaded, "geometry"):
        return loaded
    meshes = [mesh for mesh in loaded.dump() if len(getattr(mesh, "faces", ()))]
    if not meshes:
        points = [mesh for mesh in loaded.dump() if hasattr(mesh, "vertices")]
        return points[0] if points else _from_arrays(np.zeros((0, 3)), np.zeros((0, 3), np.int64))
    if len(meshes) == 1:
        return meshes[0]
    import trimesh

    return trimesh.util.concatenate(meshes)


def _from_arrays(V: Any, F: Any, name: str = "the mesh") -> Any:
    """Make a trimesh of arrays, after checking that they are such."""
    import trimesh

    try:
        V, F = np.asarray(V), np.asarray(F)
        if V.dtype.kind not in "fiu":
            raise InputError(f"V holds {V.dtype}", hint="vertices are coordinates, of a real type")
    except ValueError:
        raise InputError(
            "the rows of V or F differ in length", hint="split polygons into triangles"
        ) from None
    if V.ndim != 2 or V.shape[1] != 3:
        raise InputError(f"V has shape {V.shape}", hint="vertices are an (n, 3) array")
    if F.size and (F.ndim != 2 or F.shape[1] != 3):
        raise InputError(
            f"F has shape {F.shape}", hint="faces are an (m, 3) array: split polygons into triangles"
        )
    if F.size and F.dtype.kind not in "iu":
        raise InputError(f"F holds {F.dtype}", hint="faces are indices into V, of an integer type")
    F = F.reshape(-1, 3).astype(np.int64)
    _check_range(F, len(V), name)
    return trimesh.Trimesh(V.astype(np.float64), F, process=False, validate=False)


def _checked(mesh: Any, name: str, facts: dict[str, Any]) -> Loaded:
    """Give the arrays of a trimesh, if they are a surface."""
    V = np.array(getattr(mesh, "vertices", np.zeros((0, 3))), np.float64).reshape(-1, 3)
    F = np.array(getattr(mesh, "faces", np.zeros((0, 3))), np.int64).reshape(-1, 3)
    if not len(F):
        if len(V):
            raise InputError(
                f"{name} holds {len(V)} points but no faces",
                hint="make a surface of the points first, or export it again if it is cut off",
            )
        raise InputError(f"{name} holds no faces", hint="export it as a triangle mesh")
    _check_range(F, len(V), name)
    used = np.zeros(len(V), bool)
    used[F] = True
    bad = np.flatnonzero(used & ~np.isfinite(V).all(axis=1))
    if len(bad):
        raise InputError(
            f"{name} has coordinates that are not numbers (NaN or infinite)"
            f" in {len(bad)} of its {len(V)} vertices",
            hint="remove them, or export it again",
            ids=bad[:100].tolist(),
        )
    _check_area(V[F], name)
    return Loaded(V, F, mesh, facts)


def _check_range(F: Ints, n: int, name: str) -> None:
    out = np.flatnonzero(((F < 0) | (n <= F)).any(axis=1))
    if len(out):
        raise InputError(
            f"{name} has {n} vertices and names others"
            f" in {len(out)} of its {len(F)} faces (first: face {out[0]})",
            hint="it may be cut off; export it again",
            ids=out[:100].tolist(),
        )


def _check_area(corners: Floats, name: str) -> None:
    extent = float((corners.max(axis=(0, 1)) - corners.min(axis=(0, 1))).max())
    if np.abs(corners).max() > _EXTENTS[1] or 0 < extent < _EXTENTS[0]:
        raise InputError(f"{name} has an extent of {extent:g}, beyond any unit", hint="export it again")
    a, b, c = (corners / (extent or 1.0)).transpose(1, 0, 2)
    if not np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() > 1e-12:
        raise InputError(f"{name} has no area: all its faces are points or lines", hint="export it again")
