"""Solids as a file of 32-bit floats can hold them: still closed when points are told apart by value alone."""

import numpy as np

from meshjig.errors import OutputError
from meshjig.output.needles import without_needles
from meshjig.topology import compact, edges
from meshjig.types import Bools, Floats, Ints

__all__ = ["printable"]

_SHORTEST = 1e-4  # mm; slicers weld points nearer than about this
_ROUNDS = 60


def printable(V: Floats, F: Ints) -> tuple[Floats, Ints]:
    """Make a solid survive being written as STL and read back.

    Coordinates are rounded as STL rounds them. Edges shorter than 0.0001 mm are collapsed where that keeps
    the surface a surface (the link condition); triangles lower than that are flipped away. Points that
    still coincide, such as the two sides of a pinch, are moved apart by a few units in the last place,
    each towards its own neighbours.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64; when it is not closed as it stands, points of equal value are merged first

    Returns
    -------
    V : (n', 3) float64, mm, every value exact in 32 bits, no two rows equal
    F : (m', 3) int64, closed if the input was; all vertices are used

    Raises
    ------
    OutputError
        A point is not finite.
    """
    if not np.isfinite(V).all():
        raise OutputError("a piece has points that are not finite", hint="please report this model")
    F = _without_degenerate(F)
    if not _is_closed(F):
        F = _without_degenerate(_first_equal(_rounded(V))[F])
    V = _rounded(V)
    F = without_needles(V, _without_short_edges(V, F), _SHORTEST)
    F, kept = compact(F)
    return _moved_apart(V[kept], F), F


def _rounded(V: Floats) -> Floats:
    return V.astype(np.float32).astype(np.float64) + 0.0  # -0 becomes 0: readers compare bytes


def _without_degenerate(F: Ints) -> Ints:
    good = (F[:, 0] != F[:, 1]) & (F[:, 1] != F[:, 2]) & (F[:, 2] != F[:, 0])
    return F if good.all() else F[good]


def _is_closed(F: Ints) -> bool:
    return bool((edges(F).n_faces == 2).all())


def _first_equal(V: Floats) -> Ints:
    """Give for each point the first one with the same value, (n,)."""
    order = np.lexsort(V.T)
    new = np.ones(len(V), bool)
    new[1:] = (V[order[1:]] != V[order[:-1]]).any(axis=1)
    first = np.empty(len(V), np.int64)
    first[order] = order[new][
        np.cumsum(new) - 1
    ]  # lexsort is stable: the first of a run has the least number
    return first


def _lengths(V: Floats, a: Ints, b: Ints) -> Floats:
    return np.linalg.norm(V[a] - V[b], axis=1)


def _without_short_edges(V: Floats, F: Ints) -> Ints:
    """Collapse short edges, in each round all those that are shortest in their neighbourhood."""
    for _ in range(_ROUNDS):
        if not (_lengths(V, F.ravel(), F[:, [1, 2, 0]].ravel()) < _SHORTEST).any():
            break
        e = edges(F)
        length = _lengths(V, *e.E.T)
        short = np.flatnonzero(length < _SHORTEST)
        short = short[_collapsible(e.E, e.n_faces, short)]
        if not len(short):
            break
        short = short[np.argsort(length[short], kind="stable")]
        chosen = e.E[short[_far_apart(e.E, short)]]
        target = np.arange(len(V))
        target[chosen[:, 1]] = chosen[:, 0]
        F = _without_degenerate(target[F])
    return F


def _collapsible(E: Ints, count: Ints, candidates: Ints) -> Bools:
    """Tell which edges meet the link condition: their ends share the two vertices opposite and no more."""
    from scipy.sparse import coo_matrix

    n = int(E.max(initial=0)) + 1
    both = np.concatenate([E, E[:, ::-1]])
    touching = coo_matrix((np.ones(len(both), np.int32), (both[:, 0], both[:, 1])), shape=(n, n)).tocsr()
    on_border = np.zeros(n, bool)
    on_border[E[count != 2].ravel()] = True
    degree = np.bincount(E.ravel(), minlength=n)
    a, b = E[candidates].T
    shared = np.asarray(touching[a].multiply(touching[b]).sum(axis=1)).ravel()
    tetrahedron = (degree[a] == 3) & (degree[b] == 3)
    return (shared == 2) & ~tetrahedron & ~on_border[a] & ~on_border[b]


def _far_apart(E: Ints, ordered: Ints) -> Ints:
    """Pick from ordered edges those with no better one within two steps: they can collapse at once."""
    rank = np.full(int(E.max()) + 1, len(ordered))
    np.minimum.at(rank, E[ordered].ravel(), np.repeat(np.arange(len(ordered)), 2))
    for _ in range(2):
        wider = rank.copy()
        np.minimum.at(wider, E[:, 0], rank[E[:, 1]])
        np.minimum.at(wider, E[:, 1], rank[E[:, 0]])
        rank = wider
    return np.flatnonzero(rank[E[ordered]].min(axis=1) == np.arange(len(ordered)))


def _moved_apart(V: Floats, F: Ints) -> Floats:
    """Move points that coincide towards the mean of their neighbours, farther each round."""
    V = V.copy()
    ulp = float(np.spacing(np.float32(np.abs(V).max(initial=1.0))))
    rng = np.random.default_rng(0)
    for step in range(4, 4 + _ROUNDS):
        first = _first_equal(V)
        twins = np.flatnonzero(np.isin(first, first[first != np.arange(len(V))]))
        if not len(twins):
            break
        row = np.full(len(V), -1)
        row[twins] = np.arange(len(twins))
        a, b = F.ravel(), F[:, [1, 2, 0]].ravel()
        at = row[a] >= 0
        pull = np.zeros((len(twins), 3))
        np.add.at(pull, row[a[at]], V[b[at]] - V[a[at]])
        size = np.linalg.norm(pull, axis=1, keepdims=True)
        pull = np.where(size > 0, pull / np.maximum(size, 1e-300), 0)
        if step > 4:  # a plain pull did not part them: neighbours in line, or a speck of a piece
            pull += 0.5 * rng.standard_normal(pull.shape)
        V[twins] = _rounded(V[twins] + step * ulp * pull)
    return V
