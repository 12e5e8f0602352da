"""Polygons that can't be one are counted, and the rest stays what it was."""

import numpy as np

from meshjig.scan.files.surface import levels, surface

V = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (np.nan, 0, 0)], float)


def test_what_is_no_polygon_is_left_out():
    lists = [[0, 1, 2], [0, 1], [0, 1, 9], [0, -1, 2], [0, 1, 2, 3], [0, 1, 4], []]
    made = surface(V, np.array([k for polygon in lists for k in polygon]), np.array([len(x) for x in lists]))
    assert made.F.tolist() == [[0, 1, 2], [0, 1, 2], [2, 3, 0]]
    assert made.polygon.tolist() == [0, 4, 4]
    assert made.corner.tolist() == [[0, 1, 2], [11, 12, 13], [13, 14, 11]]
    assert made.found == 2


def test_nothing_gives_nothing():
    made = surface(np.zeros((0, 3)), np.zeros(0, np.int64), np.zeros(0, np.int64))
    assert made.F.shape == (0, 3)
    assert made.found == 0


def test_colours_are_bytes_or_shares():
    assert levels(np.array([[0, 0.5, 1.0]])).tolist() == [[0, 128, 255]]
    assert levels(np.array([[0, 1, 128.0], [300, -5, 1]])).tolist() == [[0, 1, 128], [255, 0, 1]]
    assert levels(np.array([[0, 1, 1.0]]), whole=True).tolist() == [[0, 1, 1]]
    assert levels(np.array([[0, np.nan, 1.0]])).tolist() == [[0, 255, 255]]
