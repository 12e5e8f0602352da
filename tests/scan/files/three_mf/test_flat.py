"""Triangles that name a corner twice are left out with a note, and the rest is read."""

import numpy as np

from meshjig.scan.files.attachments import PictureReader
from meshjig.scan.files.three_mf import read_3mf_source
from tests.scan.files.three_mf.build import FACES, TETRAHEDRON, mesh, model, package


def test_the_rest_is_read_with_its_colours(tmp_path):
    colours = '<m:colorgroup id="5"><m:color color="#FF0000"/><m:color color="#00FF00"/></m:colorgroup>'
    faces = [[0, 1, 1], *FACES, [2, 3, 2]]
    words = ['pid="5" p1="1"', *['pid="5" p1="0"'] * 4, 'pid="5" p1="1"']
    path = package(tmp_path / "a.3mf", model(colours + mesh(1, faces=faces, properties=words)))
    source, [note] = read_3mf_source(path, PictureReader())
    np.testing.assert_array_equal(source.vertices, TETRAHEDRON)
    np.testing.assert_array_equal(source.faces, FACES)
    assert source.look.describe() == "one colour: #ff0000"
    assert note == "left out: 2 triangles with a corner twice, without any area"
