"""Arrays of a glTF file: strided, normalised, sparse."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from meshjig.mesh.arrays import Floats, Ints
from meshjig.scan.files.gltf.container import Container

__all__ = ["read_accessor", "read_floats", "read_ints", "real"]

_KINDS = {5120: "i1", 5121: "u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}


def read_accessor(file: Container, number: Any) -> NDArray[Any]:
    """Read an array as it stands, (count, width).

    Parameters
    ----------
    file : Container
    number : int, of the accessor

    Raises
    ------
    InputError
        A file that it needs is missing.
    ValueError, KeyError, TypeError
        It is not as the standard has it, or ends beyond its bytes.
    """
    accessor = file.item("accessors", number)
    kind = np.dtype(_KINDS[accessor["componentType"]])
    shape = int(accessor["count"]), _WIDTHS[accessor["type"]]
    if shape[0] < 0:
        raise ValueError("an array has less than no entries")
    if "bufferView" in accessor:
        stride = int(file.item("bufferViews", accessor["bufferView"]).get("byteStride", 0))
        values = _entries(
            file.view(accessor["bufferView"]), kind, shape, int(accessor.get("byteOffset", 0)), stride
        )
    elif shape[0] > file.path.stat().st_size + sum(map(len, file.buffers.values())):
        raise ValueError(f"an array of {shape[0]} entries has no bytes")
    else:
        values = np.zeros(shape, kind)
    if "sparse" in accessor:
        values = values.copy()
        sparse = accessor["sparse"]
        where, what = sparse["indices"], sparse["values"]
        count = int(sparse["count"])
        at = _entries(
            file.view(where["bufferView"]),
            np.dtype(_KINDS[where["componentType"]]),
            (count, 1),
            int(where.get("byteOffset", 0)),
        )
        values[at[:, 0]] = _entries(
            file.view(what["bufferView"]), kind, (count, shape[1]), int(what.get("byteOffset", 0))
        )
    return values


def read_floats(file: Container, number: Any) -> Floats:
    """Read an array as real numbers, (count, width) float64; integers that are normalised become 0 to 1."""
    return real(read_accessor(file, number), bool(file.item("accessors", number).get("normalized", False)))


def read_ints(file: Container, number: Any) -> Ints:
    """Read an array of whole numbers, (count, width) int64."""
    values = read_accessor(file, number)
    if values.dtype.kind == "f":
        raise ValueError("indices are no whole numbers")
    return values.astype(np.int64)


def real(values: NDArray[Any], normalised: bool) -> Floats:
    """Give values as real numbers; those that are normalised stand for -1 or 0 to 1."""
    if not normalised or values.dtype.kind == "f":
        return values.astype(np.float64)
    scaled: Floats = values / float(np.iinfo(values.dtype).max)
    return np.maximum(scaled, -1.0)


def _entries(
    data: memoryview, kind: np.dtype[Any], shape: tuple[int, int], start: int, stride: int = 0
) -> NDArray[Any]:
    """Entries of a view, ``stride`` bytes apart, or close together where that is 0."""
    count, width = shape
    size = kind.itemsize * width
    step = stride or size
    if count < 0 or start < 0 or step < size or (count and start + step * (count - 1) + size > len(data)):
        raise ValueError(f"an array of {count} entries ends beyond its {len(data)} bytes")
    return np.ndarray(shape, kind, data, start, (step, kind.itemsize)) if count else np.zeros(shape, kind)
