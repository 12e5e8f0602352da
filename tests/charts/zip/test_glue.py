import numpy as np
import pytest

from meshjig.charts.cuts import cut_open
from meshjig.charts.zip.glue import fits, glue
from meshjig.mesh.halfedges import edges
from tests.charts.helpers import all_turn_left, half_tube
from tests.meshes import half_sphere

SHAPE = np.exp(1j * np.linspace(0, 2, 200)) * 30  # an arc of 60 mm
LENGTH = np.full(200, 60 / 200)


def worthiest(first, second, least=5.0):
    return max(fits(first, second, LENGTH, least), key=lambda fit: fit.worth)


@pytest.mark.parametrize("angle", [0.0, 1.0, 3.0])
def test_a_moved_curve_is_moved_back_as_a_whole(angle):
    moved = SHAPE * np.exp(1j * angle) + 7 - 3j
    fit = worthiest(SHAPE, moved)
    assert (fit.begin, fit.end) == (0, 200)
    assert fit.worth == pytest.approx(60)
    np.testing.assert_allclose(moved * fit.turn + fit.shift, SHAPE, atol=1e-9)


def test_where_curves_part_the_part_that_fits_is_worth_most():
    other = SHAPE.copy()
    other[100:] += 1j * np.linspace(0, 40, 100)
    fit = worthiest(SHAPE, other)
    assert fit.end <= 110
    assert fit.worth > 20


def test_a_mirrored_curve_hardly_fits():
    assert worthiest(SHAPE, SHAPE.conj()).worth < 0.6 * worthiest(SHAPE, SHAPE).worth


def test_no_stretch_is_shorter_than_asked():
    found = fits(SHAPE, SHAPE, LENGTH, 20.0)
    assert found
    assert min((fit.end - fit.begin) * LENGTH[0] for fit in found) >= 20 - 2 * LENGTH[0]
    assert not fits(SHAPE, SHAPE, LENGTH, 61.0)


def unrolled(V):
    """Lay the half tube of helpers in the plane."""
    return np.arctan2(V[:, 1], V[:, 0]) * 20.0 + 1j * V[:, 2]


def cut_across(F, in_first):
    e = edges(F)
    cut = np.zeros(len(e.E), bool)
    h = np.arange(3 * len(F))
    cut[e.edge_of_halfedge[h[in_first[h // 3] != in_first[e.twin // 3]]]] = True
    return e, cut


@pytest.mark.parametrize("gap", [0.0, 0.4, 2.0])
def test_two_parts_of_a_tube_become_the_unrolled_tube(gap):
    V, F = half_tube()
    below = V[F].mean(1)[:, 2] < 30
    e, cut = cut_across(F, below)
    place = unrolled(V)[F] + 1j * gap * ~below[:, None]
    made, effort = glue(V, F, cut_open(F, e, cut)[0], F, place, 0.97)
    assert made is not None
    uv, corners = made
    assert effort <= 1.2 * len(F)
    assert len(uv) == len(V)
    assert all_turn_left(uv, corners)
    longest = np.ptp(uv[:, 1])
    assert longest == pytest.approx(60, abs=0.75 * gap + 0.1)  # a closed gap is shared by all


def test_a_ring_is_no_chart():
    V, F = half_tube()
    V = V[:, [0, 2, 1]] * [1, 1, -1]
    n = 24
    seam = np.arange(n + 1), n * (n + 1) + np.arange(n + 1)  # the two straight sides
    closed = F.copy()
    for a, b in zip(*seam, strict=True):
        closed[closed == b] = a
    made, _ = glue(V, F, F, closed, unrolled(half_tube()[0])[F], 0.5)
    assert made is None


def test_what_would_stretch_too_much_is_refused():
    V, F = half_sphere(1500)
    east = V[F].mean(1)[:, 0] > 0
    e, cut = cut_across(F, east)
    flat = V[:, 0] + 1j * V[:, 1]
    place = flat[F] * np.where(east[:, None], 1, np.exp(0.8j))  # a wedge of 46 degrees between the halves
    assert glue(V, F, cut_open(F, e, cut)[0], F, place, 0.985)[0] is None
