"""Colours, materials, mixtures and textures of 3MF triangles arrive at the right corners."""

import io

import numpy as np
import pytest
from PIL import Image

from meshjig.scan.files.attachments import PictureReader
from meshjig.scan.files.three_mf import read_3mf_source
from tests.scan.files.three_mf.build import TETRAHEDRON, TEXTURE, mesh, model, package

RED, GREEN, BLUE, WHITE = [255, 0, 0], [0, 255, 0], [0, 0, 255], [255, 255, 255]
COLOURS = (
    '<m:colorgroup id="5"><m:color color="#FF0000"/><m:color color="#00FF00"/><m:color color="#0000FF80"/>'
    "</m:colorgroup>"
)
MATERIALS = (
    '<basematerials id="6"><base name="a" displaycolor="#00FF00"/><base name="b" displaycolor="#0000FF"/>'
    "</basematerials>"
)
PIXELS = np.random.default_rng(0).integers(0, 255, (8, 8, 3), np.uint8)
PLACES = np.array([[0.1, 0.1], [0.4, 0.1], [0.1, 0.9], [0.6, 0.3]])


def read(path, text, **more):
    return read_3mf_source(package(path / "a.3mf", text, **more), PictureReader())


def texture(style="wrap", places=PLACES):
    rows = "".join('<m:tex2coord u="{}" v="{}"/>'.format(*place) for place in places.tolist())
    return (
        '<m:texture2d id="7" path="/3D/Textures/skin.png" contenttype="image/png"'
        f' tilestyleu="{style}" tilestylev="{style}"/>'
        f'<m:texture2dgroup id="8" texid="7">{rows}</m:texture2dgroup>'
    )


def with_picture(data=None):
    if data is None:
        buffer = io.BytesIO()
        Image.fromarray(PIXELS).save(buffer, "PNG")
        data = buffer.getvalue()
    return {"files": {"3D/Textures/skin.png": data}, "links": [("3D/Textures/skin.png", TEXTURE)]}


def shown(look):
    """What the corners have in the picture, (m, 3, 3)."""
    height, width = look.picture.shape[:2]
    x, y = np.moveaxis(look.uv * (1, -1) + (0, 1), -1, 0)
    return look.picture[(y * height).astype(int), (x * width).astype(int)]


def at(places):
    """What the picture of these tests has there; v is upward."""
    return PIXELS[((1 - places[..., 1]) * 8).astype(int), (places[..., 0] * 8).astype(int)]


def test_triangles_and_corners_have_the_colours_of_a_group(tmp_path):
    words = ['pid="5" p1="1"', 'pid="5" p1="0" p2="1" p3="2"', "", 'pid="6" p1="1"']
    text = model(COLOURS + MATERIALS + mesh(1, more='pid="5" pindex="2"', properties=words))
    source, notes = read(tmp_path, text)
    expected = [[GREEN] * 3, [RED, GREEN, BLUE], [BLUE] * 3, [BLUE] * 3]
    assert source.look.rgb.tolist() == expected
    assert notes == []


def test_an_object_may_have_one_material(tmp_path):
    source, _ = read(tmp_path, model(MATERIALS + mesh(1, more='pid="6" pindex="1"')))
    assert source.look.describe() == "one colour: #0000ff"


def test_mixtures_of_materials_have_mixed_colours(tmp_path):
    mixed = (
        '<m:compositematerials id="9" matid="6" matindices="0 1"><m:composite values="0.2 0.8"/>'
        "</m:compositematerials>"
    )
    source, _ = read(tmp_path, model(MATERIALS + mixed + mesh(1, more='pid="9" pindex="0"')))
    assert source.look.rgb[0, 0].tolist() == [0, 51, 204]


def test_a_texture_is_where_it_was_and_a_part_beside_it_keeps_its_colour(tmp_path):
    words = ['pid="8" p1="0" p2="2" p3="1"', 'pid="8" p1="0" p2="1" p3="3"', 'pid="5" p1="0"', ""]
    text = model(COLOURS + texture() + mesh(1, properties=words))
    source, notes = read(tmp_path, text, **with_picture())
    found = shown(source.look)
    np.testing.assert_array_equal(found[:2], at(PLACES[[[0, 2, 1], [0, 1, 3]]]))
    assert found[2:].tolist() == [[RED] * 3, [WHITE] * 3]
    assert notes == []
    assert len(source.vertices) == len(TETRAHEDRON)


@pytest.mark.parametrize("style", ["clamp", "mirror", "wrap"])
def test_places_beyond_the_picture(tmp_path, style):
    beyond = PLACES + np.array([1, 0])
    text = model(texture(style, beyond) + mesh(1, properties=['pid="8" p1="0" p2="2" p3="1"', "", "", ""]))
    look = read(tmp_path, text, **with_picture())[0].look
    places = PLACES[[0, 2, 1]].copy()
    if style == "clamp":
        places[:, 0] = 0.999
    elif style == "mirror":
        places[:, 0] = 1 - places[:, 0]
    np.testing.assert_allclose(shown(look)[0], at(places), atol=0)


def test_the_texture_above_a_material_is_shown(tmp_path):
    layers = (
        '<m:multiproperties id="9" pids="6 8"><m:multi pindices="0 1"/><m:multi pindices="0 2"/>'
        '<m:multi pindices="1 3"/></m:multiproperties>'
    )
    words = ['pid="9" p1="0" p2="1" p3="2"'] * 4
    text = model(MATERIALS + texture() + layers + mesh(1, properties=words))
    source, notes = read(tmp_path, text, **with_picture())
    np.testing.assert_array_equal(shown(source.look)[0], at(PLACES[[1, 2, 3]]))
    assert notes == []


def test_a_damaged_picture_is_named_and_the_mesh_read(tmp_path):
    words = ['pid="8" p1="0"'] * 4
    text = model(texture() + mesh(1, properties=words))
    source, [note] = read(tmp_path, text, **with_picture(b"no picture"))
    assert len(source.faces) == 4
    assert "skin.png is damaged" in note
