"""Atlases and outlines to cut, and what every cut mesh has to keep."""

from itertools import pairwise

import numpy as np
import shapely
from scipy.spatial import Delaunay

from meshjig.cut.overlay import overlay
from meshjig.mesh.halfedges import edges
from meshjig.mesh.measure import area_vectors, barycentric, face_areas, interpolate
from meshjig.mesh.types import Atlas, Bools, CutMesh, Floats, Ints, Knobs, Mesh, Outlines

SIDE = 100.0


def flat_sheet(n: int, side: float = SIDE) -> tuple[Floats, Ints]:
    """Give points and faces of a square grid, n cells a side, each cut along its diagonal."""
    x, y = np.meshgrid(np.linspace(0, side, n + 1), np.linspace(0, side, n + 1))
    j, i = (a.ravel() for a in np.meshgrid(np.arange(n), np.arange(n), indexing="ij"))
    v = j * (n + 1) + i
    F = np.concatenate([np.stack([v, v + 1, v + n + 2], 1), np.stack([v, v + n + 2, v + n + 1], 1)])
    return np.stack([x.ravel(), y.ravel()], 1), F


def wavy(p: Floats) -> Floats:
    """Bend a plane into space."""
    return np.column_stack([p, 5 * np.sin(p[:, 0] / 20) + 3 * np.cos(p[:, 1] / 15)])


def atlas(V: Floats, F: Ints, uv: Floats, F_uv: Ints | None = None, chart: Ints | None = None) -> Atlas:
    chart = np.zeros(len(F), np.int64) if chart is None else chart
    return Atlas(Mesh(V, F), uv, F if F_uv is None else F_uv, chart)


def sheet_atlas(n: int, uv: Floats | None = None) -> Atlas:
    p, F = flat_sheet(n)
    return atlas(wavy(p), F, p if uv is None else uv)


def tube_atlas(
    nx: int = 24, ny: int = 16, width: float = 120.0, height: float = 80.0, teeth: float = 0.0
) -> Atlas:
    """A tube cut open along one line, perhaps with teeth, mm: a periodic chart of its own width."""
    u, v = np.meshgrid(np.linspace(0, width, nx + 1), np.linspace(0, height, ny + 1))
    moved = teeth * (np.arange(ny + 1) % 2)[:, None]
    uv = np.stack([(u + moved).ravel(), v.ravel()], 1)
    angle = 2 * np.pi * np.arange(nx) / nx + 2 * np.pi * moved / width
    ring = np.stack([np.cos(angle), np.sin(angle)], -1) * width / (2 * np.pi)
    heights = np.repeat(np.linspace(0, height, ny + 1), nx)
    V = np.column_stack([ring.reshape(-1, 2), heights])
    j, i = (a.ravel() for a in np.meshgrid(np.arange(ny), np.arange(nx), indexing="ij"))

    def faces(stride: int, wrap: int) -> Ints:
        a, b = j * stride + i, j * stride + (i + 1) % wrap
        return np.concatenate([np.stack([a, b, b + stride], 1), np.stack([a, b + stride, a + stride], 1)])

    F = faces(nx, nx)
    chart = np.zeros(len(F), np.int64)
    return Atlas(Mesh(V, F), uv, faces(nx + 1, nx + 1), chart, period=np.array([width]))


def two_charts(n: int, shift: tuple[float, float]) -> Atlas:
    """A sheet whose right half lies elsewhere in the plane."""
    p, F = flat_sheet(n)
    right = p[F].mean(axis=1)[:, 0] > SIDE / 2
    return atlas(
        wavy(p), F, np.concatenate([p, p + shift]), F + right[:, None] * len(p), right.astype(np.int64)
    )


def slit_sheet(n: int) -> Atlas:
    """A sheet whose one chart is cut open from the bottom to the middle."""
    p, F = flat_sheet(n)
    right = p[F].mean(axis=1)[:, 0] > SIDE / 2
    on_slit = (p[:, 0] == SIDE / 2) & (p[:, 1] < SIDE / 2)
    F_uv = np.where(right[:, None] & on_slit[F], F + len(p), F)
    return atlas(wavy(p), F, np.concatenate([p, p]), F_uv)


def grid_graph(lines_x: Floats, lines_y: Floats, parts: int = 1, turn: float = 0.0) -> Outlines:
    """Lines of a grid as outlines, each cell side in so many parts; the cell number is the label."""
    nx, ny = len(lines_x), len(lines_y)
    number: dict[tuple[float, float], int] = {}
    S, L, R = [], [], []

    def add(ends: tuple, left: int, right: int) -> None:
        way = [
            tuple(np.round(ends[0] + t * np.subtract(ends[1], ends[0]), 9))
            for t in np.linspace(0, 1, parts + 1)
        ]
        ids = [number.setdefault(q, len(number)) for q in way]
        S.extend(pairwise(ids))
        L.extend([left] * parts)
        R.extend([right] * parts)

    def cell(i: int, j: int) -> int:
        return i + j * (nx - 1) if 0 <= i < nx - 1 and 0 <= j < ny - 1 else -1

    for j in range(ny):
        for i in range(nx - 1):
            add(((lines_x[i], lines_y[j]), (lines_x[i + 1], lines_y[j])), cell(i, j), cell(i, j - 1))
    for i in range(nx):
        for j in range(ny - 1):
            add(((lines_x[i], lines_y[j]), (lines_x[i], lines_y[j + 1])), cell(i - 1, j), cell(i, j))
    rotation = np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])
    points = (np.array(list(number)) - SIDE / 2) @ rotation + SIDE / 2
    return Outlines(points, np.array(S), np.array(L), np.array(R))


