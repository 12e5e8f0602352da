"""Several meshes as one: nothing that they show is lost."""

import numpy as np

from meshjig.scan.files.join import join
from meshjig.scan.source import Look, Source

RED, GREEN, BLUE = (255, 0, 0), (0, 255, 0), (0, 0, 255)
CORNERS = np.array([[0.1, 0.1], [0.4, 0.1], [0.1, 0.4]])


def triangle(**look):
    return Source(np.eye(3), np.array([[0, 1, 2]]), Look(**look))


def coloured(*colours):
    return triangle(rgb=np.array([colours], np.uint8))


def pictured(colour, size=(6, 4), uv=CORNERS):
    return triangle(uv=uv[None], picture=np.full((size[1], size[0], 3), colour, np.uint8))


def shown(source):
    """What each face shows in its middle."""
    look = source.look
    if look.picture is None:
        return look.rgb.mean(axis=1).tolist()
    height, width = look.picture.shape[:2]
    x, y = (look.uv.mean(axis=1) * (1, -1) + (0, 1)).T * [[width], [height]]
    return look.picture[y.astype(int), x.astype(int)].tolist()


def test_vertices_and_faces_stay_in_their_order():
    source = join([triangle(), triangle(), triangle()])
    assert source.faces.tolist() == [[0, 1, 2], [3, 4, 5], [6, 7, 8]]
    assert source.look == Look()


def test_colours_are_kept_beside_parts_without():
    source = join([coloured(RED, GREEN, BLUE), triangle()])
    assert source.look.rgb.tolist() == [[list(RED), list(GREEN), list(BLUE)], [[255] * 3] * 3]


def test_a_textured_part_keeps_its_texture_beside_plain_and_coloured_ones():
    source = join([pictured(RED), triangle(), coloured(BLUE, BLUE, BLUE), pictured(GREEN, (20, 30))])
    assert shown(source) == [list(RED), [255] * 3, list(BLUE), list(GREEN)]


def test_the_pictures_that_a_mesh_came_with_are_described():
    one = join([pictured(RED, (8, 6)), triangle()])
    assert one.look.describe() == "a texture of 8 x 6 pixels"
    assert join([one, triangle()]).look.describe() == "a texture of 8 x 6 pixels"
    two = join([one, pictured(GREEN, (20, 30)), pictured(RED)])
    assert two.look.describe() == "3 textures, the largest of 20 x 30 pixels"


def test_one_picture_of_several_parts_is_kept_as_it_is():
    picture = np.zeros((4, 4, 3), np.uint8)
    parts = [triangle(uv=CORNERS[None], picture=picture), triangle(uv=CORNERS[None] + 3, picture=picture)]
    look = join(parts).look
    assert look.picture is picture
    assert look.uv.tolist() == [CORNERS.tolist(), (CORNERS + 3).tolist()]


def test_a_picture_that_repeats_is_shown_from_where_it_would_be():
    split = np.zeros((8, 8, 3), np.uint8)
    split[:, :4] = RED
    left = triangle(uv=CORNERS[None] * 0.9 + 7, picture=split)
    assert shown(join([left, pictured(GREEN)])) == [list(RED), list(GREEN)]


def test_uvs_without_a_picture_are_unknown_where_a_part_has_none():
    uv = join([triangle(uv=CORNERS[None]), triangle()]).look.uv
    assert np.isfinite(uv[0]).all()
    assert np.isnan(uv[1]).all()
