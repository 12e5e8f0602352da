"""A scan's picture stays where it was, and only on the outside."""

import numpy as np
import pytest
import trimesh
from PIL import Image

from meshjig.mesh.measure import area_vectors
from meshjig.mesh.mesh import Mesh
from meshjig.output.files.mesh_files import write_glb, write_obj, write_ply
from meshjig.output.files.read_pieces import read_pieces
from meshjig.output.files.threemf import write_3mf
from meshjig.output.piece import Piece
from meshjig.output.texture import colour_of_vertex, textures
from meshjig.scan.from_trimesh import from_trimesh
from meshjig.scan.source import Source
from tests.meshes import sphere

TINTS = np.array([[0.2, 0.4, 0.6]])
THICK = 2.0


def ball(kind):
    """A sphere whose colour tells where one is, and its solid shell; the source is in other units."""
    V, F = sphere(4000)
    here = (V - V.min(0)) / np.ptp(V, axis=0)
    if kind == "texture":
        ramp = np.linspace(0, 255, 256).astype(np.uint8)
        pixels = np.stack([np.tile(ramp, (256, 1)), np.tile(ramp[::-1, None], (1, 256))], -1)
        image = Image.fromarray(np.dstack([pixels, np.zeros((256, 256, 1), np.uint8)]))
        visual = trimesh.visual.TextureVisuals(uv=here[:, :2], image=image)
        source = trimesh.Trimesh(V / 10 + 5, F, visual=visual, process=False)
    else:
        colours = np.c_[np.rint(255 * here[:, :2]), np.zeros(len(V)), np.full(len(V), 255)]
        source = trimesh.Trimesh(V / 10 + 5, F, vertex_colors=colours.astype(np.uint8), process=False)
    inner = V * (1 - THICK / np.linalg.norm(V, axis=1)[:, None])
    solid = np.vstack([V, inner]), np.vstack([F, F[:, ::-1] + len(V)])
    to_source = np.diag([0.1, 0.1, 0.1, 1.0])
    to_source[:3, 3] = 5
    return Mesh(V, F), from_trimesh(source), to_source, solid


@pytest.fixture(params=["texture", "colours"])
def dressed(request):
    surface, source, to_source, solid = ball(request.param)
    texture = textures([solid], TINTS, surface, source, to_source, (-0.5, 0.5))[0]
    return surface, Piece("piece_001", *solid, tuple(TINTS[0]), texture=texture)


def expected(surface, points):
    return (points - surface.V.min(0)) / np.ptp(surface.V, axis=0)


def test_the_outer_side_has_the_picture_and_the_rest_the_pieces_colour(dressed):
    surface, piece = dressed
    outward = np.einsum("ij,ij->i", area_vectors(piece.V, piece.F), piece.V[piece.F].mean(1)) > 0
    assert np.array_equal(piece.texture.outer, outward)
    there = expected(surface, piece.V[piece.F[outward]])[..., :2]
    np.testing.assert_allclose(piece.texture.rgb[outward][..., :2], there, atol=0.01)
    np.testing.assert_allclose(piece.texture.rgb[~outward], np.broadcast_to(TINTS, ((~outward).sum(), 3, 3)))


def test_files_show_it_where_it_was(dressed, tmp_path):
    surface, piece = dressed
    write_glb(tmp_path / "a.glb", [piece])
    mesh = trimesh.load(tmp_path / "a.glb", force="mesh", process=False)
    if hasattr(mesh.visual, "to_color"):
        mesh.visual = mesh.visual.to_color()
    V, rgb = np.asarray(mesh.vertices) * 1000, mesh.visual.vertex_colors[:, :3] / 255
    outside = np.linalg.norm(V, axis=1) > np.linalg.norm(surface.V, axis=1).min() - 0.1
    np.testing.assert_allclose(rgb[outside][:, :2], expected(surface, V[outside])[:, :2], atol=0.03)
    np.testing.assert_allclose(rgb[~outside], np.broadcast_to(TINTS, ((~outside).sum(), 3)), atol=0.01)


def test_ply_carries_colours_by_vertex(dressed, tmp_path):
    surface, piece = dressed
    write_ply(tmp_path / "a.ply", piece)
    mesh = trimesh.load(tmp_path / "a.ply", process=False)
    assert np.array_equal(mesh.faces, piece.F)
    n = len(surface.V)
    rgb = mesh.visual.vertex_colors[:, :3] / 255
    np.testing.assert_allclose(rgb[:n, :2], expected(surface, surface.V)[:, :2], atol=0.02)
    np.testing.assert_allclose(rgb, colour_of_vertex(piece.F, piece.texture), atol=0.01)


@pytest.mark.parametrize(
    ("name", "write"), [("a.obj", write_obj), ("a.glb", write_glb), ("a.3mf", write_3mf)]
)
def test_a_dressed_piece_is_read_back_as_the_solid_it_is(dressed, tmp_path, name, write):
    _, piece = dressed
    write(tmp_path / name, [piece])
    (_, V, F), *more = read_pieces(tmp_path / name)
    assert not more
    assert (len(V), len(F)) == (len(piece.V), len(piece.F))
    assert np.abs(np.sort(V, axis=0) - np.sort(piece.V, axis=0)).max() < 1e-3


def test_colours_do_not_bleed_between_islands_of_the_picture():
    surface, _, to_source, solid = ball("texture")
    V, F = surface.V, surface.F
    right = V[F].mean(1)[:, 0] > 0
    uv = np.vstack([np.full((len(V), 2), 0.25), np.full((len(V), 2), 0.75)])  # one colour an island
    image = Image.new("RGB", (4, 4), (255, 0, 0))
    image.paste((0, 0, 255), (2, 0, 4, 2))
    source = trimesh.Trimesh(
        np.vstack([V, V]) / 10 + 5,
        F + right[:, None] * len(V),
        visual=trimesh.visual.TextureVisuals(uv=uv, image=image),
        process=False,
    )
    texture = textures([solid], TINTS, surface, from_trimesh(source), to_source, (-0.5, 0.5))[0]
    shown = texture.rgb[: len(F)]
    assert np.array_equal(shown[..., 2] == 1, np.repeat(right[:, None], 3, 1))


def test_a_plain_mesh_has_no_coat():
    surface, _, to_source, solid = ball("colours")
    source = Source(surface.V, surface.F)
    assert textures([solid], TINTS, surface, source, to_source, (-0.5, 0.5)) is None
