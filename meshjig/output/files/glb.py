"""GLB for viewers: one named node a piece, in its colour or with the scan's picture."""

from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np

from meshjig.mesh.types import Floats, Ints
from meshjig.output.piece import Piece

__all__ = ["write_glb"]

_METRES = 0.001  # glTF has metres as its unit


def write_glb(path: Path, pieces: Iterable[Piece]) -> None:
    """Write pieces as one binary glTF file.

    Parameters
    ----------
    path : Path
    pieces : Piece
        Lengths in mm become metres, as the format asks.
    """
    import trimesh

    scene = trimesh.Scene()
    pictures: dict[int, Any] = {}
    for piece in pieces:
        V, F, visual = _dressed(piece, pictures)
        mesh = trimesh.Trimesh(V * _METRES, F, process=False, validate=False)
        mesh.visual = visual
        scene.add_geometry(mesh, node_name=piece.name, geom_name=piece.name)
    path.write_bytes(scene.export(file_type="glb"))


def _dressed(piece: Piece, pictures: dict[int, Any]) -> tuple[Floats, Ints, Any]:
    """Give vertices, faces and looks; a vertex comes several times where its faces look different."""
    from trimesh.visual import ColorVisuals, TextureVisuals
    from trimesh.visual.material import PBRMaterial

    V, F, coat = piece.V, piece.F, piece.coat
    if coat is None:
        colour = (*piece.colour, 1.0)
        plain = PBRMaterial(name=piece.name, baseColorFactor=colour, metallicFactor=0.0, roughnessFactor=0.8)
        return V, F, TextureVisuals(material=plain)
    shown = coat.rgb if coat.uv is None else coat.uv
    rows = np.column_stack([F.ravel(), shown.reshape(3 * len(F), -1)])
    _, first, corner = np.unique(rows, axis=0, return_index=True, return_inverse=True)
    V, G = V[F.ravel()[first]], corner.reshape(-1, 3)
    looks = rows[first, 1:]
    if coat.uv is None:
        return V, G, ColorVisuals(vertex_colors=np.rint(255 * looks).astype(np.uint8))
    if id(coat.image) not in pictures:
        pictures[id(coat.image)] = PBRMaterial(
            name="picture", baseColorTexture=coat.image, metallicFactor=0.0, roughnessFactor=0.8
        )
    return V, G, TextureVisuals(uv=looks, material=pictures[id(coat.image)])
