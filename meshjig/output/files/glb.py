"""Binary glTF: a named node a piece, with its colour, the colours of the scan or its texture."""

from __future__ import annotations

import json
import struct
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from meshjig.mesh.arrays import Floats, Ints
from meshjig.output.pictures.colours import to_linear
from meshjig.output.piece import Piece
from meshjig.output.scan_picture import Picture

__all__ = ["MODEL", "write_glb"]

MODEL = "model"  # the node of a GLB in which pieces have the coordinates of the other files

_METRES = 0.001  # glTF has metres as its unit
_VERTICES, _CORNERS = 34962, 34963  # what a buffer view is for
_KINDS = {np.dtype("<f4"): 5126, np.dtype("<u4"): 5125, np.dtype("<u2"): 5123}
_WIDTHS = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4"}
_MATT = {"metallicFactor": 0.0, "roughnessFactor": 0.8}


def write_glb(path: Path, pieces: Iterable[Piece], up: Floats | None = None) -> None:
    """Write pieces as one binary glTF file.

    Parameters
    ----------
    path : Path
    pieces : Piece
        Lengths in mm become metres, and colours linear, as the format asks; those of vertices have 16 bits a
        channel. A vertex comes several times where its faces look different.
    up : (3,) float64, optional
        The format has y upward: the axis nearest to this is turned there by a node above all pieces.
    """
    file = _File()
    for piece in pieces:
        file.add(piece)
    file.write(path, None if up is None else _to_y(up))


class _Dressed(NamedTuple):
    """A piece, and numbers of what the file has of its looks."""

    V: NDArray[np.float32]  # (n, 3), metres
    F: Ints  # (m, 3)
    attributes: Mapping[str, int]
    material: int


