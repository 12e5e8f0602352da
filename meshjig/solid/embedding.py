"""Unfold an inner sheet: rounds that smooth it, and at last draw it nearer, where it flips or crosses."""

from __future__ import annotations

from typing import Any

import numpy as np

from meshjig.measure import area_vectors, unit
from meshjig.solid.crossings import at_any_corner, crossing_pairs, near
from meshjig.solid.smoothing import Smoother
from meshjig.solid.visible import visible_directions
from meshjig.types import Bools, Floats, Ints

__all__ = ["flipped", "unfold"]

_FLIP_ROUNDS = 4  # rounds that look at flips alone, which are cheap to find
_SMOOTH_ROUNDS = 9  # rounds that smooth; later ones retreat towards the outer sheet
_MAX_ROUNDS = 24
_SHORTEST = 0.06  # mm, where retreating ends


def unfold(
    V: Floats, F: Ints, D: Floats, thickness: float, smoother: Smoother
) -> tuple[Floats, dict[str, Any]]:
    """Move an inner sheet until it neither flips nor crosses itself or the outer sheet.

    Parameters
    ----------
    V : (n, 3) float64, mm, the outer sheet
    F : (m, 3) int64
    D : (n, 3) float64, mm; V + D is the inner sheet
    thickness : float, mm, what D aims at
    smoother : Smoother of the outer sheet

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
    patches = Patches(F, n)
    edge = _mean_edges(V, F)
    follow = (0.75 * np.clip(1.75 - edge / thickness, 0.0, 1.0))[:, None]
    centre = V[F].mean(1)
    both = np.concatenate([F, F + n])
    cell = max(thickness, 2 * float(edge.mean()))
    ring = float(edge.mean())
    global RING;RING=ring
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
            patch = patches.around(F[bad], (2 + rounds // 4) * max(1.0, 0.4 * thickness / ring))
            scale = max((.5 if rounds < 4 else .7) * thickness, 0.8 * ring)
            D = _smoothed(V, D, smoother, follow, patch, scale)
            if rounds >= 2:
                D = _shortened(D, F, pairs % m, centre, 1.2 * thickness, patches, smoother, scale)
        else:
            D = _retreated(V, F, D, patches, smoother, bad, 0.3*thickness)
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


def _mean_edges(V: Floats, F: Ints) -> Floats:
    length = np.linalg.norm(V[F] - V[F[:, [1, 2, 0]]], axis=2)
    count = np.maximum(np.bincount(F.ravel(), minlength=len(V)), 1)
    return np.bincount(F.ravel(), length.ravel(), len(V)) / count


def _smoothed(V,D,smoother,follow,v,scale):
    inner = smoother.inside(V + D, scale, v) - V[v]
    E=D.copy()
    E[v] = follow[v] * inner + (1 - follow[v]) * smoother.inside(D, scale, v)
    return E


def _soft(n,core,patches,smoother,scale,ring):
    w=np.zeros(n);w[core]=1.
    v=patches.around(core,max(1.,2*scale/ring))
    w[v]=np.minimum(1.,2*smoother.inside(w,max(scale,.5*ring),v));w[core]=1.
    return w,v


def _shortened(D,F,pairs,centre,far,patches,smoother,scale):
    apart = np.linalg.norm(centre[pairs[:, 0]] - centre[pairs[:, 1]], axis=1)
    met = pairs[apart > far].ravel()
    if not len(met):
        return D
    w,_=_soft(len(D),np.unique(F[met]),patches,smoother,.5*scale,RING)
    w[np.linalg.norm(D, axis=1) < 5 * _SHORTEST] = 0.0
    return D * (1 - 0.1 * w)[:, None]


def _retreated(V,F,D,patches,smoother,bad,scale):
    core = np.unique(F[bad])
    w,v=_soft(len(D),core,patches,smoother,scale,RING)
    length=np.linalg.norm(D,axis=1)
    D = D*np.where(length > _SHORTEST,1-.25*w,1.)[:,None]
    l=np.linalg.norm(D[core],axis=1)
    D[core] = l[:, None] * unit(unit(D[core]) - visible_directions(V, F, core, -D[core]))
    rest=np.setdiff1d(v,core)
    D[rest]=.6*D[rest]+.4*smoother.inside(D,max(scale,.8*RING),rest)
    return D


class Patches:
    def __init__(self,F,n):
        from scipy.sparse import coo_matrix
        i, j = F.ravel(), F[:, [1, 2, 0]].ravel()
        self.A=coo_matrix((np.ones(2*len(i),np.int8),(np.concatenate([i,j]),np.concatenate([j,i]))),shape=(n,n)).tocsr()
    def around(self,core,rings):
        mark=np.zeros(self.A.shape[0],bool);front=np.unique(core);mark[front]=True
        for _ in range(int(np.ceil(rings))):
            near_=np.unique(self.A[front].indices);front=near_[~mark[near_]];mark[front]=True
        return np.flatnonzero(mark)
