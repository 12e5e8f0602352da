import numpy as np
import pytest
import trimesh

from meshjig.solid.crossing_pairs import crossing_pairs
from meshjig.solid.cutters import cutters, round_cutters, slabs
from meshjig.solid.offsets import Strip, mitered

HALF = 0.1
HEIGHT = 2.0
CAP = 8 * np.tan(np.pi / 8) * HALF**2 / 2  # half a regular octagon around the end


def strip_of(P, down=(0.0, 0.0, -HEIGHT), ring=False):
    """A wall under a line of points (k, 3)."""
    P = np.asarray(P, float)
    Q = P + np.asarray(down)
    after = np.append(np.arange(1, len(P) - 1), 0 if ring else -1)
    return Strip(np.stack([P[:-1], Q[:-1], P[1:], Q[1:]], 1), np.zeros(len(P) - 1, bool), after)


def made(strip):
    return [(q, trimesh.Trimesh(V, F, process=False)) for q, V, F in slabs(strip, mitered(strip, HALF), HALF)]


def winding(mesh, points):
    import igl

    return igl.winding_number(mesh.vertices, mesh.faces, points)


def wall_points(strip, n=2000, seed=0):
    rng = np.random.default_rng(seed)
    c = strip.corners[rng.integers(len(strip.corners), size=n)]
    u, v = rng.random((2, n, 1))
    return (1 - u) * ((1 - v) * c[:, 0] + v * c[:, 1]) + u * ((1 - v) * c[:, 2] + v * c[:, 3])


def in_plane(angles, lengths):
    """A line that turns by some angles, in degrees."""
    a = np.cumsum(np.radians(angles))
    steps = np.asarray(lengths)[:, None] * np.stack([np.cos(a), np.sin(a), 0 * a], 1)
    return np.concatenate([np.zeros((1, 3)), np.cumsum(steps, 0)])


def test_a_straight_wall_becomes_a_box_with_round_ends():
    ((quads, slab),) = made(strip_of([[0, 0, 0], [3, 0, 0], [5, 0, 0]]))
    assert quads.tolist() == [0, 1]
    assert slab.is_watertight
    assert slab.volume == pytest.approx((5 * 2 * HALF + 2 * CAP) * HEIGHT)
    assert slab.bounds[:, 1] == pytest.approx([-HALF, HALF])


@pytest.mark.parametrize("turn", [0, 10, 30, 45])
def test_a_gentle_turn_is_mitered(turn):
    strip = strip_of(in_plane([0, turn, turn], [2.0, 2, 2]))
    ((_, slab),) = made(strip)
    assert not len(crossing_pairs(slab.vertices, slab.faces)[0])
    # what a miter adds outside it takes away inside
    assert slab.volume == pytest.approx((6 * 2 * HALF + 2 * CAP) * HEIGHT, rel=1e-3)
    for sign in (1, -1):  # across the middle of each straight part both sides are half the gap away
        a, b = strip.corners[:, 0], strip.corners[:, 2]
        n = np.cross(b - a, [0, 0, 1.0])
        middle = (a + b) / 2 + [0, 0, -1] + sign * HALF * n / np.linalg.norm(n, axis=1)[:, None]
        for shift, inside in ((-1e-3, True), (1e-3, False)):
            beside = middle + shift * sign * n / np.linalg.norm(n, axis=1)[:, None]
            assert ((winding(slab, beside) > 0.5) == inside).all()


@pytest.mark.parametrize("turn", [70, 90, 120, 170, -110])
def test_a_sharp_turn_gets_round_ends_that_reach_half_the_gap(turn):
    strip = strip_of(in_plane([0, turn], [3.0, 3]))
    bodies = made(strip)
    assert len(bodies) == 2
    a = np.linspace(0, 2 * np.pi, 60)
    ring = strip.corners[0, 2] + np.stack([np.cos(a), np.sin(a), 0 * a], 1) * 0.999 * HALF - [0, 0, 1]
    inside = np.any([winding(slab, ring) > 0.5 for _, slab in bodies], axis=0)
    assert inside.all()
    assert all(np.abs(slab.bounds).max() < 10 for _, slab in bodies)


