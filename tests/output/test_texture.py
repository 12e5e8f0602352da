"""A scan's picture stays where it was, and only on the outside."""

import numpy as np
import pytest
import trimesh
from PIL import Image

from meshjig.mesh.measure import area_vectors
from meshjig.mesh.mesh import Mesh
from meshjig.output.files.glb import write_glb
from meshjig.output.files.mesh_files import write_obj, write_ply
from meshjig.output.files.read_pieces import read_pieces
from meshjig.output.files.threemf import write_3mf
from meshjig.output.piece import Piece
from meshjig.output.texture import Texture, carried, colour_of_vertex, textures
from meshjig.scan.files.attachments import PictureReader
from meshjig.scan.files.from_trimesh import from_trimesh
from meshjig.scan.files.gltf import read_gltf
from meshjig.scan.source import Look, Source
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
    if piece.texture.picture is None:  # trimesh drops colours of vertices beside a material
        source, _ = read_gltf(tmp_path / "a.glb", PictureReader())
        V, rgb = 1000 * source.vertices[source.faces].reshape(-1, 3), source.look.rgb.reshape(-1, 3) / 255
    else:
        mesh = trimesh.load(tmp_path / "a.glb", force="mesh", process=False)
        V, rgb = np.asarray(mesh.vertices) * 1000, mesh.visual.to_color().vertex_colors[:, :3] / 255
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


def test_colours_of_faces_stay_apart_though_vertices_are_shared():
    surface, _, to_source, solid = ball("colours")
    V, F = surface.V, surface.F
    upper = V[F].mean(1)[:, 2] > 0
    rgb = np.where(upper[:, None, None], [255, 0, 0], [0, 0, 255]).astype(np.uint8)
    source = Source(V / 10 + 5, F, Look(np.broadcast_to(rgb, (len(F), 3, 3)).copy()))
    texture = textures([solid], TINTS, surface, source, to_source, (-0.5, 0.5))[0]
    np.testing.assert_allclose(texture.rgb[: len(F)], source.look.rgb / 255, atol=1e-9)


def test_seams_of_a_picture_stay_apart_though_vertices_are_shared():
    surface, _, to_source, solid = ball("colours")
    V, F = surface.V, surface.F
    right = V[F].mean(1)[:, 0] > 0
    uv = np.where(right[:, None, None], 0.75, 0.25) + np.zeros((len(F), 3, 2))
    pixels = np.zeros((4, 4, 3), np.uint8)
    pixels[:2, 2:] = (0, 0, 255)
    pixels[2:, :2] = (255, 0, 0)
    source = Source(V / 10 + 5, F, Look(uv=uv, picture=pixels))
    texture = textures([solid], TINTS, surface, source, to_source, (-0.5, 0.5))[0]
    assert np.array_equal(texture.rgb[: len(F), :, 2] == 1, np.repeat(right[:, None], 3, 1))
    assert np.ptp(texture.uv[: len(F)], axis=1).max() < 1e-9


def test_a_picture_that_repeats_is_not_smeared_where_it_begins_again():
    surface, _, to_source, solid = ball("colours")
    V, F = surface.V, surface.F
    across = (V[F][..., 0] - V[:, 0].min()) / np.ptp(V[:, 0])
    uv = np.stack([3 * across + 0.5, np.full(across.shape, 0.5)], axis=2)
    source = Source(V / 10 + 5, F, Look(uv=uv, picture=np.zeros((16, 16, 3), np.uint8)))
    texture = textures([solid], TINTS, surface, source, to_source, (-0.5, 0.5))[0]
    found, meant = np.ptp(texture.uv[: len(F), :, 0], axis=1), np.ptp(uv[..., 0], axis=1)
    assert (found <= meant + 1e-9).all()


def test_ply_has_the_colours_of_faces_too(tmp_path):
    _, _, _, (V, F) = ball("colours")
    rgb = np.repeat(np.random.default_rng(0).integers(0, 255, (len(F), 1, 3)) / 255, 3, axis=1)
    texture = Texture(np.ones(len(F), bool), rgb)
    write_ply(tmp_path / "a.ply", Piece("a", V, F, (0, 0, 0), texture=texture))
    data = (tmp_path / "a.ply").read_bytes()
    rows = np.frombuffer(data[-16 * len(F) :], [("n", "u1"), ("F", "<i4", 3), ("rgb", "u1", 3)])
    assert (rows["F"] == F).all()
    np.testing.assert_array_equal(rows["rgb"], np.rint(255 * rgb[:, 0]))
    assert len(read_pieces(tmp_path / "a.ply")[0][2]) == len(F)


def test_a_mesh_that_lies_on_another_shows_the_same(dressed):
    _, piece = dressed
    order = np.random.default_rng(0).permutation(len(piece.F))
    turned = np.roll(piece.F[order], 1, axis=1)
    texture = carried(piece.texture, Mesh(piece.V, piece.F), Mesh(piece.V, turned))
    np.testing.assert_array_equal(texture.outer, piece.texture.outer[order])
    np.testing.assert_allclose(texture.rgb, np.roll(piece.texture.rgb[order], 1, axis=1), atol=1e-9)
    if piece.texture.uv is not None:
        np.testing.assert_allclose(texture.uv, np.roll(piece.texture.uv[order], 1, axis=1), atol=1e-9)
