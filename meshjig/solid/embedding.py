"""Unfold an inner sheet: rounds that smooth it, and at last draw it nearer, where it flips or crosses."""

from __future__ import annotations

from typing import Any

import numpy as np

from meshjig.measure import area_vectors, unit
from meshjig.solid.crossings import at_any_corner, crossing_pairs, near
from meshjig.solid.patches import Patches
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
    them, are left alone and not counted.
    """
    m = len(F)
    patches = Patches(V, F)
    both = np.concatenate([F, F + len(V)])
    cell = max(thickness, 2 * patches.mean_edge)
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
            D = _smoothed(V, D, patches, np.unique(F[bad]), thickness, rounds)
            if rounds >= 2:
                D = _shortened(V, F, D, patches, pairs % m, thickness)
        else:
            D = _retreated(V, F, D, patches, np.unique(F[bad]), thickness)
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


def _smoothed(V: Floats, D: Floats, patches: Patches, core: Ints, thickness: float, round_: int) -> Floats:
    """Smooth inner positions around the core; where edges are long rather D, which moves less."""
    patch = patches.around(core, 0.4 * thickness * (2 + round_ // 4))
    scale = (0.5 if round_ < 4 else 0.7) * thickness
    share = 0.75 * np.clip(1.75 - patches.edge[patch] / thickness, 0.0, 1.0)[:, None]
    positions = patches.smoothed(V + D, scale, patch) - V[patch]
    D = D.copy()
    D[patch] = share * positions + (1 - share) * patches.smoothed(D, scale, patch)
    return D


def _shortened(V: Floats, F: Ints, D: Floats, patches: Patches, pairs: Ints, thickness: float) -> Floats:
    """Draw D in where faces cross that are far apart on the outer sheet: two walls share the room."""
    centre = V[F[pairs]].mean(2)
    met = pairs[np.linalg.norm(centre[:, 0] - centre[:, 1], axis=1) > 1.2 * thickness]
    if not len(met):
        return D
    patch, weight = patches.bump(np.unique(F[met]), 0.3 * thickness)
    weight = weight * (np.linalg.norm(D[patch], axis=1, keepdims=True) > 5 * _SHORTEST)
    D = D.copy()
    D[patch] *= 1 - 0.1 * weight
    return D


def _retreated(V: Floats, F: Ints, D: Floats, patches: Patches, core: Ints, thickness: float) -> Floats:
    """Shorten D at the core, turn it to where it sees the faces around, and blend it into the rest."""
    patch, weight = patches.bump(core, 0.3 * thickness)
    weight = weight * (np.linalg.norm(D[patch], axis=1, keepdims=True) > _SHORTEST)
    D = D.copy()
    D[patch] *= 1 - 0.25 * weight
    length = np.linalg.norm(D[core], axis=1, keepdims=True)
    D[core] = length * unit(unit(D[core]) - visible_directions(V, F, core, -D[core]))
    rest = np.setdiff1d(patch, core)
    D[rest] = 0.6 * D[rest] + 0.4 * patches.smoothed(D, 0.3 * thickness, rest)
    return D
