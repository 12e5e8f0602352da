"""What groups of faces show is put together in the order of the faces."""

import numpy as np

from meshjig.scan.files.looks import corner_colours, together
from meshjig.scan.files.surface import surface
from meshjig.scan.source import Look


def coloured(*colours):
    return Look(np.repeat(np.array(colours, np.uint8)[:, None], 3, axis=1))


def test_colours_go_back_to_their_faces():
    look = together(
        [(np.array([2, 0]), coloured((1, 0, 0), (2, 0, 0))), (np.array([1]), coloured((3, 0, 0)))]
    )
    assert look.rgb[:, 0, 0].tolist() == [2, 3, 1]
    assert look.picture is None


def test_a_picture_and_colours_beside_it():
    picture = np.full((4, 4, 3), (9, 8, 7), np.uint8)
    placed = Look(uv=np.full((1, 3, 2), 0.5), picture=picture)
    look = together([(np.array([1]), placed), (np.array([0]), coloured((255, 0, 0)))])
    height, width = look.picture.shape[:2]
    x, y = (look.uv.mean(axis=1) * (1, -1) + (0, 1)).T * [[width], [height]]
    assert look.picture[y.astype(int), x.astype(int)].tolist() == [[255, 0, 0], [9, 8, 7]]


def test_no_groups_show_nothing():
    assert together([]) == Look()


def test_colours_of_polygons_come_first_unless_they_say_nothing():
    V = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], float)
    made = surface(V, np.array([0, 1, 2, 0, 2, 3]), np.array([3, 3]))
    several = np.arange(12, dtype=np.uint8).reshape(4, 3)
    own, white = several[:2] + 100, np.full((2, 3), 255, np.uint8)
    assert corner_colours(made, own, several).tolist() == np.repeat(own[:, None], 3, axis=1).tolist()
    assert corner_colours(made, white, several).tolist() == several[made.F].tolist()
    assert corner_colours(made, white, None).tolist() == [[[255] * 3] * 3] * 2
    assert corner_colours(made, white, several[:1].repeat(4, axis=0)).tolist() == [[[255] * 3] * 3] * 2
    assert corner_colours(made, None, None) is None
