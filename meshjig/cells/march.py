"""Marching triangles with many labels: borders between cells, cut through the faces of a mesh."""

from typing import NamedTuple

import numpy as np

from meshjig.cells.power import PowerField
from meshjig.cells.surface import Surface
from meshjig.mesh.arrays import starts
from meshjig.mesh.halfedges import Edges
from meshjig.mesh.types import Bools, Floats, Ints, Mesh

__all__ = ["NEAR", "Marched", "cut_faces", "march", "pinched", "straighten"]

NEAR = 0.06  # of an edge: a border that passes a vertex closer than this goes through it
_STEEP = 0.7  # the same for a vertex on a crease that borders should follow
_INSIDE = 0.15  # the least barycentric coordinate of a point where three cells meet
_ROUNDS = 8
_SLIDES = 12


class Marched(NamedTuple):
    """A mesh cut along the borders of cells; its first vertices are those of the mesh."""

    mesh: Mesh
    parent: Ints  # (m',), the face that a face was cut from
    cell: Ints  # (m',)


def march(s: Surface, owner: Ints, field: PowerField) -> Marched:
    """Cut faces where the values of two cells are equal, between vertices that the cells own.

    Two cells meet along a straight line in a face, three at a point. Where the line would pass close to
    a vertex it goes through the vertex, so that no face becomes a sliver.

    Parameters
    ----------
    s : Surface
    owner : (n,) int64
    field : PowerField

    Returns
    -------
    Marched
    """
    (V, F), e = s.mesh, s.e
    crossing, along = _crossings(e, owner, field)
    free = _snapped(F, e, np.where(s.steep, _STEEP, NEAR), crossing, along)
    for _ in range(_ROUNDS):
        cut = cut_faces(s.mesh, owner, free, field, along)
        bad = np.flatnonzero(pinched(cut)[: len(V)] & free)
        if not len(bad):
            break
        free[bad] = False
    a, b = e.E.T
    ends = e.E[~free[a] & ~free[b] & (owner[a] != owner[b])]
    point = len(V) + np.arange(len(ends))
    return cut._replace(mesh=straighten(cut.mesh, cut.cell, point, ends, NEAR))


def _crossings(e: Edges, owner: Ints, field: PowerField) -> tuple[Ints, Floats]:
    """Give the edges whose ends belong to different cells, and where along every edge (0 to 1) it crosses."""
    crossing = np.flatnonzero(owner[e.E[:, 0]] != owner[e.E[:, 1]])
    u, v = e.E[crossing].T
    a, b = owner[u], owner[v]
    value = np.stack([field.at(u, b), field.at(u, a), field.at(v, a), field.at(v, b)])
    value[:, ~np.isfinite(value).all(0)] = 0.0
    du, dv = value[0] - value[1], value[2] - value[3]
    known = (du >= 0) & (dv >= 0) & (du + dv > 0)
    along = np.full(len(e.E), 0.5)
    along[crossing[known]] = du[known] / (du[known] + dv[known])
    return crossing, along


def _snapped(F: Ints, e: Edges, near: Floats, crossing: Ints, along: Floats) -> Bools:
    """Mark vertices that the border goes through, (n,): never all three of a face."""
    ends, t = e.E[crossing].ravel(), np.stack([along[crossing], 1 - along[crossing]], 1).ravel()
    closest = np.full(len(near), np.inf)
    np.minimum.at(closest, ends, t)
    free = closest < near
    for _ in range(_ROUNDS):
        full = np.flatnonzero(free[F].all(1))
        if not len(full):
            return free
        free[F[full, closest[F[full]].argmax(1)]] = False
    free[F[free[F].all(1)].ravel()] = False
    return free


def cut_faces(mesh: Mesh, owner: Ints, free: Bools, field: PowerField, along: Floats) -> Marched:
    """Split every face by the labels of its corners; free corners have none."""
    (V, F), e = mesh, mesh.edges
    a, b = e.E.T
    crossed = ~free[a] & ~free[b] & (owner[a] != owner[b])
    point = np.full(len(e.E), -1)
    point[crossed] = len(V) + np.arange(crossed.sum())
    t = np.clip(along[crossed], NEAR, 1 - NEAR)[:, None]
    on_edge = V[a[crossed]] * (1 - t) + V[b[crossed]] * t
    middle = point[e.edge_of_halfedge].reshape(-1, 3)
    n_cut = (middle >= 0).sum(1)
    three = np.flatnonzero(n_cut == 3)
    inner = np.einsum("kj,kjd->kd", _meeting(field, F[three], owner[F[three]]), V[F[three]])
    V = np.concatenate([V, on_edge, inner])
    faces, parents, labels = [], [], []

    def add(parent: Ints, label: Ints, *corners: Ints) -> None:
        faces.append(np.stack(corners, 1))
        parents.append(parent)
        labels.append(label)

    whole = np.flatnonzero(n_cut == 0)
    add(whole, _label_of(owner[F[whole]], free[F[whole]]), *F[whole].T)
    one = np.flatnonzero(n_cut == 1)  # from a free corner to the side opposite
    (p, q, r), (m, _, _) = _turned(F[one], middle[one], (middle[one] >= 0).argmax(1))
    add(one, owner[p], p, m, r)
    add(one, owner[q], m, q, r)
    two = np.flatnonzero(n_cut == 2)  # one corner is cut off
    (p, q, r), (_, m, k) = _turned(F[two], middle[two], (middle[two] < 0).argmax(1))
    add(two, owner[r], m, r, k)
    short = np.linalg.norm(V[p] - V[m], axis=1) <= np.linalg.norm(V[q] - V[k], axis=1)
    add(two, owner[p], p, q, np.where(short, m, k))
    add(two, owner[p], np.where(short, p, q), m, k)
    centre = len(V) - len(three) + np.arange(len(three))
    for k in range(3):
        corner, after, before = F[three, k], middle[three, k], middle[three, k - 1]
        add(three, owner[corner], corner, after, centre)
        add(three, owner[corner], corner, centre, before)
    G = np.concatenate(faces)
    return Marched(Mesh(V, G), np.concatenate(parents), np.concatenate(labels))


