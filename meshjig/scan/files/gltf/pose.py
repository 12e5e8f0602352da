"""The pose in which a glTF file is saved: morph targets and skeletons."""

from __future__ import annotations

from typing import Any

import numpy as np

from meshjig.mesh.arrays import Floats
from meshjig.scan.files.gltf.accessors import read_floats
from meshjig.scan.files.gltf.container import Container, Item
from meshjig.scan.files.gltf.nodes import global_matrices
from meshjig.scan.files.gltf.primitives import Primitive

__all__ = ["morphed", "skinned"]


def morphed(file: Container, primitive: Item, weights: Any, V: Floats) -> Floats:
    """Give vertices (n, 3) with the morph targets added that the file gives a weight."""
    for weight, target in zip(weights or (), primitive.get("targets", ()), strict=False):
        if weight and "POSITION" in target:
            moves = read_floats(file, target["POSITION"])
            if moves.shape != V.shape:
                raise ValueError("a morph target is of another length than its part")
            V = V + float(weight) * moves
    return V


def skinned(file: Container, skin: Any, mesh: Primitive, V: Floats) -> Floats | None:
    """Give vertices (n, 3) in the scene, as the joints of a skin stand; None for a part without weights."""
    if not {"JOINTS_0", "WEIGHTS_0"} <= set(mesh.attributes):
        return None
    found = file.item("skins", skin)
    places = global_matrices(file)
    joints = np.array([places[joint] for joint in found["joints"]])
    if "inverseBindMatrices" in found:
        joints = joints @ read_floats(file, found["inverseBindMatrices"]).reshape(-1, 4, 4).transpose(0, 2, 1)
    joint, weight = mesh.attributes["JOINTS_0"].astype(np.int64), mesh.attributes["WEIGHTS_0"]
    weight = weight / np.maximum(weight.sum(axis=1, keepdims=True), 1e-12)
    moved = np.zeros_like(V)
    for k in range(joint.shape[1]):
        matrices = joints[joint[:, k]]
        moved += weight[:, k, None] * (np.einsum("nij,nj->ni", matrices[:, :3, :3], V) + matrices[:, :3, 3])
    return moved
