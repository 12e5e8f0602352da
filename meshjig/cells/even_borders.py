"""Jagged borders evened out: lines along mesh edges become smooth ones through faces."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from meshjig.cells.march import NEAR, Marched, cut_faces, pinched
from meshjig.cells.power import PowerField
from meshjig.mesh.components import components
from meshjig.mesh.halfedges import Edges
from meshjig.mesh.measure import sums, unit
from meshjig.mesh.refinement import Refinement, at_corners
from meshjig.mesh.types import Bools, Floats, Ints, Mesh

__all__ = ["Evened", "Line", "even_borders"]

_SWEEPS = 24  # of averaging: it reaches over about five edges
_FARTHEST = 1.2  # edges that a line may move
_RINGS = 2  # faces on either side of a line that it may move through
_ROUNDS = 8
# never asked: no three cells meet in a face
_NOTHING = PowerField(np.zeros((1, 1), np.int64), np.zeros((1, 1)))


class Line(NamedTuple):
    """A stretch of border between two cells along mesh edges."""

    vertex: Ints  # (k,), in order; its two ends stay where they are
    left: int  # the cell on its left
    right: int


@dataclass(frozen=True)
class Evened(Refinement):
    """A mesh whose faces were cut along evened borders."""

    cell: Ints  # (m,)


def even_borders(mesh: Mesh, cell: Ints, lines: list[Line]) -> Evened:
    """Draw stretches of border again, smoothly, through the faces beside them; all others stay.

    Parameters
    ----------
    mesh : Mesh
    cell : (m,) int64
    lines : list of Line, without a vertex in common but for their ends

    Returns
    -------
    Evened
    """
    V, F, e = mesh.V, mesh.F, mesh.edges
    held = np.zeros(len(V), bool)
    for _ in range(_ROUNDS):
        owner, value, free = _sides(mesh, cell, lines, held)
        differ, along = _crossings(e, owner, value, free)
        cut = cut_faces(mesh, owner, free, _NOTHING, along)
        whole = free[F[cut.parent]].all(1)
        cut = cut._replace(cell=np.where(whole, cell[cut.parent], cut.cell))
        bad = np.flatnonzero(_strays(cut) | np.any(pinched(cut)[cut.mesh.F], axis=1))
        if not len(bad):
            break
        held[F[cut.parent[bad]].ravel()] = True
    face, bary = at_corners(mesh)
    face = np.concatenate([face, np.zeros(len(differ), np.int64)])
    bary = np.concatenate([bary, np.zeros((len(differ), 3))])
    first = np.empty(len(e.E), np.int64)
    first[e.edge_of_halfedge[::-1]] = np.arange(3 * len(F))[::-1]
    h, new = first[differ], len(V) + np.arange(len(differ))
    face[new] = h // 3
    t = np.where(F.ravel()[h] == e.E[differ, 0], along[differ], 1 - along[differ])
    bary[new, h % 3], bary[new, (h + 1) % 3] = 1 - t, t
    return Evened(cut.mesh, mesh, cut.parent, face, bary, cut.cell)


def _crossings(e: Edges, owner: Ints, value: Floats, free: Bools) -> tuple[Ints, Floats]:
    """Give the edges that lines cross, and where along every edge (0 to 1) they do."""
    a, b = e.E.T
    differ = np.flatnonzero(~free[a] & ~free[b] & (owner[a] != owner[b]))
    along = np.full(len(e.E), 0.5)
    u, v = np.abs(value[a[differ]]), np.abs(value[b[differ]])
    along[differ] = np.clip(u / np.maximum(u + v, 1e-12), NEAR, 1 - NEAR)
    return differ, along


def _strays(cut: Marched) -> Bools:
    """Mark faces that are cut off from the rest of their cell, (m,)."""
    n, part = components(
        cut.mesh.F, np.repeat(cut.cell, 3) != cut.cell[cut.mesh.edges.twin // 3], cut.mesh.edges.twin
    )
    size = sums(part, cut.mesh.areas, n)
    cell = np.empty(n, np.int64)
    cell[part] = cut.cell
    order = np.argsort(size, kind="stable")
    largest = np.full(int(cell.max()) + 1, -1)
    largest[cell[order]] = order
    out: Bools = largest[cut.cell] != part
    return out


def _sides(mesh: Mesh, cell: Ints, lines: list[Line], held: Bools) -> tuple[Ints, Floats, Bools]:
    """Tell which cell every vertex belongs to, how far it is from the line there, and which have none.

    Lines go through the held vertices (n,) that they went through before, and past all other held ones on
    the same side as before.
    """
    V, F, e = mesh.V, mesh.F, mesh.edges
    n = len(V)
    twin = e.twin
    h = np.arange(len(twin))
    border = np.zeros(len(e.E), bool)
    border[e.edge_of_halfedge[(twin == h) | (cell[h // 3] != cell[twin // 3])]] = True
    inner = np.zeros(n, bool)
    of_line = np.full(n, -1)
    for i, line in enumerate(lines):
        inner[line.vertex[1:-1]] = True
        of_line[line.vertex[1:-1]] = i
    a, b = e.E.T
    free = np.zeros(n, bool)
    free[e.E[border]] = True
    free[inner] = False
    fixed_edge = border & ~(inner[a] | inner[b])
    beside = fixed_edge[e.edge_of_halfedge].reshape(-1, 3).any(1)
    held = held.copy()
    held[F[beside].ravel()] = True  # else another cell would come to touch the border there
    free |= held & inner

    home = np.empty(n, np.int64)
    home[F.ravel()] = np.repeat(cell, 3)
    near = of_line.copy()
    depth = np.where(of_line >= 0, 0, _RINGS + 1)
    for ring in range(1, _RINGS + 1):
        for p, q in ((a, b), (b, a)):
            reached = (near[p] >= 0) & (near[q] < 0) & (depth[p] == ring - 1)
            near[q[reached]], depth[q[reached]] = near[p[reached]], ring
    owner, value = home.copy(), np.full(n, 1e-3)
    N = mesh.vertex_normals
    for i, line in enumerate(lines):
        at = np.flatnonzero((near == i) & ~free)
        own = np.isin(home[at], [line.left, line.right])
        at = at[own | inner[at]]
        x = V[line.vertex]
        off = _offset(V[at], N[at], _smoothed(x))
        least = NEAR * float(np.linalg.norm(np.diff(x, axis=0), axis=1).mean())
        free[at[inner[at] & (np.abs(off) < least)]] = True
        sign = np.where(home[at] == line.left, 1.0, -1.0)
        stays = held[at] | (depth[at] == _RINGS) | (np.abs(off) < least)
        off = np.where(~inner[at] & stays, sign * np.maximum(off * sign, least), off)
        owner[at], value[at] = np.where(off > 0, line.left, line.right), off
    pairs = np.array([[line.left, line.right] for line in lines], np.int64).reshape(-1, 2)
    for _ in range(_ROUNDS):
        strange = _strangers(e, owner, free, near, pairs)
        if not len(strange):
            break
        free[strange[inner[strange]]] = True
        owner[strange], value[strange] = home[strange], 1e-3
    return owner, value, free


def _strangers(e: Edges, owner: Ints, free: Bools, near: Ints, pairs: Ints) -> Ints:
    """List vertices whose cell would meet one that it has no line with, or away from that line."""
    a, b = e.E[~free[e.E].any(1)].T
    differ = owner[a] != owner[b]
    a, b = a[differ], b[differ]
    line = np.where(near[a] == near[b], near[a], -1)
    both = np.sort(np.stack([owner[a], owner[b]], 1), axis=1)
    good = (line >= 0) & (both == np.sort(pairs, axis=1)[line]).all(1)
    return np.unique(np.concatenate([a[~good], b[~good]]))


def _smoothed(x: Floats) -> Floats:
    """Average the points of a line (k, 3) with their neighbours; its ends stay."""
    y = x.copy()
    for _ in range(_SWEEPS):
        y[1:-1] = (y[1:-1] + (y[:-2] + y[2:]) / 2) / 2
    most = _FARTHEST * float(np.linalg.norm(np.diff(x, axis=0), axis=1).mean())
    move = y - x
    far = np.linalg.norm(move, axis=1, keepdims=True)
    return x + move * np.minimum(1.0, most / np.maximum(far, 1e-12))


def _offset(P: Floats, N: Floats, line: Floats) -> Floats:
    """Give how far points (k, 3) with normals are to the left of a line (l, 3), mm."""
    a, d = line[:-1], np.diff(line, axis=0)
    t = np.einsum("kld,ld->kl", P[:, None] - a, d) / np.maximum((d**2).sum(1), 1e-300)
    foot = a + np.clip(t, 0, 1)[..., None] * d
    apart = ((P[:, None] - foot) ** 2).sum(2)
    best, row = apart.argmin(1), np.arange(len(P))
    left = unit(np.cross(N, unit(d)[best]))
    return np.einsum("kd,kd->k", P - foot[row, best], left)