def _label_of(owner: Ints, free: Bools) -> Ints:
    """Give the label of the first corner that is not free."""
    return np.take_along_axis(owner, free.argmin(1)[:, None], 1)[:, 0]


def _turned(F: Ints, middle: Ints, first: Ints) -> tuple[Ints, Ints]:
    """Turn faces so that a given side comes first; their corners and middles, (3, k) each."""
    turn = (np.arange(3) + first[:, None]) % 3
    return np.take_along_axis(F, turn, 1).T, np.take_along_axis(middle, turn, 1).T


def _meeting(field: PowerField, F: Ints, owner: Ints) -> Floats:
    """Give the place in a face where the three cells of its corners have equal values, (k, 3)."""
    value = np.stack([np.stack([field.at(F[:, c], owner[:, k]) for c in range(3)], 1) for k in range(3)], 1)
    known = np.isfinite(value).all((1, 2))
    value[~known] = 0.0
    system = np.stack([value[:, 0] - value[:, 1], value[:, 0] - value[:, 2], np.ones((len(F), 3))], 1)
    size = np.abs(system[:, :2]).max((1, 2), initial=0.0)
    known &= np.abs(np.linalg.det(system)) > 1e-9 * size**2
    system[~known] = np.eye(3)
    bary = np.linalg.solve(system, np.broadcast_to([[0.0], [0.0], [1.0]], (len(F), 3, 1)))[:, :, 0]
    bary[~known] = 1 / 3
    bary = np.maximum(bary, _INSIDE)
    return bary / bary.sum(1, keepdims=True)


def pinched(cut: Marched) -> Bools:
    """Mark vertices at which the faces of one cell meet in more than one fan, (n,)."""
    twin, n = cut.mesh.edges.twin, int(cut.cell.max(initial=0)) + 1
    h = np.arange(len(twin))
    border = np.flatnonzero((twin == h) | (cut.cell[h // 3] != cut.cell[twin // 3]))
    found, count = np.unique(
        cut.mesh.F.ravel()[border] * np.int64(n) + cut.cell[border // 3], return_counts=True
    )
    out = np.zeros(len(cut.mesh.V), bool)
    out[found[count > 1] // n] = True
    return out


def straighten(mesh: Mesh, cell: Ints, point: Ints, ends: Ints, near: float) -> Mesh:
    """Slide points of borders along the edges that they lie on, each towards the line between its neighbours.

    Parameters
    ----------
    mesh : Mesh, whose edges follow borders
    cell : (m,) int64, of each face
    point : (k,) int64, vertices that lie on an edge
    ends : (k, 2) int64, vertices at the ends of that edge
    near : float, 0 to 0.5, of an edge: points stay that far from its ends

    Returns
    -------
    Mesh
    """
    V, e = mesh.V, mesh.edges
    h = mesh.inner_halfedges
    border = h[cell[h // 3] != cell[e.twin[h] // 3]]
    E = e.E[e.edge_of_halfedge[border]]
    both = np.concatenate([E, E[:, ::-1]])
    both = both[np.argsort(both[:, 0], kind="stable")]
    degree = np.bincount(both[:, 0], minlength=len(V))
    start = starts(degree)
    moving = degree[point] == 2
    point, ends = point[moving], ends[moving]
    p, q = both[start[point], 1], both[start[point] + 1, 1]
    a, d = V[ends[:, 0]], V[ends[:, 1]] - V[ends[:, 0]]
    squared = np.maximum(np.einsum("ij,ij->i", d, d), 1e-300)
    W = V.copy()
    for _ in range(_SLIDES):
        x = W[point]
        lp, lq = np.linalg.norm(W[p] - x, axis=1), np.linalg.norm(W[q] - x, axis=1)
        m = (W[p] * lq[:, None] + W[q] * lp[:, None]) / np.maximum(lp + lq, 1e-300)[:, None]
        t = np.clip(np.einsum("ij,ij->i", (m + x) / 2 - a, d) / squared, near, 1 - near)
        W[point] = a + t[:, None] * d
    return mesh.moved(W)
