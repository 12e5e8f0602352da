"""Solids as a file of 32-bit floats can hold them: still closed when points are told apart by value alone."""

from collections.abc import Sequence

import numpy as np

from meshjig.errors import OutputError
from meshjig.mesh.arrays import Floats, Ints, row_of, starts
from meshjig.mesh.halfedges import compact
from meshjig.solid.slivers import low_faces, without_degenerate, without_needles, without_short_edges

__all__ = ["all_printable", "printable"]

_SHORTEST = 1e-4  # mm; slicers weld points nearer than about this
_DECIMALS = 8  # of a mm: around 0 a 32-bit number has finer steps, which some readers take for one place
_ROUNDS = 60
_MIX = np.array([0x9E3779B97F4A7C15, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9, 0x27D4EB2F165667C5], np.uint64)


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
    V : (n', 3) float64, mm, every value exact in 32 bits, no two rows equal to 8 decimals
    F : (m', 3) int64, closed if the input was; all vertices are used

    Raises
    ------
    OutputError
        A point is not finite.
    """
    return all_printable([(V, F)])[0]


def all_printable(solids: Sequence[tuple[Floats, Ints]]) -> list[tuple[Floats, Ints]]:
    """Make solids survive being written as STL and read back, see `printable`; quicker than one by one."""
    if not all(np.isfinite(V).all() for V, _ in solids):
        raise OutputError("a piece has points that are not finite", hint="please report this model")
    sizes = np.array([len(V) for V, _ in solids], np.int64)
    of, first = row_of(sizes), starts(sizes)
    none_V, none_F = np.zeros((0, 3)), np.zeros((0, 3), np.int64)
    V = _rounded(np.concatenate([none_V, *(V for V, _ in solids)]))
    F = without_degenerate(
        np.concatenate([none_F, *(F + k for (_, F), k in zip(solids, first, strict=True))])
    )
    for piece in np.unique(of[_on_open_edges(F)]).tolist():
        own = first[piece] + np.arange(sizes[piece])
        same = np.arange(len(V))
        same[own] = own[_first_equal(V[own])]
        F = without_degenerate(same[F])
    F, low = without_short_edges(V, F, _SHORTEST, low_faces(V, F, _SHORTEST))
    F = without_needles(V, F, _SHORTEST, low)
    F, kept = compact(F)
    return _parted(V[kept], F, of[kept], len(solids))


def _parted(V: Floats, F: Ints, of: Ints, n: int) -> list[tuple[Floats, Ints]]:
    """Take n solids apart, by what each vertex is of, and points that coincide in one of them as well."""
    of_V, of_F = (np.append(0, np.cumsum(np.bincount(x, minlength=n))) for x in (of, of[F[:, 0]]))
    twice = set(of[_with_a_twin(V, of)].tolist())
    made = []
    for k in range(n):
        W, G = V[slice(*of_V[k : k + 2])], F[slice(*of_F[k : k + 2])] - of_V[k]
        made.append((_moved_apart(W, G) if k in twice else W, G))
    return made


def _rounded(V: Floats) -> Floats:
    return V.astype(np.float32).astype(np.float64) + 0.0  # -0 becomes 0: readers compare bytes


def _as_read(V: Floats) -> Floats:
    return np.round(V, _DECIMALS) + 0.0


def _on_open_edges(F: Ints) -> Ints:
    """Give a vertex of every edge that has not exactly two faces."""
    a, b = F.ravel(), F[:, [1, 2, 0]].ravel()
    bits = int(F.max(initial=0)).bit_length()
    key = np.sort((np.minimum(a, b) << bits) | np.maximum(a, b))
    start = np.flatnonzero(np.diff(key, prepend=-1))
    return key[start[np.diff(start, append=len(key)) != 2]] >> bits


def _with_a_twin(V: Floats, of: Ints) -> Ints:
    """Give points that may coincide with another one of the same piece, at least one of each such two."""
    name = (
        _as_read(V).astype(np.float32).view(np.uint32).astype(np.uint64) @ _MIX[:3]
        + of.astype(np.uint64) * _MIX[3]
    )
    order = np.argsort(name)
    return order[1:][np.diff(name[order]) == 0]


def _first_equal(V: Floats) -> Ints:
    """Give for each point the first one with the same value, as readers see it, (n,)."""
    V = _as_read(V)
    order = np.lexsort(V.T)
    new = np.ones(len(V), bool)
    new[1:] = (V[order[1:]] != V[order[:-1]]).any(axis=1)
    first = np.empty(len(V), np.int64)
    first[order] = order[new][
        np.cumsum(new) - 1
    ]  # lexsort is stable: the first of a run has the least number
    return first


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