def loops(*polygons: Floats, labels: list[int], outside: list[int] | None = None) -> Outlines:
    """Closed counter-clockwise curves as outlines."""
    size = np.array([len(p) for p in polygons])
    first = np.repeat(np.cumsum(size) - size, size)
    k = np.arange(size.sum())
    after = first + (k - first + 1) % np.repeat(size, size)
    right = np.repeat([-1] * len(size) if outside is None else outside, size)
    return Outlines(np.concatenate(polygons), np.stack([k, after], 1), np.repeat(labels, size), right)


def square(x: float, y: float, r: float) -> Floats:
    return np.array([[x - r, y - r], [x + r, y - r], [x + r, y + r], [x - r, y + r]], float)


def regular(x: float, y: float, r: float, n: int) -> Floats:
    t = 2 * np.pi * np.arange(n) / n
    return np.column_stack([x + r * np.cos(t), y + r * np.sin(t)])


def delaunay(p: Floats) -> Ints:
    """Triangulate points counter-clockwise, without flat triangles."""
    F = Delaunay(p).simplices.astype(np.int64)
    area = face_areas(p, F)
    F[area < 0] = F[area < 0][:, ::-1]
    return F[np.abs(area) > 1e-9]


def patches(p: Floats, n_labels: int, rng: np.random.Generator) -> tuple[Outlines, Ints, Ints]:
    """Label a triangulation at random and outline the labels; also give its triangles and labels."""
    T = delaunay(p)
    label = rng.integers(0, n_labels, len(T))
    twin = edges(T).twin
    h = np.flatnonzero(twin >= np.arange(len(twin)))
    left, right = label[h // 3], np.where(twin[h] == h, -1, label[twin[h] // 3])
    h, left, right = (a[left != right] for a in (h, left, right))
    ends = np.stack([T.ravel()[h], T[:, [1, 2, 0]].ravel()[h]], 1)
    return Outlines(p, ends, left, right), T, label


def midpoints_uv(a: Atlas, cut: CutMesh) -> Floats:
    """Give where the centroids of sub-faces lie in the plane."""
    middle = cut.V[cut.F].mean(axis=1)
    return interpolate(a.uv, a.F_uv, cut.parent, barycentric(a.mesh.V, a.mesh.F, cut.parent, middle))


def clear_of(outlines: Outlines, q: Floats, mm: float) -> Bools:
    """Tell which points of the plane are farther than this from all outlines."""
    tree = shapely.STRtree(shapely.linestrings(outlines.points[outlines.segments]))
    close, _ = tree.query(shapely.points(q), predicate="dwithin", distance=mm)
    clear = np.ones(len(q), bool)
    clear[close] = False
    return clear


def assert_sound(a: Atlas, cut: CutMesh) -> None:
    """Hold a cut mesh to every promise that does not depend on the outlines."""
    V, F = a.mesh.V, a.mesh.F
    before, after = face_areas(V, F), face_areas(cut.V, cut.F)
    np.testing.assert_allclose(after.sum(), before.sum(), rtol=1e-9)
    covered = np.bincount(cut.parent, after, len(F))
    np.testing.assert_allclose(covered, before, rtol=1e-7, atol=1e-9)

    turned = np.einsum("ij,ij->i", area_vectors(cut.V, cut.F), area_vectors(V, F)[cut.parent])
    assert turned.min() > -1e-12

    E = edges(cut.F)
    assert E.n_faces.max() <= 2
    h = np.arange(len(E.twin))
    inner = E.twin != h
    assert (cut.F.ravel()[h[inner]] != cut.F.ravel()[E.twin[inner]]).all()
    np.testing.assert_allclose(border_length(cut.V, cut.F), border_length(V, F), rtol=1e-9)

    np.testing.assert_array_equal(cut.V[: len(V)], V)
    assert len(np.unique(cut.F)) == len(cut.V)
    assert cut.vertex_bary.min() >= 0
    np.testing.assert_allclose(cut.vertex_bary.sum(axis=1), 1, atol=1e-12)
    np.testing.assert_allclose(interpolate(V, F, cut.vertex_face, cut.vertex_bary), cut.V, atol=1e-10)

    same = np.zeros(cut.region.max() + 1, np.int64)
    same[cut.region] = cut.label
    np.testing.assert_array_equal(same[cut.region], cut.label)
    here, there = h[inner] // 3, E.twin[inner] // 3
    alike = (cut.label[here] == cut.label[there]) & (cut.label[here] >= 0)
    np.testing.assert_array_equal(cut.region[here[alike]], cut.region[there[alike]])
    outside = cut.region[cut.label < 0]
    chart = np.zeros_like(same)
    chart[outside] = a.chart_of_face[cut.parent[cut.label < 0]]
    np.testing.assert_array_equal(chart[outside], a.chart_of_face[cut.parent[cut.label < 0]])
    assert cut.facts.label_conflicts == 0

    # a cut is an edge of the mesh
    n = np.int64(len(cut.V))
    keys = E.E[:, 0] * n + E.E[:, 1]
    assert np.isin(cut.cuts.min(axis=1) * n + cut.cuts.max(axis=1), keys).all()


def border_length(V: Floats, F: Ints) -> float:
    E = edges(F)
    border = E.E[E.n_faces == 1]
    return float(np.linalg.norm(V[border[:, 0]] - V[border[:, 1]], axis=1).sum())


def shortest_edge(cut: CutMesh) -> float:
    E = edges(cut.F).E
    return float(np.linalg.norm(cut.V[E[:, 0]] - cut.V[E[:, 1]], axis=1).min())


def ring_graph(n_around: int, rows: Floats, first: float, period: float) -> tuple[Outlines, Knobs]:
    """Tiles around a periodic chart, with a knob to the left on every side that runs up.

    Everything is drawn three times, a period apart. Column i and row j have the label i + j n.
    """
    n, width, shape = n_around, period / n_around, _knob()
    points, S, L, R = [], [], [], []
    knobs: dict[str, list] = {"neck": [], "head": [], "span": []}
    for i in range(n):
        points += [(first + i * width, y) for y in rows]
    node = np.arange(n * len(rows)).reshape(n, len(rows))
    for i in range(n):
        for j in range(len(rows) - 1):
            size = rows[j + 1] - rows[j]
            ids = [node[i, j], *(len(points) + np.arange(len(shape) - 2)), node[i, j + 1]]
            points += [(first + i * width - q * width, rows[j] + p * size) for p, q in shape[1:-1]]
            knobs["neck"].append((ids[2], ids[-3]))
            knobs["head"].append((ids[3], ids[-4]))
            knobs["span"].append((len(S) + 2, len(S) + len(shape) - 3))
            S += pairwise(ids)
            L += [(i - 1) % n + j * n] * (len(shape) - 1)
            R += [i + j * n] * (len(shape) - 1)
    k = len(points)  # of a copy; the last column's rows lead on to the next copy's first
    for i in range(n):
        for j in range(len(rows)):
            S.append((node[i, j], node[i + 1, j] if i + 1 < n else node[0, j] + k))
            L.append(i + j * n if j < len(rows) - 1 else -1)
            R.append(i + (j - 1) * n if j > 0 else -1)
    P, E = np.array(points), np.array(S)
    copies = np.vstack([P + np.array([c * period, 0]) for c in (-1, 0, 1)])
    ends = np.vstack([E + c * k for c in range(3)])
    whole = ends.max(1) < 3 * k
    same_point, same_segment = np.tile(np.arange(k), 3), np.tile(np.arange(len(E)), 3)
    outlines = Outlines(
        copies, ends[whole], np.tile(L, 3)[whole], np.tile(R, 3)[whole], same_point, same_segment[whole]
    )
    return outlines, Knobs(*(np.array(knobs[key]) for key in ("neck", "head", "span")))


def _knob() -> Floats:
    """Give a side with a knob on its left, (k, 2): along the side, and out of it."""
    right = np.array([(0.35, 0), (0.44, 0.03), (0.40, 0.15), (0.42, 0.25), (0.5, 0.28)])
    left = [(1 - x, y) for x, y in right[-2::-1]]
    return np.vstack([[(0, 0)], right, left, [(1, 0)]])


def halved_sheet(curve: Floats, n: int = 21, bent: bool = False) -> CutMesh:
    """Cut a sheet in two along a curve upward from below it: label 0 on its left, 1 on its right."""
    p, F = flat_sheet(n)
    k, low, high = len(curve), -1.0, SIDE + 1.0
    points = np.vstack([curve, [(low, high), (low, low), (high, low), (high, high)]])
    segments = [(i, i + 1) for i in range(k + 1)] + [(k + 1, 0), (0, k + 2), (k + 2, k + 3), (k + 3, k - 1)]
    left = np.repeat([0, 0, 1], [k - 1, 3, 3])
    right = np.repeat([1, 2], [k - 1, 6])
    sheet = atlas(wavy(p) if bent else np.c_[p, np.zeros(len(p))], F, p)
    return overlay(sheet, Outlines(points, np.array(segments), left, right))