class _File:
    """A GLB in the making."""

    def __init__(self) -> None:
        self._data: list[bytes] = []
        self._size = 0
        self._views: list[Mapping[str, Any]] = []
        self._accessors: list[Mapping[str, Any]] = []
        self._materials: list[Mapping[str, Any]] = []
        self._meshes: list[Mapping[str, Any]] = []
        self._names: list[str] = []
        self._pictures: list[Picture] = []
        self._material_of: dict[int, int] = {}  # of a picture, and of colours

    def add(self, piece: Piece) -> None:
        dressed = self._dressed(piece)
        low, high = (x.tolist() for x in (dressed.V.min(axis=0), dressed.V.max(axis=0)))
        places = self._array(dressed.V, _VERTICES, min=low, max=high)
        primitive = {
            "attributes": {"POSITION": places, **dressed.attributes},
            "indices": self._array(dressed.F.astype("<u4").reshape(-1, 1), _CORNERS),
            "material": dressed.material,
        }
        self._meshes.append({"name": piece.name, "primitives": [primitive]})
        self._names.append(piece.name)

    def _dressed(self, piece: Piece) -> _Dressed:
        """Give vertices, faces and looks; a vertex comes several times where its faces look different."""
        texture = piece.texture
        places = (piece.V * _METRES).astype("<f4")
        if texture is None:
            colour = {"baseColorFactor": [*to_linear(np.array(piece.colour)).tolist(), 1.0]}
            return _Dressed(places, piece.F, {}, self._material(piece.name, colour))
        V, F, looks = _split(piece.F, texture.shown)
        if texture.picture is None:
            linear = np.rint(65535 * to_linear(looks)).astype("<u2")
            padded = np.hstack([linear, np.full((len(linear), 1), 65535, "<u2")])  # rows of 8 bytes
            colours = {"COLOR_0": self._array(padded, _VERTICES, normalized=True)}
            return _Dressed(places[V], F, colours, self._shared(0, "colours", {}))
        uv = {"TEXCOORD_0": self._array((looks * (1, -1) + (0, 1)).astype("<f4"), _VERTICES)}
        return _Dressed(places[V], F, uv, self._shown(texture.picture))

    def _shown(self, picture: Picture) -> int:
        if id(picture) not in self._material_of:
            self._pictures.append(picture)
        number = len(self._pictures) - 1
        return self._shared(id(picture), "picture", {"baseColorTexture": {"index": number}})

    def _shared(self, key: int, name: str, colour: Mapping[str, Any]) -> int:
        if key not in self._material_of:
            self._material_of[key] = self._material(name, colour)
        return self._material_of[key]

    def _material(self, name: str, colour: Mapping[str, Any]) -> int:
        self._materials.append({"name": name, "pbrMetallicRoughness": {**_MATT, **colour}})
        return len(self._materials) - 1

    def _array(self, rows: NDArray[Any], purpose: int, **more: Any) -> int:
        accessor = {"componentType": _KINDS[rows.dtype], "count": len(rows), "type": _WIDTHS[rows.shape[1]]}
        self._accessors.append({"bufferView": self._view(rows.tobytes(), target=purpose), **accessor, **more})
        return len(self._accessors) - 1

    def _view(self, data: bytes, **more: int) -> int:
        self._views.append({"buffer": 0, "byteOffset": self._size, "byteLength": len(data), **more})
        padded = data + bytes(-len(data) % 4)
        self._data.append(padded)
        self._size += len(padded)
        return len(self._views) - 1

    def write(self, path: Path, turn: Floats | None) -> None:
        images = [{"bufferView": self._view(p.png), "mimeType": "image/png"} for p in self._pictures]
        nodes: list[Mapping[str, Any]] = [{"name": name, "mesh": k} for k, name in enumerate(self._names)]
        roots = list(range(len(nodes)))
        if turn is not None and nodes:
            nodes.append({"name": MODEL, "matrix": turn.T.ravel().tolist(), "children": roots})
            roots = [len(nodes) - 1]
        lists = {
            "materials": self._materials,
            "meshes": self._meshes,
            "nodes": nodes,
            "images": images,
            "textures": [{"source": k} for k in range(len(images))],
            "accessors": self._accessors,
            "bufferViews": self._views,
            "buffers": [{"byteLength": self._size}] if self._size else [],
        }
        header = {
            "asset": {"version": "2.0", "generator": "meshjig"},
            "scene": 0,
            "scenes": [{"nodes": roots} if roots else {}],
            **{name: things for name, things in lists.items() if things},
        }
        text = json.dumps(header, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        chunks = (
            (struct.pack("<I4s", len(text), b"JSON"), text),
            (struct.pack("<I4s", self._size, b"BIN\0"), *self._data),
        )
        size = 12 + sum(len(part) for chunk in chunks for part in chunk)
        with path.open("wb") as file:
            file.write(struct.pack("<4sII", b"glTF", 2, size))
            for chunk in chunks:
                file.writelines(chunk)


def _to_y(up: Floats) -> Floats:
    """Give the turn, (4, 4), that takes the axis nearest to a direction to y: a quarter, a half, or none."""
    axis = int(np.abs(up).argmax())
    sign = float(np.sign(up[axis]))
    if axis == 1:
        return np.diag([sign, sign, 1.0, 1.0])
    turn = np.eye(4)
    turn[[1, axis]] = 0
    turn[1, axis], turn[axis, 1] = sign, -sign
    return turn


def _split(F: Ints, shown: Floats) -> tuple[Ints, Ints, Floats]:
    """Split vertices where their faces look different.

    Parameters
    ----------
    F : (m, 3) int64
    shown : (m, 3, d) float64, at the corners

    Returns
    -------
    origin : (k,) int64, the vertex that each was split from
    G : (m, 3) int64
    looks : (k, d) float64
    """
    rows: Floats = np.column_stack([F.ravel(), shown.reshape(3 * len(F), -1)])
    _, first, corner = np.unique(rows, axis=0, return_index=True, return_inverse=True)
    G: Ints = corner.reshape(-1, 3)
    return F.ravel()[first], G, rows[first, 1:]
