"""Colours and pictures of glTF parts arrive, each where it was."""

import numpy as np
import pytest

from meshjig.scan.files.attachments import PictureReader
from meshjig.scan.files.gltf import read_gltf
from tests.scan.files.gltf.build import TETRAHEDRON, Build

PIXELS = np.random.default_rng(0).integers(0, 255, (8, 8, 3), np.uint8)
UV = np.array([[0.1, 0.1], [0.4, 0.1], [0.1, 0.9], [0.6, 0.3]], "f4")  # v downward
LINEAR = np.array([[1, 0.2, 0], [0, 0.5, 1], [0.05, 1, 1], [0, 0, 0.8]])


def read(build, tmp_path):
    return read_gltf(build.glb(tmp_path / "a.glb"), PictureReader())


def screen(linear):
    c = np.asarray(linear, float)
    return np.rint(255 * np.where(c <= 0.0031308, 12.92 * c, 1.055 * c ** (1 / 2.4) - 0.055))


def seen(look, at):
    """What the picture has at places (m, 3, 2), v downward, of corners."""
    height, width = look.picture.shape[:2]
    x, y = np.moveaxis(look.uv * (1, -1) + (0, 1), -1, 0)
    here = look.picture[(y * height).astype(int), (x * width).astype(int)]
    expected = PIXELS[(at[..., 1] * 8).astype(int), (at[..., 0] * 8).astype(int)]
    return np.abs(here.astype(int) - expected).max()


@pytest.mark.parametrize("kind", ["f4", "u1", "u2"])
@pytest.mark.parametrize("width", [3, 4])
def test_colours_at_vertices_are_linear_and_kept_beside_a_material(tmp_path, kind, width):
    build = Build()
    full = 1 if kind == "f4" else np.iinfo(kind).max
    values = np.hstack([LINEAR, np.full((4, 1), 0.5)])[:, :width] * full
    values = values.astype("f4") if kind == "f4" else np.rint(values).astype(kind)
    colour = build.array(values, normalized=kind != "f4")
    plain = build.material(metallicFactor=0)
    source, notes = read(build.scene(build.part(more={"material": plain}, COLOR_0=colour)), tmp_path)
    np.testing.assert_allclose(source.look.rgb, screen(LINEAR)[source.faces], atol=4 if kind == "u1" else 1)
    assert notes == []


def test_the_base_colour_multiplies_those_at_vertices(tmp_path):
    build = Build()
    colour = build.array(LINEAR.astype("f4"))
    half = build.material(baseColorFactor=[0.5, 1, 0.25, 1])
    source, _ = read(build.scene(build.part(more={"material": half}, COLOR_0=colour)), tmp_path)
    np.testing.assert_allclose(source.look.rgb, screen(LINEAR * (0.5, 1, 0.25))[source.faces], atol=1)


def test_a_base_colour_alone_is_one_colour(tmp_path):
    build = Build()
    red = build.material(baseColorFactor=[1, 0, 0, 1])
    source, _ = read(build.scene(build.part(more={"material": red})), tmp_path)
    assert source.look.describe() == "one colour: #ff0000"


def test_programs_that_write_what_a_screen_shows_are_believed(tmp_path):
    import trimesh

    mesh = trimesh.creation.box()
    mesh.visual.vertex_colors = np.tile([200, 100, 50, 255], (8, 1))
    mesh.visual.vertex_colors[0] = (10, 20, 30, 255)
    (tmp_path / "t.glb").write_bytes(trimesh.Scene(mesh).export(file_type="glb"))
    source, _ = read_gltf(tmp_path / "t.glb", PictureReader())
    found = np.unique(source.look.rgb.reshape(-1, 3), axis=0)
    assert found.tolist() == [[10, 20, 30], [200, 100, 50]]


def test_a_texture_is_kept_beside_parts_without(tmp_path):
    build = Build()
    shown = build.texture(PIXELS)
    green = build.material(baseColorFactor=[0, 1, 0, 1])
    uv = build.array(UV)
    build.scene(
        build.part(more={"material": shown}, TEXCOORD_0=uv),
        build.part(V=TETRAHEDRON + 2),
        build.part(V=TETRAHEDRON + 4, more={"material": green}),
    )
    source, notes = read(build, tmp_path)
    look = source.look
    height, width = look.picture.shape[:2]
    x, y = np.moveaxis(look.uv * (1, -1) + (0, 1), -1, 0)
    here = look.picture[(y * height).astype(int), (x * width).astype(int)]
    at = UV[source.faces[:4]]
    np.testing.assert_array_equal(
        here[:4], PIXELS[(at[..., 1] * 8).astype(int), (at[..., 0] * 8).astype(int)]
    )
    assert (here[4:8] == 255).all()
    assert (here[8:] == (0, 255, 0)).all()
    assert notes == []


