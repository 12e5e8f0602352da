"""Every cell flattened to the plane, all side by side."""

import numpy as np

from meshjig.cells.cell_mesh import CellMesh
from meshjig.cells.flatten.batched import arap, tutte
from meshjig.cells.flatten.planar import (
    CellPatches,
    folded,
    mirrored,
    patches,
    projected,
    scaled,
    simple,
    subset,
)
from meshjig.mesh.halfedges import edges
from meshjig.mesh.measure import face_areas, sums
from meshjig.mesh.types import Atlas, Bools, Floats, Ints

__all__ = ["cell_atlas", "flatten_fallback", "untangle"]

_APART = 0.6  # of the largest cell's extent
_TORN = 1e-6  # mm between the places of one vertex
_RIGID = 60  # rounds from a disc, far from isometry, to near it
_ITERATIONS = (25, 5, 1)  # fewer where the border of a cell would grow into itself
_ROUNDS = 6  # in each of which what moves grows by a ring where it has to
_SHORTEST = 1e-6  # mm


def cell_atlas(cells: CellMesh, known: Floats | None = None) -> Atlas:
    """Flatten every cell, all at once, and lay them side by side.

    Cells are looked at along their mean normal, then brought near isometry, small folds smoothed out;
    the few that stay folded, or whose border grows into itself, start from a round disc instead.

    Parameters
    ----------
    cells : CellMesh
    known : (m, 3, 2) float64, mm, optional
        Where the corners of faces lie in some plane, near to isometry; cells that are whole in it, without
        folds, stay as they are there.

    Returns
    -------
    Atlas
        Chart i is cell i: no face mirrored, its area that of the cell in space, and as far from all
        others as 0.6 of the largest chart's extent. facts: rescued (cells that folded at first), flips
        (faces mirrored or flat in the end).
    """
    p = patches(cells.mesh, cells.cell)
    uv, todo = np.zeros((len(p.V), 2)), np.ones(p.n, bool)
    if known is not None:
        uv, torn = _placed(p, known)
        todo = torn | folded(p, uv) | ~simple(p, uv)
    if todo.any():
        q, moved = subset(p, todo)
        uv[moved] = untangle(q, arap(q, projected(q)))
    uv = scaled(p, uv)
    bad = todo & (folded(p, uv) | ~simple(p, uv))
    if bad.any():
        kept, apart = flatten_fallback(p, bad)
        uv[kept] = apart
    facts = {"rescued": int(bad.sum()), "flips": int((face_areas(uv, p.F) <= 0).sum())}
    return Atlas(cells.mesh, _side_by_side(p, uv), p.F, p.cell, facts)


def _placed(p: CellPatches, corners: Floats) -> tuple[Floats, Bools]:
    """Give the places of vertices (k, 2) by those of corners (m, 3, 2), and the cells torn by it, (n,)."""
    uv = np.zeros((len(p.V), 2))
    uv[p.F] = corners
    torn = (np.abs(uv[p.F] - corners) > _TORN).any((1, 2))
    return uv, np.bincount(p.cell, torn, minlength=p.n) > 0


def _side_by_side(p: CellPatches, uv: Floats) -> Floats:
    """Place cells on a square grid."""
    low, high = np.full((p.n, 2), np.inf), np.full((p.n, 2), -np.inf)
    np.minimum.at(low, p.of_vertex, uv)
    np.maximum.at(high, p.of_vertex, uv)
    pitch = float(np.linalg.norm(high - low, axis=1).max()) * (1 + _APART)
    side = int(np.ceil(np.sqrt(p.n)))
    cell = np.arange(p.n)
    corner = np.stack([cell % side, cell // side], 1) * pitch
    return uv + (corner - (low + high) / 2)[p.of_vertex]


def flatten_fallback(p: CellPatches, chosen: Bools) -> tuple[Ints, Floats]:
    """Flatten some of the cells, near to isometry and without folds.

    All start from a round disc, from which rigid flattening mostly comes out without folds; where it does
    not, a path is taken on which no face can ever be mirrored.

    Parameters
    ----------
    p : CellPatches, discs
    chosen : (n,) bool

    Returns
    -------
    vertex : (v,) int64, the vertices of these cells
    uv : (v, 2) float64, mm

    References
    ----------
    Rabinovich et al., "Scalable Locally Injective Mappings", 2017.
    """
    q, kept = subset(p, chosen)
    start = tutte(q)
    uv = scaled(q, untangle(q, arap(q, start, _RIGID)))
    for cell in np.flatnonzero(folded(q, uv) | ~simple(q, uv)).tolist():
        one, inside = subset(q, np.arange(q.n) == cell)
        uv[inside] = start[inside]
        for iterations in _ITERATIONS:
            found = scaled(one, _slim(one, start[inside], iterations))
            if not folded(one, found)[0] and simple(one, found)[0]:
                uv[inside] = found
                break
    return kept, uv


def _slim(p: CellPatches, uv: Floats, iterations: int) -> Floats:
    import igl

    none, nowhere = np.zeros(0, np.int32), np.asfortranarray(np.zeros((0, 2)))
    V, F = np.asfortranarray(p.V), np.asfortranarray(p.F.astype(np.int32))
    data = igl.slim_precompute(V, F, np.asfortranarray(uv), igl.SYMMETRIC_DIRICHLET, none, nowhere, 0.0)
    out = np.array(igl.slim_solve(data, iterations), np.float64, order="C")
    return out if np.isfinite(out).all() else uv


def untangle(p: CellPatches, uv: Floats) -> Floats:
    """Move the vertices of mirrored faces, and as few around them as it takes, between their neighbours.

    Each comes to a mean of its neighbours in which near ones count for more, as in Tutte's embedding:
    where what surrounds them is convex, no face among them is mirrored. Rims stay as they are, so that
    not every fold can be undone; a cell in which more would be mirrored than before stays as it is.

    Parameters
    ----------
    p : CellPatches
    uv : (k, 2) float64, mm

    Returns
    -------
    (k, 2) float64, mm
    """
    from scipy.sparse import csr_matrix
    from scipy.sparse.linalg import spsolve

    e = edges(p.F)
    inner = np.ones(len(p.V), bool)
    inner[e.E[e.n_faces == 1]] = False
    a, b = e.E.T
    w = 1 / np.maximum(np.linalg.norm(p.V[a] - p.V[b], axis=1), _SHORTEST)
    W = csr_matrix((np.r_[w, w], (np.r_[a, b], np.r_[b, a])), shape=(len(p.V), len(p.V)))
    free = np.zeros(len(p.V), bool)
    start, uv = uv, uv.copy()
    for turn in range(_ROUNDS):
        fold = mirrored(p, uv)
        if not fold.any():
            break
        if turn:
            around = np.isin(p.F, p.F[fold])
            fold = around[:, 0] | around[:, 1] | around[:, 2]
        free[p.F[fold]] = True
        moving = np.flatnonzero(free & inner)
        if not len(moving):
            break
        row = W[moving]
        total = np.asarray(row.sum(1)).ravel()
        A = csr_matrix((total, (np.arange(len(moving)),) * 2), shape=(len(moving),) * 2) - row[:, moving]
        fixed = uv.copy()
        fixed[moving] = 0.0
        uv[moving] = spsolve(A.tocsc(), row @ fixed).reshape(-1, 2)
    better = _fold_area(p, uv) <= _fold_area(p, start)
    return np.where(better[p.of_vertex, None], uv, start)


def _fold_area(p: CellPatches, uv: Floats) -> Floats:
    """Give the area in space of the mirrored faces of each cell, (n,)."""
    return sums(p.cell, p.area * mirrored(p, uv), p.n)