def test_a_ring_has_no_ends():
    a = np.linspace(0, 2 * np.pi, 41)
    P = 3 * np.stack([np.cos(a), np.sin(a), 0 * a], 1)
    P[-1] = P[0]
    ((quads, slab),) = made(strip_of(P, ring=True))
    assert len(quads) == 40
    assert slab.is_watertight
    assert slab.euler_number == 0
    perimeter = 40 * 2 * 3 * np.sin(np.pi / 40)
    assert slab.volume == pytest.approx(perimeter * 2 * HALF * HEIGHT, rel=1e-3)


@pytest.mark.parametrize("seed", range(6))
def test_any_wall_is_covered_to_half_the_gap_and_hardly_more(seed):
    rng = np.random.default_rng(seed)
    n = 30
    P = in_plane(rng.normal(scale=25, size=n), rng.uniform(0.02, 1.0, n))
    Q = P + [0, 0, -HEIGHT] + 0.15 * rng.normal(size=P.shape)  # short and long quads, twisted
    strip = Strip(
        np.stack([P[:-1], Q[:-1], P[1:], Q[1:]], 1), rng.random(n) < 0.5, np.append(np.arange(1, n), -1)
    )
    bodies = [cutter for _, cutter in cutters(strip, mitered(strip, HALF), HALF)]
    assert sum(len(q) for q, _ in cutters(strip, mitered(strip, HALF), HALF)) == n
    tri = np.where(strip.rising[:, None, None], [[[0, 2, 1], [2, 3, 1]]], [[[0, 2, 3], [0, 3, 1]]])
    walls = strip.corners[np.arange(n)[:, None, None], tri].reshape(-1, 3, 3)
    rng = np.random.default_rng(seed)
    u, v = np.sort(rng.random((2, 60 * n, 1)), axis=0)
    t = walls[rng.integers(len(walls), size=60 * n)]
    on_wall = u * t[:, 0] + (v - u) * t[:, 1] + (1 - v) * t[:, 2]
    d = rng.normal(size=on_wall.shape)
    probe = on_wall + 0.95 * HALF * d / np.linalg.norm(d, axis=1)[:, None]
    probe = probe[(probe[:, 2] < -0.25) & (probe[:, 2] > 0.25 - HEIGHT)]  # its top and bottom are cut off
    inside = np.zeros(len(probe), bool)
    for cutter in bodies:
        mesh = cutter.to_mesh64()
        V, F = np.ascontiguousarray(mesh.vert_properties[:, :3]), np.array(mesh.tri_verts, np.int64)
        inside |= winding(trimesh.Trimesh(V, F, process=False), probe) > 0.5
    assert inside.mean() > 0.995


def test_a_quad_that_is_a_mere_speck_gets_a_convex_hull():
    P = [[0, 0, 0], [1e-4, 0, 0]]
    Q = [[0, 0, -HEIGHT], [0, 1e-4, -HEIGHT]]
    strip = Strip(np.stack([P[:1], Q[:1], P[1:], Q[1:]], 1).astype(float), np.zeros(1, bool), np.array([-1]))
    offsets = mitered(strip, HALF)
    assert offsets.failed.all()
    ((_, cutter),) = cutters(strip, offsets, HALF)
    assert cutter.volume() == pytest.approx(2 * CAP * HEIGHT, rel=0.01)


def test_a_slab_taken_apart_covers_what_it_covered():
    strip = strip_of(in_plane([0, 20, 20, 20], [2.0, 2, 2, 2]))
    ((quads, whole),) = cutters(strip, mitered(strip, HALF), HALF)
    rest = whole
    for part in round_cutters(strip, quads, HALF):
        rest = rest - part
    assert rest.volume() < 0.002 * whole.volume()
