"""Polygons in space become triangles that cover them once."""

import numpy as np
import pytest

from meshjig.mesh.measure import area_vectors
from meshjig.mesh.polygons import newell_normals, triangulate_polygons

LETTER = [(0, 0), (50, 0), (50, 12), (14, 12), (14, 29), (40, 29), (40, 41), (14, 41), (14, 58), (50, 58)]
LETTER += [(50, 70), (0, 70)]
COMB = [(x, y) for k in range(30) for x, y in ((2 * k, 10 + k % 3), (2 * k + 1, 1))] + [(60, 0), (0, 0)]
STRAIGHT = [(0, 0), (1, 0), (2, 0), (3, 0), (3, 3), (0, 3), (0, 1.5)]
KEYHOLE = [(0, 0), (9, 0), (9, 9), (0, 9), (0, 0), (3, 3), (3, 6), (6, 6), (6, 3), (3, 3)]
TURNS = [np.eye(3), np.linalg.qr(np.random.default_rng(3).normal(size=(3, 3)))[0], np.eye(3)[[2, 0, 1]]]


def in_space(outline, turn, back=False):
    P = np.array(outline, float)[:: -1 if back else 1]
    return np.column_stack([P, np.full(len(P), 5.0)]) @ turn.T + [1e3, -200, 30]


def areas(V, corners, sizes):
    """Signed areas of the triangles along the normals of their polygons, and those of the polygons."""
    found = triangulate_polygons(V, corners, sizes)
    normal = newell_normals(V[corners], sizes)
    length = np.linalg.norm(normal, axis=1)
    across = area_vectors(V, corners[found.corner])
    signed = np.einsum("ij,ij->i", across, (normal / length[:, None])[found.polygon]) / 2
    return found, signed, length / 2


@pytest.mark.parametrize("turn", TURNS)
@pytest.mark.parametrize("back", [False, True])
def test_each_polygon_is_covered_once_and_keeps_its_corners(turn, back):
    outlines = [LETTER, [(0, 0), (4, 0), (0, 3)], STRAIGHT, COMB[::-1], LETTER[:4], KEYHOLE]
    V = np.concatenate([in_space(outline, turn, back) for outline in outlines])
    sizes = np.array([len(outline) for outline in outlines])
    found, signed, whole = areas(V, np.arange(len(V)), sizes)
    assert (signed > 0).all()
    np.testing.assert_allclose(np.bincount(found.polygon, signed), whole, rtol=1e-9)
    assert np.unique(found.corner).tolist() == list(range(len(V)))
    assert np.bincount(found.polygon).tolist() == (sizes - 2).tolist()


@pytest.mark.parametrize("start", range(4))
def test_a_quadrilateral_is_split_inside(start):
    arrow = np.roll([(0, 0), (4, 4), (0, 1), (-4, 4)], start, axis=0)
    _, signed, whole = areas(in_space(arrow, np.eye(3)), np.arange(4), np.array([4]))
    assert (signed > 0).all()
    assert signed.sum() == pytest.approx(whole[0])


def test_triangles_and_convex_quadrilaterals_are_split_as_ever():
    V = in_space([(0, 0), (3, 0), (3, 3), (0, 3)], np.eye(3))
    found = triangulate_polygons(V, np.array([0, 1, 2, 0, 1, 2, 3, 1, 0]), np.array([3, 4, 2]))
    assert found.corner.tolist() == [[0, 1, 2], [3, 4, 5], [5, 6, 3]]
    assert found.polygon.tolist() == [0, 1, 1]


def test_a_polygon_that_crosses_itself_or_has_no_area_is_split_somehow():
    star = [(np.cos(k * 0.8 * np.pi), np.sin(k * 0.8 * np.pi)) for k in range(5)]
    for outline in (
        star,
        [(0, 0)] * 6,
        [(0, 0), (1, 0), (2, 0), (3, 0), (4, 0)],
        [(0, 0), (0, 0), *LETTER[1:]],
    ):
        corner = triangulate_polygons(
            in_space(outline, np.eye(3)), np.arange(len(outline)), np.array([len(outline)])
        ).corner
        assert len(corner)
        assert ((corner >= 0) & (corner < len(outline))).all()
