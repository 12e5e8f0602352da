import numpy as np
import trimesh

from meshjig.output.files.glb import write_glb
from meshjig.output.piece import Piece
from tests.meshes import sphere, torus

PIECES = [Piece("piece_001", *sphere(300), (1.0, 0.2, 0.0)), Piece("piece_002", *torus(500), (0.0, 0.4, 1.0))]


def test_glb_has_a_named_coloured_node_a_piece_in_metres(tmp_path):
    write_glb(tmp_path / "puzzle.glb", PIECES)
    scene = trimesh.load_scene(tmp_path / "puzzle.glb", process=False)
    assert set(scene.graph.nodes_geometry) == {"piece_001", "piece_002"}
    for piece in PIECES:
        transform, name = scene.graph[piece.name]
        mesh = scene.geometry[name]
        points = trimesh.transform_points(mesh.vertices, transform)
        np.testing.assert_allclose(1000 * points[mesh.faces], piece.V[piece.F], atol=1e-3)
        colour = mesh.visual.material.baseColorFactor[:3]
        np.testing.assert_allclose(colour, np.round(255 * np.array(piece.colour)), atol=1)
