"""Unfold an inner sheet: rounds that smooth it, and at last draw it nearer, where it flips or crosses."""

from __future__ import annotations

from typing import Any

import numpy as np

from meshjig.measure import area_vectors, unit
from meshjig.solid.crossings import at_any_corner, crossing_pairs, near
from meshjig.solid.visible import visible_directions
from meshjig.types import Bools, Floats, Ints

__all__ = ["flipped", "unfold"]

_FLIP_ROUNDS = 4  # rounds that look at flips alone, which are cheap to find
_SMOOTH_ROUNDS = 9  # rounds that smooth; later ones retreat towards the outer sheet
_MAX_ROUNDS = 24
_SHORTEST = 0.06  # mm, where retreating ends


def unfold(V: Floats, F: Ints, D: Floats, thickness: float) -> tuple[Floats, dict[str, Any]]:
    """Move an inner sheet until it neither flips nor crosses itself or the outer sheet.

    Parameters
    ----------
    V : (n, 3) float64, mm, the outer sheet
    F : (m, 3) int64
    D : (n, 3) float64, mm; V + D is the inner sheet
    thickness : float, mm, what D aims at

    Returns
    -------
    D : (n, 3) float64
    facts : {"folds_left": faces that still flip or cross, "crossings_left": those that cross, "rounds": int}

    Notes
    -----
    Smoothing works on inner positions, not on D: it spreads vertices that have run into each other, and
    leaves the sheet smooth. Where far parts of the surface meet, D is shortened as well. What still crosses
    then retreats to the outer sheet along directions that see all faces around their vertex: short enough,
    such a sheet crosses nothing. A flip alone is left then: under an overhang finer than the thickness it
    means that D leans, not that the sheets meet. Crossings of the outer sheet with itself, and what crosses
    them, are left alone.
    """
    n, m = len(V), len(F)
    mean = _neighbour_mean(F, n)
    follow = _position_share(V, F, thickness)
    centre = V[F].mean(1)
    both = np.concatenate([F, F + n])
    cell = max(thickness, 2 * float(np.linalg.norm(V[F[:, 0]] - V[F[:, 1]], axis=1).mean()))
    flips = flipped(V, F, D)
    pairs = np.empty((0, 2), np.int64)
    hopeless = np.zeros(m, bool)  # where the outer sheet crosses itself
    changed: Bools | None = None  # faces whose inner side moved since the crossings were last listed
    rounds = 0
    while True:
        if rounds >= _FLIP_ROUNDS or not flips.any():
            if changed is None:
                pairs = crossing_pairs(np.concatenate([V, V + D]), both)[0]
                hopeless[pairs[(pairs < m).all(1)].ravel()] = True
            else:
                pairs = _renewed(V, V + D, both, pairs, changed, cell)
            pairs = pairs[(pairs >= m).any(1)]
            changed = np.zeros(m, bool)
        hit = np.zeros(m, bool)
        hit[pairs[~hopeless[pairs % m].any(1)].ravel() % m] = True
        bad = hit if rounds >= _SMOOTH_ROUNDS else hit | flips
        if not bad.any() or rounds == _MAX_ROUNDS:
            break
        before = D
        if rounds < _SMOOTH_ROUNDS:
            passes = 4 if rounds < 4 else 8
            D = _smoothed(V, D, mean, follow, _around(F, bad, mean, 2 + rounds // 4), passes)
            if rounds >= 2:
                D = _shortened(D, F, pairs % m, centre, 1.2 * thickness, mean)
        else:
            D = _retreated(V, F, D, mean, bad)
        moved = at_any_corner((before != D).any(1), F)
        touched = np.flatnonzero(moved)
        flips[touched] = flipped(V, F[touched], D)
        changed = None if changed is None else changed | moved
        rounds += 1
    return D, {"folds_left": int((flips | hit).sum()), "crossings_left": int(hit.sum()), "rounds": rounds}


def flipped(V: Floats, F: Ints, D: Floats) -> Bools:
    """Mark faces whose inner side is turned over, on edge, or collapsed; (m,) bool."""
    outer, inner = area_vectors(V, F), area_vectors(V + D, F)
    inward = unit(D)[F].sum(1)
    inward /= np.maximum(np.linalg.norm(inward, axis=1), 1e-300)[:, None]
    area = np.linalg.norm(inner, axis=1)
    collapsed = area < 0.01 * np.linalg.norm(outer, axis=1)
    return collapsed | (np.einsum("ij,ij->i", inner, inward) >= -0.1 * area)


def _renewed(V: Floats, inner: Floats, both: Ints, known: Ints, changed: Bools, cell: float) -> Ints:
    """Bring a list of crossing pairs up to date, testing only what moved against what is near."""
    X = np.concatenate([V, inner])
    active = np.concatenate([np.zeros(len(changed), bool), changed])
    some = np.flatnonzero(near(X, both, active, cell))
    pairs = some[crossing_pairs(X, both[some])[0]]
    still = known[~active[known].any(1)]
    return np.concatenate([still, pairs[active[pairs].any(1)]])


def _neighbour_mean(F: Ints, n: int) -> Any:
    """Give the (n, n) sparse matrix that averages over the neighbours of a vertex."""
    from scipy.sparse import coo_matrix, diags

    i, j = F.ravel(), F[:, [1, 2, 0]].ravel()
    ones = np.ones(2 * len(i))
    A = coo_matrix((ones, (np.concatenate([i, j]), np.concatenate([j, i]))), shape=(n, n)).tocsr()
    A.data[:] = 1.0
    return (diags(1.0 / np.maximum(np.asarray(A.sum(1)).ravel(), 1.0)) @ A).tocsr()


def _around(F: Ints, bad: Bools, mean: Any, rings: int) -> Ints:
    """List the vertices of bad faces and of some rings around them."""
    mark = np.zeros(mean.shape[0], bool)
    mark[F[bad].ravel()] = True
    for _ in range(rings):
        mark |= (mean @ mark.astype(np.float64)) > 0
    return np.flatnonzero(mark)


def _position_share(V: Floats, F: Ints, thickness: float) -> Floats:
    """Tell how far inner positions, instead of D, may be smoothed: not where edges are long.

    A step of smoothing moves vertices by a share of the edge length, and may not carry them to the outer sheet.
    """
    length = np.linalg.norm(V[F] - V[F[:, [1, 2, 0]]], axis=2)
    count = np.maximum(np.bincount(F.ravel(), minlength=len(V)), 1)
    edge = np.bincount(F.ravel(), length.ravel(), len(V)) / count
    return (0.75 * np.clip(1.75 - edge / thickness, 0.0, 1.0))[:, None]


def _smoothed(V: Floats, D: Floats, mean: Any, follow: Floats, v: Ints, passes: int) -> Floats:
    rows = mean[v]
    inner = V + D
    for _ in range(passes):
        inner[v] = 0.3 * inner[v] + 0.7 * (rows @ inner)
    D = D.copy()
    D[v] = follow[v] * (inner[v] - V[v]) + (1 - follow[v]) * (rows @ (mean @ D))
    return D


def _shortened(D: Floats, F: Ints, pairs: Ints, centre: Floats, far: float, mean: Any) -> Floats:
    """Draw D in where faces cross that are far apart on the outer sheet: two walls share the room."""
    apart = np.linalg.norm(centre[pairs[:, 0]] - centre[pairs[:, 1]], axis=1)
    met = pairs[apart > far].ravel()
    if not len(met):
        return D
    weight = np.zeros(len(D))
    weight[F[met].ravel()] = 1.0
    weight = np.maximum(weight, mean @ weight)
    weight[np.linalg.norm(D, axis=1) < 5 * _SHORTEST] = 0.0
    return D * (1 - 0.1 * weight)[:, None]


def _retreated(V: Floats, F: Ints, D: Floats, mean: Any, bad: Bools) -> Floats:
    """Shorten D at bad faces, turn it to where it sees the faces around, and blend it into the rest."""
    core = np.unique(F[bad])
    v = _around(F, bad, mean, 1)
    D = D.copy()
    length = np.linalg.norm(D[core], axis=1)
    way = unit(unit(D[core]) - visible_directions(V, F, core, -D[core]))
    D[core] = np.where(length > _SHORTEST, 0.75 * length, length)[:, None] * way
    rest = np.setdiff1d(v, core)
    D[rest] = 0.6 * D[rest] + 0.4 * (mean[rest] @ D)
    return D
