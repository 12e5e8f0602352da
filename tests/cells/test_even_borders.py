"""Jagged borders come out smooth; cells stay discs, and all that is not asked for stays."""

import numpy as np
import pytest

from meshjig.cells.discs import DISC, shapes
from meshjig.cells.even_borders import Line, even_borders
from meshjig.mesh.halfedges import edges, next_halfedge
from meshjig.mesh.measure import face_areas, interpolate
from meshjig.mesh.types import Mesh
from tests.cut.graphs import delaunay, flat_sheet, wavy

SIDE = 100.0


def scattered(n=1800, seed=1):
    p = np.random.default_rng(seed).uniform(0, SIDE, (n, 2))
    rim = np.linspace(0, SIDE, 40)
    edge = [
        np.stack(x, 1) for x in ((rim, 0 * rim), (rim, 0 * rim + SIDE), (0 * rim, rim), (0 * rim + SIDE, rim))
    ]
    p = np.unique(np.concatenate([p, *edge]), axis=0)
    F = delaunay(p)
    return p, F[face_areas(p, F) > 1e-6]


def three_cells(p, F):
    """Label faces by a curve through the middle; the right side is halved."""
    x, y = p[F].mean(1).T
    right = x > 50 + 8 * np.sin(y / 16)
    return np.where(right, 1 + (y > 50), 0)


def line_between(F, cell, a, b):
    """Follow the border from cell a, on its left, to cell b."""
    e = edges(F)
    h = np.arange(len(e.twin))
    run = h[(e.twin != h) & (cell[h // 3] == a) & (cell[e.twin // 3] == b)]
    after = dict(zip(F.ravel()[run].tolist(), F.ravel()[next_halfedge(run)].tolist(), strict=True))
    (at,) = after.keys() - set(after.values())
    way = [at]
    while at in after:
        at = after[at]
        way.append(at)
    return Line(np.array(way), a, b)


def border(made, a, b):
    e = edges(made.F)
    h = np.flatnonzero(e.twin > np.arange(len(e.twin)))
    pair = np.sort(np.stack([made.cell[h // 3], made.cell[e.twin[h] // 3]], 1), axis=1)
    return e.E[e.edge_of_halfedge[h[(pair == [a, b]).all(1)]]]


def length(V, E):
    return np.linalg.norm(V[E[:, 0]] - V[E[:, 1]], axis=1).sum()


@pytest.mark.parametrize("seed", [1, 2, 3, 4])
def test_a_jagged_border_is_drawn_as_the_curve_that_it_stands_for(seed):
    p, F = scattered(seed=seed)
    V, cell = wavy(p), three_cells(p, F)
    lines = [line_between(F, cell, 0, 1), line_between(F, cell, 0, 2)]
    before = (
        border(even_borders(Mesh(V, F), cell, []), 0, 1),
        border(even_borders(Mesh(V, F), cell, []), 1, 2),
    )
    made = even_borders(Mesh(V, F), cell, lines)
    y = np.linspace(0, 50, 1000)
    curve = wavy(np.stack([50 + 8 * np.sin(y / 16), y], 1))
    smooth = np.linalg.norm(np.diff(curve, axis=0), axis=1).sum()
    assert length(V, before[0]) > 1.08 * smooth
    assert length(made.V, border(made, 0, 1)) - smooth < 0.4 * (length(V, before[0]) - smooth)
    was = shapes(Mesh(p, F), cell, 3) == DISC
    assert (shapes(made.mesh, made.cell, 3) == DISC)[was].all()

    # the surface is the same, cut finer, and nothing but the border has moved
    area = np.bincount(made.parent, face_areas(made.V, made.F), len(F))
    np.testing.assert_allclose(area, face_areas(V, F), rtol=1e-9)
    np.testing.assert_allclose(interpolate(V, F, made.vertex_face, made.vertex_bary), made.V, atol=1e-9)
    same = np.unique(before[1]), np.unique(border(made, 1, 2))
    np.testing.assert_array_equal(*same)
    far = np.abs(p[F[made.parent]].mean(1)[:, 0] - 50 - 8 * np.sin(p[F[made.parent]].mean(1)[:, 1] / 16)) > 9
    np.testing.assert_array_equal(made.cell[far], cell[made.parent[far]])
    ends = np.concatenate([line.vertex[[0, -1]] for line in lines])
    assert np.isin(ends, np.concatenate([border(made, 0, 1).ravel(), border(made, 0, 2).ravel()])).all()


def test_a_straight_border_stays_as_it_is():
    p, F = flat_sheet(20)
    V, cell = wavy(p), (p[F].mean(1)[:, 0] > 50).astype(np.int64)
    made = even_borders(Mesh(V, F), cell, [line_between(F, cell, 0, 1)])
    np.testing.assert_array_equal(made.V, V)
    assert sorted(map(tuple, made.F.tolist())) == sorted(map(tuple, F.tolist()))
    np.testing.assert_array_equal(made.cell, cell[made.parent])


def test_a_line_with_other_borders_close_by_breaks_no_cell():
    p, F = scattered(3000)
    x = p[F].mean(1)[:, 0]
    stripe = np.clip((x - 42) // 5, 0, 3).astype(np.int64)  # two stripes two faces wide
    lines = [line_between(F, stripe, k, k + 1) for k in range(3) if _whole(p, F, stripe, k)]
    made = even_borders(Mesh(wavy(p), F), stripe, lines)
    before = shapes(Mesh(p, F), stripe, 4)
    after = shapes(made.mesh, made.cell, 4)
    assert lines
    assert (after[before == DISC] == DISC).all()


def _whole(p, F, cell, k):
    return (shapes(Mesh(p, F), cell, 4)[[k, k + 1]] == DISC).all()