def test_the_set_of_places_that_a_texture_names_is_used(tmp_path):
    build = Build()
    shown = build.texture(PIXELS, texCoord=1)
    part = build.part(
        more={"material": shown}, TEXCOORD_0=build.array(np.zeros((4, 2), "f4")), TEXCOORD_1=build.array(UV)
    )
    source, _ = read(build.scene(part), tmp_path)
    assert seen(source.look, UV[source.faces]) == 0


def test_a_texture_may_be_moved_turned_and_scaled(tmp_path):
    """A quarter turn of half the picture, as the extension's own text has it: the lower left quarter."""
    build = Build()
    moved = {"offset": [0, 1], "rotation": np.pi / 2, "scale": [0.5, 0.5]}
    shown = build.texture(PIXELS, extensions={"KHR_texture_transform": moved})
    part = build.part(more={"material": shown}, TEXCOORD_0=build.array(UV))
    source, _ = read(build.scene(part), tmp_path)
    at = np.stack([UV[:, 1] / 2, 1 - UV[:, 0] / 2], axis=1)
    assert seen(source.look, at[source.faces]) == 0


def test_a_texture_is_multiplied_by_the_base_colour(tmp_path):
    build = Build()
    shown = build.texture(PIXELS)
    build.header["materials"][shown]["pbrMetallicRoughness"]["baseColorFactor"] = [1, 0, 1, 1]
    source, _ = read(build.scene(build.part(more={"material": shown}, TEXCOORD_0=build.array(UV))), tmp_path)
    np.testing.assert_array_equal(source.look.picture, PIXELS * np.array([1, 0, 1], np.uint8))


def test_colours_at_vertices_show_through_a_blank_picture_and_are_named_under_another(tmp_path):
    for pixels, kept in ((np.full((4, 4, 3), 255), True), (PIXELS, False)):
        build = Build()
        shown = build.texture(pixels)
        colour, uv = build.array(LINEAR.astype("f4")), build.array(UV)
        part = build.part(more={"material": shown}, TEXCOORD_0=uv, COLOR_0=colour)
        source, notes = read(build.scene(part), tmp_path)
        if kept:
            np.testing.assert_allclose(source.look.rgb, screen(LINEAR)[source.faces], atol=1)
            assert notes == []
        else:
            assert source.look.picture is not None
            assert "colours at the vertices" in notes[0]


def test_the_diffuse_texture_of_glossy_materials_is_taken(tmp_path):
    build = Build(extensionsRequired=["KHR_materials_pbrSpecularGlossiness"])
    shown = build.texture(PIXELS)
    texture = build.header["materials"][shown].pop("pbrMetallicRoughness")["baseColorTexture"]
    build.header["materials"][shown]["extensions"] = {
        "KHR_materials_pbrSpecularGlossiness": {"diffuseTexture": texture}
    }
    part = build.part(more={"material": shown}, TEXCOORD_0=build.array(UV))
    source, _ = read(build.scene(part), tmp_path)
    assert seen(source.look, UV[source.faces]) == 0


@pytest.mark.parametrize("wrap", [33071, 33648])
def test_places_beyond_the_picture_are_clamped_or_mirrored(tmp_path, wrap):
    build = Build(samplers=[{"wrapS": wrap, "wrapT": wrap}])
    shown = build.texture(PIXELS)
    build.header["textures"][0]["sampler"] = 0
    beyond = UV.copy()
    beyond[:, 0] += 1
    part = build.part(more={"material": shown}, TEXCOORD_0=build.array(beyond))
    source, _ = read(build.scene(part), tmp_path)
    at = UV.copy()
    at[:, 0] = 0.999 if wrap == 33071 else 1 - UV[:, 0]
    source.look.uv[..., 0] = np.minimum(source.look.uv[..., 0], 0.999)
    assert seen(source.look, at[source.faces]) == 0


def test_a_texture_without_places_in_it_is_named(tmp_path):
    build = Build()
    source, [note] = read(build.scene(build.part(more={"material": build.texture(PIXELS)})), tmp_path)
    assert source.look.picture is None
    assert "does not say where" in note
