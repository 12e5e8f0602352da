"""Repair a flattening: turn mirrored faces back, and draw borders apart that cross."""

from typing import Any

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints, ragged
from meshjig.mesh.boundary_loops import border_loop
from meshjig.mesh.halfedges import compact, edges
from meshjig.mesh.measure import edge_lengths, singular_values
from meshjig.mesh.mesh import Mesh

__all__ = ["faces_around", "separate_border", "untangle"]

_THINNEST = 1e-3  # the lesser stretch below which a face counts as mirrored
_LARGE = 50_000  # faces, from which on a list of the faces at each vertex is made sooner than a ring found
_FIRST = 6  # rounds that turn back most, before wider surroundings are looked at
_BORDER_STAYS = 2  # rounds in which only inner vertices move
_RINGS = 20  # of faces around crossing borders that may be moved


def untangle(V: Floats, F: Ints, uv: Floats, rounds: int = 30, stretch: Floats | None = None) -> Floats:
    """Relax small neighbourhoods of mirrored faces until none is left.

    The vertices of mirrored faces, later also those around, move to the mean of their neighbours;
    border vertices to the mean of theirs along the border. Everything else stays.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, one disc that uses every vertex
    uv : (n, 2) float64, mm
    rounds : int
    stretch : (m, 2) float64, singular values of the faces, where the caller has them

    Returns
    -------
    uv : (n, 2) float64, mm. Mirrored faces may be left: the caller checks.
    """
    bad = _mirrored(V, F, uv) if stretch is None else stretch[:, 1] <= _THINNEST
    for n, even in ((_FIRST, False), (rounds, True)):
        if not bad.any():
            break
        near = faces_around(F, bad, n // 2 + 2)
        H, kept = compact(F[near])
        stays = np.zeros(len(V), bool)
        stays[F[~near].ravel()] = True
        uv = uv.copy()
        uv[kept] = _relaxed(Mesh(V[kept], H), uv[kept], stays[kept], bad[near], n, even)
        bad[near] = _mirrored(V, F[near], uv)
    return uv


def faces_around(F: Ints, faces: Bools, rings: int) -> Bools:
    """Mark faces (m,) and rings of faces around them, (m,) bool."""
    if len(F) > _LARGE:
        return _spread(F, faces, rings)
    reached = np.zeros(int(F.max()) + 1, bool)
    a, b, c = np.ascontiguousarray(F.T)  # three looks at columns are quicker than any() along rows
    before = np.zeros(len(F), bool)
    for _ in range(rings):
        reached[F[faces & ~before].ravel()] = True
        before, faces = faces, reached[a] | reached[b] | reached[c]
    return faces


def _spread(F: Ints, faces: Bools, rings: int) -> Bools:
    """Do the same with a list of the faces at each vertex: after that, far ones cost nothing."""
    from scipy.sparse import csr_matrix

    corner_of = csr_matrix((np.ones(F.size, np.int8), F.ravel(), np.arange(0, F.size + 1, 3)))
    at_vertex = corner_of.tocsc()
    begin, n = at_vertex.indptr[:-1].astype(np.int64), np.diff(at_vertex.indptr).astype(np.int64)
    marked, rim, reached = faces.copy(), np.flatnonzero(faces), np.zeros(len(n), bool)
    for _ in range(rings):
        new = F[rim].ravel()
        new = np.unique(new[~reached[new]])
        reached[new] = True
        rim = at_vertex.indices[ragged(begin[new], n[new])]
        rim = np.unique(rim[~marked[rim]])
        marked[rim] = True
    return marked


def _relaxed(mesh: Mesh, uv: Floats, stays: Bools, bad: Bools, rounds: int, even: bool) -> Floats:
    """Relax with near neighbours weighing more, which stretches less, or evenly, which turns more back."""
    from scipy.sparse import diags
    from scipy.sparse.linalg import spsolve

    V, F = mesh
    adjacency, along_border, on_border = _neighbours(mesh, stays, even)
    inner = diags((~on_border).astype(float))
    W = (inner @ adjacency + along_border).tocsr()
    L = (diags(np.asarray(W.sum(1)).ravel()) - W).tocsr()
    for n in range(rounds):
        moves = np.zeros(len(V), bool)
        moves[F[bad].ravel()] = True
        if n < _BORDER_STAYS:
            moves &= ~on_border
        for _ in range(n // 2):
            moves |= (adjacency @ moves.astype(float) > 0) & ~on_border
        moves &= ~stays
        free, fixed = np.flatnonzero(moves), np.flatnonzero(~moves)
        if len(free) and len(fixed):
            target = spsolve(L[free][:, free].tocsc(), -(L[free][:, fixed] @ uv[fixed]))
            uv = uv.copy()
            uv[free] = target.reshape(-1, 2)
            _stand_up_ears(V, F, uv, moves)
            touched = np.flatnonzero(np.any(moves[F], axis=1))
            bad[touched] = _mirrored(V, F[touched], uv)
        if not bad.any():
            break
    return uv


def _mirrored(V: Floats, F: Ints, uv: Floats) -> Bools:
    return singular_values(V, F, uv)[:, 1] <= _THINNEST


def _stand_up_ears(V: Floats, F: Ints, uv: Floats, moves: Bools) -> None:
    """Give moved corners of one face only, which the mean along the border lays flat, that face's shape."""
    tip = np.bincount(F.ravel(), minlength=len(V))[F] == 1
    tip &= (tip.sum(1) == 1)[:, None] & moves[F]
    face, k = np.nonzero(tip)
    apex, a, b = F[face, k], F[face, (k + 1) % 3], F[face, (k + 2) % 3]
    base, side = V[b] - V[a], V[apex] - V[a]
    square = np.maximum(np.einsum("ij,ij->i", base, base), 1e-300)
    along = np.einsum("ij,ij->i", base, side) / square
    height = np.linalg.norm(side - along[:, None] * base, axis=1) / np.sqrt(square)
    flat = uv[b] - uv[a]
    uv[apex] = uv[a] + along[:, None] * flat + height[:, None] * flat[:, ::-1] * [-1.0, 1.0]


def _neighbours(mesh: Mesh, stays: Bools, even: bool) -> tuple[Any, Any, Bools]:
    """Who is joined by an edge, who by a border edge, and who lies on the border.

    Where faces were left out, both ends of an edge stay: that is no border.
    """
    from scipy.sparse import coo_matrix

    e, n = mesh.edges, len(stays)
    rim = e.E[(e.n_faces == 1) & ~stays[e.E].all(1)]
    on_border = np.isin(np.arange(n), rim)
    length = edge_lengths(mesh.V, e.E)
    weight = np.ones(len(e.E)) if even else length.mean() / np.maximum(length, 1e-2 * length.mean())
    every = coo_matrix((weight, e.E.T), shape=(n, n))
    along = coo_matrix((np.ones(len(rim)), rim.T), shape=(n, n))
    return (every + every.T).tocsr(), (along + along.T).tocsr(), on_border


def separate_border(V: Floats, F: Ints, uv: Floats, rounds: int = 12, border: Ints | None = None) -> Floats:
    """Pull crossing borders inward, each into its own side, until they cross no more.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, one disc that uses every vertex
    uv : (n, 2) float64, mm, without mirrored faces
    rounds : int
    border : (b,) int64, its border loop, where the caller has it

    Returns
    -------
    uv : (n, 2) float64, mm. Borders may still cross, or faces be mirrored: the caller checks.
    """
    loop = border_loop(F) if border is None else border
    crossing = _crossing(uv[loop])
    for width in range(1, rounds + 1):
        if not len(crossing):
            break
        near = (crossing[:, None] + np.arange(-width, width + 2)).ravel() % len(loop)
        uv = _pulled(V, F, uv, np.unique(loop[near]))
        crossing = _crossing(uv[loop])
    return uv


def _pulled(V: Floats, F: Ints, uv: Floats, pulled: Ints) -> Floats:
    """Move vertices half-way to the mean of their neighbours, and turn back what that mirrors near them."""
    from scipy.sparse import coo_matrix

    chosen = np.zeros(len(V), bool)
    chosen[pulled] = True
    H, kept = compact(F[faces_around(F, np.any(chosen[F], axis=1), _RINGS)])
    own, E = np.flatnonzero(chosen[kept]), edges(H).E
    W = coo_matrix((np.ones(len(E)), E.T), shape=(len(kept),) * 2).tocsr()
    W = (W + W.T)[own]
    local = uv[kept]
    local[own] = (local[own] + (W @ local) / np.asarray(W.sum(1)).reshape(-1, 1)) / 2
    uv = uv.copy()
    uv[kept] = untangle(V[kept], H, local)
    return uv


def _crossing(ring: Floats) -> Ints:
    """List the segments of a ring that meet others than their neighbours."""
    import shapely

    segments = shapely.linestrings(np.stack([ring, np.roll(ring, -1, 0)], 1))
    a, b = shapely.STRtree(segments).query(segments, predicate="intersects")
    apart = np.abs(a - b)
    return np.unique(a[(apart > 1) & (apart < len(ring) - 1)])
