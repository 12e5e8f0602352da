"""What a glTF scene places where: meshes, by nodes within nodes, once or many times."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

from meshjig.errors import InputError
from meshjig.mesh.arrays import Floats
from meshjig.scan.files.gltf.accessors import read_floats
from meshjig.scan.files.gltf.container import Container, Item

__all__ = ["Placed", "global_matrices", "placed_meshes"]

_INSTANCING = "EXT_mesh_gpu_instancing"
_BLANK = {"translation": (0, 0, 0), "rotation": (0, 0, 0, 1), "scale": (1, 1, 1)}


class Placed(NamedTuple):
    """A mesh, and its places."""

    mesh: int
    matrices: Floats  # (k, 4, 4), each takes its coordinates, as columns, to those of the scene
    node: Item


def placed_meshes(file: Container, notes: list[str]) -> list[Placed]:
    """List the meshes of the scene that a viewer shows; of all where the file does not say which.

    Parameters
    ----------
    file : Container
    notes : list of str, to which a sentence is added where meshes are left out

    Raises
    ------
    InputError
        Nodes are placed by themselves, or by several others.
    ValueError, KeyError, TypeError
        The file is damaged.
    """
    if not file.items("nodes"):
        return [Placed(mesh, np.eye(4)[None], {}) for mesh in range(len(file.items("meshes")))]
    before = len(notes)
    matrices = global_matrices(file, _roots(file, notes))
    found = []
    for number, matrix in matrices.items():
        node = file.item("nodes", number)
        if "mesh" in node:
            found.append(Placed(node["mesh"], matrix @ _instances(file, node), node))
    unseen = len(set(range(len(file.items("meshes")))) - {place.mesh for place in found})
    if unseen and len(notes) == before:
        notes.append(f"left out: {unseen} mesh{'es' * (unseen > 1)} that the scene does not show")
    return found


def global_matrices(file: Container, roots: list[Any] | None = None) -> dict[int, Floats]:
    """Give the place in the scene, (4, 4), of every node below some; below all where none are given."""
    nodes = file.items("nodes")
    if roots is None:
        children = {child for node in nodes for child in node.get("children", ())}
        roots = [number for number in range(len(nodes)) if number not in children]
    found: dict[int, Floats] = {}
    within = _within_parents(nodes)
    waiting = [(root, np.eye(4)) for root in reversed(roots)]
    while waiting:
        number, above = waiting.pop()
        node = file.item("nodes", number)
        if number in found:
            raise InputError(
                f"{file.path} places node {number} in itself or in several others", hint="export it again"
            )
        found[number] = above @ within[number]
        waiting += [(child, found[number]) for child in reversed(node.get("children", []))]
    return found


def _roots(file: Container, notes: list[str]) -> list[Any] | None:
    scenes = file.items("scenes")
    if not scenes:
        return None
    if "scene" not in file.header:
        return list(dict.fromkeys(root for scene in scenes for root in scene.get("nodes", [])))
    shown = set(_below(file, file.item("scenes", file.header["scene"]).get("nodes", [])))
    others = {node for scene in scenes for node in _below(file, scene.get("nodes", []))} - shown
    if any("mesh" in file.item("nodes", node) for node in others):
        notes.append(f"of {len(scenes)} scenes only the one that the file calls its scene was read")
    return list(file.item("scenes", file.header["scene"]).get("nodes", []))


def _below(file: Container, roots: list[Any]) -> Iterator[int]:
    seen: set[int] = set()
    waiting = list(roots)
    while waiting:
        node = waiting.pop()
        if node not in seen:
            seen.add(node)
            yield node
            waiting += file.item("nodes", node).get("children", [])


def _within_parents(nodes: list[Any]) -> Floats:
    """The place of each node in the one above, (n, 4, 4)."""
    moves, turns, scales = (
        np.array([node.get(name, blank) for node in nodes], np.float64).reshape(len(nodes), -1)
        for name, blank in _BLANK.items()
    )
    matrices = _composed(moves, turns, scales)
    for number, node in enumerate(nodes):
        if "matrix" in node:
            matrices[number] = np.array(node["matrix"], np.float64).reshape(4, 4).T
    return matrices


def _instances(file: Container, node: Item) -> Floats:
    """The places (k, 4, 4) of a mesh within its node: one, unless GPU instances are asked for."""
    if _INSTANCING not in node.get("extensions", {}):
        return np.eye(4)[None]
    attributes = node["extensions"][_INSTANCING]["attributes"]
    given = {name: read_floats(file, attributes[name]) for name in attributes if name[0] != "_"}
    count = len(next(iter(given.values()))) if given else 1
    moves, turns, scales = (
        given.get(name.upper(), np.tile(np.array(value, np.float64), (count, 1)))
        for name, value in _BLANK.items()
    )
    return _composed(moves, turns, scales)


def _composed(moves: Floats, turns: Floats, scales: Floats) -> Floats:
    """Matrices (k, 4, 4) of translations (k, 3), quaternions xyzw (k, 4) and scales (k, 3)."""
    x, y, z, w = (turns / np.maximum(np.linalg.norm(turns, axis=1, keepdims=True), 1e-300)).T
    rotation = np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    ).transpose(2, 0, 1)
    matrices = np.tile(np.eye(4), (len(moves), 1, 1))
    matrices[:, :3, :3] = rotation * scales[:, None]
    matrices[:, :3, 3] = moves
    return matrices
