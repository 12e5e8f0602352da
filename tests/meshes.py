"""Meshes named by what makes them hard: all procedural, about 100 mm large, oriented outward.

The number n that they take is about the number of faces that they give. Each is a pair (V, F) with names.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from meshjig.mesh.halfedges import edges

__all__ = [
    "Shape",
    "border",
    "cavity_shell",
    "closed_cylinder",
    "creased_box",
    "cylinder",
    "disc",
    "genus2",
    "half_sphere",
    "inside_out",
    "joined",
    "moebius",
    "moved",
    "noisy",
    "open_cup",
    "saddle",
    "sphere",
    "topology",
    "torus",
    "two_components",
]

RADIUS = 50.0  # mm


class Shape(NamedTuple):
    """Vertices (n, 3) float64 in mm and faces (m, 3) int64."""

    V: NDArray[np.float64]
    F: NDArray[np.int64]


def sphere(n: int = 1000, radius: float = RADIUS) -> Shape:
    """Genus 0, closed, smooth: a subdivided icosahedron."""
    k = max(1, round(np.sqrt(n / 20)))
    corners, triangles = _icosahedron()
    i, j = np.array([(i, j) for i in range(k + 1) for j in range(k + 1 - i)]).T
    number = np.full((k + 2, k + 2), -1)
    number[i, j] = np.arange(len(i))
    bary = np.stack([k - i - j, i, j], 1) / k
    up = np.stack([number[i, j], number[i + 1, j], number[i, j + 1]], 1)
    down = np.stack([number[i + 1, j], number[i + 1, j + 1], number[i, j + 1]], 1)
    local = np.concatenate([up[up.min(1) >= 0], down[down.min(1) >= 0]])
    V = np.einsum("pk,tkd->tpd", bary, corners[triangles]).reshape(-1, 3)
    F = (local[None] + len(i) * np.arange(20)[:, None, None]).reshape(-1, 3)
    V, F = _welded(V, F)
    return Shape(radius * V / np.linalg.norm(V, axis=1, keepdims=True), F)


def torus(n: int = 1000) -> Shape:
    """Genus 1, closed, smooth."""
    outer, inner = 0.7 * RADIUS, 0.3 * RADIUS
    nu = max(4, round(np.sqrt(n / 2 * outer / inner)))
    nv = max(3, round(n / 2 / nu))
    u, v = _angles(nu, nv)
    ring = outer + inner * np.cos(v)
    V = np.stack([ring * np.cos(u), ring * np.sin(u), inner * np.sin(v)], -1).reshape(-1, 3)
    return Shape(V, _grid_faces(nu, nv, wrap_v=True))


def genus2(n: int = 1000) -> Shape:
    """Genus 2, closed, creased: a plate with two square holes."""
    solid = np.ones((5, 3, 1), bool)
    solid[[1, 3], 1] = False
    return _voxels(solid, n, 2 * RADIUS / 5)


def creased_box(n: int = 1200) -> Shape:
    """Genus 0, closed, with the sharp edges of a cube."""
    return _voxels(np.ones((1, 1, 1), bool), n, 2 * RADIUS)


def cylinder(n: int = 1000) -> Shape:
    """An annulus: a tube open at both ends, two borders."""
    return _tube(*_tube_counts(n))


def closed_cylinder(n: int = 1000) -> Shape:
    """Genus 0, closed, with two creases that are circles."""
    rings = max(1, round(np.sqrt(n / 36)))
    tube, cap = _tube(6 * rings, 2 * rings), disc(6 * rings**2, RADIUS / 2)
    top = moved(cap, [0, 0, RADIUS])
    bottom = moved(inside_out(cap), [0, 0, -RADIUS])
    return Shape(*_welded(*joined(tube, top, bottom)))


def open_cup(n: int = 1000) -> Shape:
    """A disc as a surface, deep: floor and wall of a cup, one border, a crease around the floor."""
    rings = max(1, round(np.sqrt(n / 30)))
    floor = moved(inside_out(disc(6 * rings**2, RADIUS / 2)), [0, 0, -RADIUS])
    return Shape(*_welded(*joined(_tube(6 * rings, 2 * rings), floor)))


def disc(n: int = 1000, radius: float = RADIUS) -> Shape:
    """A flat disc of even triangles, normals along +z."""
    x, F = _unit_disc(n)
    return Shape(radius * np.column_stack([x, np.zeros(len(x))]), F)


def half_sphere(n: int = 1000) -> Shape:
    """A disc, curved like a bowl turned over; one circular border."""
    x, F = _unit_disc(n)
    r = np.linalg.norm(x, axis=1, keepdims=True)
    flat = np.sin(r * np.pi / 2) * x / np.maximum(r, 1e-12)
    return Shape(RADIUS * np.column_stack([flat, np.cos(r * np.pi / 2)]), F)


def saddle(n: int = 1000) -> Shape:
    """A disc, curved negatively."""
    x, F = _unit_disc(n)
    return Shape(RADIUS * np.column_stack([x, 0.5 * (x[:, 0] ** 2 - x[:, 1] ** 2)]), F)


def moebius(n: int = 400) -> Shape:
    """A band with half a turn: it has no two sides."""
    nu = max(8, round(np.sqrt(n * 3)))
    nv = max(1, round(n / 2 / nu)) + 1
    u = 2 * np.pi * np.arange(nu)[:, None] / nu
    w = np.linspace(-0.3, 0.3, nv)[None, :] * np.ones((nu, 1))
    ring = 0.7 + w * np.cos(u / 2)
    V = RADIUS * np.stack([ring * np.cos(u), ring * np.sin(u), w * np.sin(u / 2)], -1).reshape(-1, 3)
    F = _grid_faces(nu + 1, nv, wrap_u=False)
    last, row = nu * nv <= F, F - nu * nv
    return Shape(V, np.where(last, nv - 1 - row, F))


def two_components(n: int = 1000) -> Shape:
    """Two closed surfaces that don't touch: a sphere beside a torus."""
    return joined(sphere(n // 2), moved(torus(n - n // 2), [2.5 * RADIUS, 0, 0]))


def cavity_shell(n: int = 1000) -> Shape:
    """A solid ball with a hollow: the inner shell faces inward."""
    return joined(sphere(n // 2), inside_out(sphere(n // 2, RADIUS / 2)))


def noisy(mesh: Shape, amount: float, seed: int = 0) -> Shape:
    """Move every vertex at random by about amount times the mean edge length."""
    V, F = mesh
    edge = np.linalg.norm(V[F] - V[F[:, [1, 2, 0]]], axis=2).mean()
    return Shape(V + amount * edge * np.random.default_rng(seed).normal(size=V.shape) / np.sqrt(3), F)


def inside_out(mesh: Shape) -> Shape:
    """Turn every face around."""
    return Shape(mesh.V, np.ascontiguousarray(mesh.F[:, ::-1]))


def moved(mesh: Shape, by: list[float]) -> Shape:
    """Shift a mesh."""
    return Shape(mesh.V + np.array(by, float), mesh.F)


def joined(*meshes: Shape) -> Shape:
    """Put meshes side by side in one, unwelded."""
    starts = np.cumsum([0] + [len(mesh.V) for mesh in meshes])
    F = [mesh.F + start for mesh, start in zip(meshes, starts, strict=False)]
    return Shape(np.concatenate([mesh.V for mesh in meshes]), np.concatenate(F))


def _icosahedron() -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    g = (1 + np.sqrt(5)) / 2
    V = np.array([[0, a, b * g] for a in (-1, 1) for b in (-1, 1)], float)
    V = np.concatenate([V, np.roll(V, 1, 1), np.roll(V, 2, 1)])
    gap = np.linalg.norm(V[:, None] - V[None], axis=2)
    near = (gap > 0.1) & (gap < 2.1)
    F = [(i, j, k) for i in range(12) for j in range(12) for k in range(12)
         if i < j and i < k and near[i, j] and near[j, k] and near[k, i]
         and np.linalg.det(V[[i, j, k]]) > 0]  # fmt: skip
    return V, np.array(F, np.int64)


def _angles(nu: int, nv: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    return np.meshgrid(2 * np.pi * np.arange(nu) / nu, 2 * np.pi * np.arange(nv) / nv, indexing="ij")


def _grid_faces(nu: int, nv: int, wrap_u: bool = True, wrap_v: bool = False) -> NDArray[np.int64]:
    i, j = np.meshgrid(
        np.arange(nu if wrap_u else nu - 1), np.arange(nv if wrap_v else nv - 1), indexing="ij"
    )
    i, j = i.ravel(), j.ravel()
    a, b = i * nv + j, (i + 1) % nu * nv + j
    c, d = (i + 1) % nu * nv + (j + 1) % nv, i * nv + (j + 1) % nv
    even = ((i + j) % 2 == 0)[:, None]
    first = np.where(even, np.stack([a, b, c], 1), np.stack([a, b, d], 1))
    second = np.where(even, np.stack([a, c, d], 1), np.stack([b, c, d], 1))
    return np.concatenate([first, second])


def _tube_counts(n: int) -> tuple[int, int]:
    nu = max(6, round(np.sqrt(n * np.pi / 4)))
    return nu, max(1, round(n / 2 / nu))


def _tube(nu: int, bands: int) -> Shape:
    u = 2 * np.pi * np.arange(nu)[:, None] / nu + np.zeros((1, bands + 1))
    z = np.linspace(-RADIUS, RADIUS, bands + 1)[None, :] + np.zeros((nu, 1))
    V = np.stack([RADIUS / 2 * np.cos(u), RADIUS / 2 * np.sin(u), z], -1).reshape(-1, 3)
    return Shape(V, _grid_faces(nu, bands + 1))


def _unit_disc(n: int) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Give a disc of rings of 6 k points; 6 r^2 faces."""
    r = max(1, round(np.sqrt(n / 6)))
    ring = np.repeat(np.arange(r + 1), np.maximum(6 * np.arange(r + 1), 1))
    first = np.concatenate([[0], 1 + 3 * np.arange(r) * (np.arange(r) + 1)])
    step = np.arange(len(ring)) - first[ring]
    angle = 2 * np.pi * step / np.maximum(6 * ring, 1)
    x = (ring / r)[:, None] * np.stack([np.cos(angle), np.sin(angle)], 1)
    faces = []
    for k in range(1, r + 1):
        outer, inner = 6 * k, max(6 * (k - 1), 1)
        s = np.arange(outer)
        below = (s - s // k) % inner  # the inner ring has one point less in each of six sectors
        faces.append(np.stack([first[k] + s, first[k] + (s + 1) % outer, first[k - 1] + below], 1))
        keep = s[s % k != k - 1]
        below, above = (keep - keep // k) % inner, first[k] + (keep + 1) % outer
        faces.append(np.stack([first[k - 1] + below, above, first[k - 1] + (below + 1) % inner], 1))
    return x, np.concatenate(faces).astype(np.int64)


def _voxels(solid: NDArray[np.bool_], n: int, edge: float) -> Shape:
    """Give the surface of unit voxels, each side split so that about n faces come out."""
    padded = np.pad(solid, 1)
    sides = sum(int((padded != np.roll(padded, 1, axis)).sum()) for axis in range(3))
    k = max(1, round(np.sqrt(n / 2 / sides)))
    fine = np.pad(solid.repeat(k, 0).repeat(k, 1).repeat(k, 2), 1)
    corners, quads = [], []
    for axis in range(3):
        u, v = np.eye(3, dtype=int)[(axis + 1) % 3], np.eye(3, dtype=int)[(axis + 2) % 3]
        step = fine.astype(int) - np.roll(fine, 1, axis)
        for sign in (1, -1):
            base = np.argwhere(step == sign)
            square = [base, base + v, base + u + v, base + u]
            corners.append(np.stack(square if sign == 1 else square[::-1], 1))
            quads.append(len(base))
    Q = np.concatenate(corners).reshape(-1, 3)
    index = np.arange(len(Q)).reshape(-1, 4)
    F = np.concatenate([index[:, [0, 1, 2]], index[:, [0, 2, 3]]])
    V = (Q - 1) * (edge / k) - edge * np.array(solid.shape) / 2
    return Shape(*_welded(V, F))


def _welded(V: NDArray[np.float64], F: NDArray[np.int64]) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    _, first, number = np.unique(np.round(V, 6), axis=0, return_index=True, return_inverse=True)
    return V[first], number.ravel()[F].astype(np.int64)


def topology(F):
    """Give Euler's number, and how many edges have more than two faces."""
    e = edges(F)
    return len(np.unique(F)) - len(e.E) + len(F), int((e.n_faces > 2).sum())


def border(V, F):
    """Give the ends of the edges on the border, (k, 2, 3), and how long they are together."""
    e = edges(F)
    ends = V[e.E[e.n_faces == 1]]
    return ends, np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1).sum()
