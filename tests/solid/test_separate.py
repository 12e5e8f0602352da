"""Pieces that touch or overlap give way."""

import numpy as np
import trimesh

from meshjig.mesh.booleans import body
from meshjig.mesh.measure import mesh_volume
from meshjig.mesh.mesh import Mesh
from meshjig.solid.separate import separate


def box(size: tuple[float, float, float], at: tuple[float, float, float]) -> Mesh:
    made = trimesh.creation.box(size).subdivide().subdivide()
    return Mesh(np.asarray(made.vertices, float) + at, np.asarray(made.faces, np.int64))


def test_the_larger_of_two_that_touch_gives_way() -> None:
    pieces = {0: box((4, 4, 4), (0, 0, 0)), 1: box((2, 2, 2), (3, 0, 0))}
    changed = separate(pieces, np.array([[0, 1]]), 0.2)
    assert list(changed) == [0]
    gap = body(*changed[0]).min_gap(body(*pieces[1]), 1.0)
    assert 0.195 <= gap <= 0.27
    assert 60 < mesh_volume(*changed[0]) < 64


def test_what_overlaps_is_taken_from_the_larger() -> None:
    pieces = {3: box((4, 4, 4), (0, 0, 0)), 7: box((2, 2, 2), (2.8, 0, 0))}
    changed = separate(pieces, np.array([[3, 7]]), 0.2)
    assert list(changed) == [3]
    assert body(*changed[3]).min_gap(body(*pieces[7]), 1.0) >= 0.19


def test_pieces_that_keep_the_gap_stay_as_they_are() -> None:
    pieces = {0: box((4, 4, 4), (0, 0, 0)), 1: box((2, 2, 2), (3.2, 0, 0))}
    assert not separate(pieces, np.array([[0, 1]]), 0.2)
