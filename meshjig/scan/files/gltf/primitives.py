"""Triangles of a glTF primitive, and what is given at their corners."""

from __future__ import annotations

import importlib.util
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from meshjig.errors import InputError
from meshjig.mesh.arrays import Floats, Ints
from meshjig.runtime.child import allow
from meshjig.scan.files.gltf.accessors import read_floats, read_ints, real
from meshjig.scan.files.gltf.container import Container, Item

__all__ = ["Primitive", "read_primitive"]

_DRACO = "KHR_draco_mesh_compression"
_WITHOUT = "export it without Draco compression"
_A_BYTE = 60.0, 1e-5  # bytes and s that a byte of Draco may take to be read
_TRIANGLES, _STRIP, _FAN = 4, 5, 6


class Primitive(NamedTuple):
    """The triangles of a primitive."""

    V: Floats  # (n, 3)
    F: Ints  # (m, 3)
    attributes: dict[str, Floats]  # a row a vertex: "TEXCOORD_0", "COLOR_0", "JOINTS_0" ...


def read_primitive(file: Container, primitive: Item, names: set[str]) -> Primitive | None:
    """Read the triangles of a primitive; None where it is points or lines.

    Parameters
    ----------
    file : Container
    primitive : dict, as in the file
    names : set of str, the attributes that are wanted beside positions, where there are any

    Raises
    ------
    InputError
        Packed as Draco, and that can't be read here; indices go beyond the vertices; a file is missing.
    ValueError, KeyError, TypeError
        The file is damaged.
    """
    mode = primitive.get("mode", _TRIANGLES)
    if mode not in (_TRIANGLES, _STRIP, _FAN):
        return None
    attributes = primitive["attributes"]
    packed = primitive.get("extensions", {}).get(_DRACO)
    if packed is not None and (_can_unpack() or not _has_fallback(file, primitive)):
        found, F = _unpacked(file, primitive, packed, names)  # triangles, whatever the mode
    else:
        wanted = {"POSITION"} | (names & set(attributes))
        found = {name: read_floats(file, attributes[name]) for name in wanted}
        F = _faces(file, primitive, len(found["POSITION"]), mode)
    V = found.pop("POSITION")
    out = np.flatnonzero(((F < 0) | (len(V) <= F)).any(axis=1))
    if len(out):
        raise InputError(
            f"{file.path} has a part of {len(V)} vertices that names others in {len(out)} of its"
            f" {len(F)} faces",
            hint="it may be cut off; export it again",
        )
    if any(len(values) != len(V) for values in found.values()):
        raise ValueError("attributes of one part differ in length")
    return Primitive(V, F, found)


def _faces(file: Container, primitive: Item, n: int, mode: int) -> Ints:
    if "indices" in primitive:
        return _triangles(read_ints(file, primitive["indices"]).ravel(), mode)
    return _triangles(np.arange(n), mode)


def _triangles(corners: Ints, mode: int) -> Ints:
    """Triangles (m, 3) of a list, a strip or a fan of corners; those without area are left out of strips."""
    if mode == _TRIANGLES:
        return corners[: len(corners) // 3 * 3].reshape(-1, 3)
    if len(corners) < 3:
        return np.zeros((0, 3), np.int64)
    first, second, third = corners[:-2], corners[1:-1], corners[2:]
    if mode == _FAN:
        return np.stack([np.full(len(third), corners[0]), second, third], axis=1)
    F = np.stack([first, second, third], axis=1)
    F[1::2] = F[1::2, [1, 0, 2]]
    return F[(F[:, 0] != F[:, 1]) & (F[:, 1] != F[:, 2]) & (F[:, 2] != F[:, 0])]


def _can_unpack() -> bool:
    return importlib.util.find_spec("DracoPy") is not None


def _has_fallback(file: Container, primitive: Item) -> bool:
    numbers = [*primitive["attributes"].values()]
    numbers += [primitive["indices"]] if "indices" in primitive else []
    return all("bufferView" in file.item("accessors", number) for number in numbers)


def _unpacked(
    file: Container, primitive: Item, packed: Item, names: set[str]
) -> tuple[dict[str, Floats], Ints]:
    """What a Draco stream holds: attributes, and triangles (m, 3)."""
    if not _can_unpack():
        raise InputError(
            f"{file.path} is packed with Draco ({_DRACO}), which needs a package that is not installed",
            hint=f"{_WITHOUT}, or: pip install 'meshjig[draco]'",
        )
    import DracoPy

    data = bytes(file.view(packed["bufferView"]))
    allow(_A_BYTE[0] * len(data), _A_BYTE[1] * len(data))
    try:
        mesh = DracoPy.decode(data)
        by_id = {attribute["unique_id"]: attribute["data"] for attribute in mesh.attributes}
        F = np.asarray(mesh.faces).astype(np.int64).reshape(-1, 3)
    except Exception as error:  # a decoder fed a broken file can raise anything
        raise InputError(f"{file.path} holds Draco data ({_DRACO}) that is damaged", hint=_WITHOUT) from error
    found: dict[str, Floats] = {}
    for name, number in packed["attributes"].items():
        if name == "POSITION" or name in names:
            values: NDArray[Any] = np.asarray(by_id[number])
            accessor = file.item("accessors", primitive["attributes"][name])
            found[name] = real(values.reshape(len(values), -1), bool(accessor.get("normalized", False)))
    return found, F
