"""Turn back the few mirrored faces of an otherwise good flattening."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from meshjig.measure import singular_values
from meshjig.topology import edges

__all__ = ["untangle"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

_THINNEST = 1e-3  # the lesser stretch below which a face counts as mirrored
_BORDER_STAYS = 2  # rounds in which only inner vertices move


def untangle(V: Floats, F: Ints, uv: Floats, rounds: int = 30) -> Floats:
    """Relax small neighbourhoods of mirrored faces until none is left.

    The vertices of mirrored faces, later also those around, move to the mean of their neighbours;
    border vertices to the mean of theirs along the border. Everything else stays.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, one disc that uses every vertex
    uv : (n, 2) float64, mm
    rounds : int

    Returns
    -------
    uv : (n, 2) float64, mm. Mirrored faces may be left: the caller checks.
    """
    from scipy.sparse import diags
    from scipy.sparse.linalg import spsolve

    bad = _mirrored(V, F, uv)
    if not bad.any():
        return uv
    adjacency, along_border, on_border = _neighbours(F, len(V))
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
        free, fixed = np.flatnonzero(moves), np.flatnonzero(~moves)
        if len(free) and len(fixed):
            target = spsolve(L[free][:, free].tocsc(), -(L[free][:, fixed] @ uv[fixed]))
            uv = uv.copy()
            uv[free] = target.reshape(-1, 2)
            _stand_up_ears(V, F, uv, moves)
            bad = _mirrored(V, F, uv)
        if not bad.any():
            break
    return uv


def _mirrored(V: Floats, F: Ints, uv: Floats) -> NDArray[np.bool_]:
    return singular_values(V, F, uv)[:, 1] <= _THINNEST


def _stand_up_ears(V: Floats, F: Ints, uv: Floats, moves: NDArray[np.bool_]) -> None:
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


def _neighbours(F: Ints, n: int) -> tuple[Any, Any, NDArray[np.bool_]]:
    """Give who is joined by an edge, who by a border edge, and who lies on the border."""
    from scipy.sparse import coo_matrix

    e = edges(F)
    rim = e.E[e.n_faces == 1]
    on_border = np.zeros(n, bool)
    on_border[rim.ravel()] = True
    every = coo_matrix((np.ones(len(e.E)), e.E.T), shape=(n, n))
    along = coo_matrix((np.ones(len(rim)), rim.T), shape=(n, n))
    return (every + every.T).tocsr(), (along + along.T).tocsr(), on_border
