"""GLB for viewers: one named and coloured node a piece."""

from collections.abc import Iterable
from pathlib import Path

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
    for piece in pieces:
        material = trimesh.visual.material.PBRMaterial(
            name=piece.name, baseColorFactor=(*piece.colour, 1.0), metallicFactor=0.0, roughnessFactor=0.8
        )
        mesh = trimesh.Trimesh(piece.V * _METRES, piece.F, process=False, validate=False)
        mesh.visual = trimesh.visual.TextureVisuals(material=material)
        scene.add_geometry(mesh, node_name=piece.name, geom_name=piece.name)
    path.write_bytes(scene.export(file_type="glb"))
