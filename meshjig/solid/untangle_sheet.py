"""Unfold an inner sheet: rounds that smooth it, and at last draw it nearer, where it flips or crosses."""

from __future__ import annotations

from typing import Any

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.measure import area_vectors, unit
from meshjig.solid.crossing_pairs import at_any_corner, cell_size, crossing_pairs, near
from meshjig.solid.directions import visible_directions
from meshjig.solid.vertex_patches import Patches, part_around

__all__ = ["flipped", "unfold"]

_FLIP_ROUNDS = 4  # rounds that look at flips alone, which are cheap to find
_SMOOTH_ROUNDS = 9  # rounds that smooth; later ones retreat towards the outer sheet
_MAX_ROUNDS = 24
_PATIENCE = 8  # rounds without progress
_PASSES = 3  # looks at the sheet as a whole
_PART = 4.0  # of the thickness: how far around a bad face the sheet may move or be met
_SHORTEST = 0.06  # mm, where retreating ends


def unfold(
    V: Floats, F: Ints, D: Floats, thickness: float, clear: Floats | None = None
) -> tuple[Floats, dict[str, Any]]:
    """Move an inner sheet until it neither flips nor crosses itself or the outer sheet.

    Parameters
    ----------
    V : (n, 3) float64, mm, the outer sheet
    F : (m, 3) int64
    D : (n, 3) float64, mm; V + D is the inner sheet
    thickness : float, mm, what D aims at
    clear : (n,) float64, mm, how far V + D is from the outer sheet; spares tests where it is known

    Returns
    -------
    D : (n, 3) float64
    facts : {"folds_left": faces that still flip or cross, "crossings_left": those that cross,
        "outer_crossings": faces near crossings at which the outer sheet itself crosses, "rounds": int}

    Notes
    -----
    Smoothing works on inner positions, not on D: it spreads vertices that have run into each other, and
    leaves the sheet smooth. Where far parts of the surface meet, D is shortened as well. What still crosses
    then retreats to the outer sheet along directions that see all faces around their vertex: short enough,
    such a sheet crosses nothing. A flip alone is left then: under an overhang finer than the thickness it
    means that D leans, not that the sheets meet. Crossings of the outer sheet with itself, and what crosses
    them, are left alone and not counted.

    The whole sheet is looked at once; rounds then work on the part around what is bad.
    """
    m, cell = len(F), cell_size(V, F, thickness)
    both = np.concatenate([F, F + len(V)])
    start = D
    D, rounds = _settled(V, F, D, flipped(V, F, D), None, np.zeros(m, bool), thickness, 0)
    clear = np.where((start != D).any(1), 0.0, 0.0 if clear is None else clear)
    pairs, hopeless = _listed(V, V + D, F, clear, cell)
    for _ in range(_PASSES):
        hit, flips = _hit(pairs, hopeless), flipped(V, F, D)
        bad = hit | (flips & (rounds < _SMOOTH_ROUNDS))
        if not bad.any() or rounds >= _MAX_ROUNDS:
            break
        before = D
        D, rounds = _settled(V, F, D, bad, pairs, hopeless, thickness, rounds)
        changed = at_any_corner((before != D).any(1), F)
        pairs = _renewed(V, V + D, both, pairs, changed, cell)
    hit, flips = _hit(pairs, hopeless), flipped(V, F, D)
    facts = {
        "folds_left": int((flips | hit).sum()),
        "crossings_left": int(hit.sum()),
        "outer_crossings": int(hopeless.sum()),
        "rounds": rounds,
    }
    return D, facts


def _listed(V: Floats, inner: Floats, F: Ints, clear: Floats, cell: float) -> tuple[Ints, Bools]:
    """List all crossings of the inner sheet, and mark the faces around them that cross on the outer sheet."""
    m = len(F)
    X, both = np.concatenate([V, inner]), np.concatenate([F, F + len(V)])
    close = np.concatenate([np.zeros(m, bool), clear[F].min(1) <= _longest_edges(inner, F)])
    some = np.flatnonzero(np.concatenate([near(X, both, close, cell)[:m], np.ones(m, bool)]))
    pairs = some[crossing_pairs(X, both[some])[0]]
    pairs = pairs[(pairs >= m).any(1)]
    hit = np.zeros(m, bool)
    hit[pairs.ravel() % m] = True
    some = np.flatnonzero(near(V, F, hit, cell))
    hopeless = np.zeros(m, bool)
    hopeless[some[crossing_pairs(V, F[some])[0].ravel()]] = True
    return pairs, hopeless


def _longest_edges(V: Floats, F: Ints) -> Floats:
    corner = V[F]
    return np.sqrt(((corner - corner[:, [1, 2, 0]]) ** 2).sum(2).max(1))


def _settled(
    V: Floats,
    F: Ints,
    D: Floats,
    bad: Bools,
    pairs: Ints | None,
    hopeless: Bools,
    thickness: float,
    rounds: int,
) -> tuple[Floats, int]:
    """Run the rounds on the part of the mesh around bad faces; without pairs, those for flips alone."""
    if not bad.any():
        return D, rounds
    part = part_around(V, F, bad, _PART * thickness)
    if pairs is not None:
        pairs = part.inside(pairs, len(F))
    E, rounds = _rounds(
        V[part.vertices], part.F, D[part.vertices], part.held, pairs, hopeless[part.faces], thickness, rounds
    )
    D = D.copy()
    D[part.vertices] = E
    return D, rounds


def _rounds(
    V: Floats,
    F: Ints,
    D: Floats,
    held: Bools,
    pairs: Ints | None,
    hopeless: Bools,
    thickness: float,
    rounds: int,
) -> tuple[Floats, int]:
    """Smooth, then retreat, until nothing is bad; give D and the rounds so far."""
    patches = Patches(V, F, held)
    both, cell = np.concatenate([F, F + len(V)]), cell_size(V, F, thickness)
    flips = flipped(V, F, D)
    least, since = len(F) + 1, 0
    last = _FLIP_ROUNDS if pairs is None else _MAX_ROUNDS
    while rounds < last:
        hit = _hit(pairs, hopeless) if pairs is not None else np.zeros(len(F), bool)
        bad = hit if rounds >= _SMOOTH_ROUNDS else hit | flips
        since = 0 if bad.sum() < least or rounds == _SMOOTH_ROUNDS else since + 1
        least = min(least, int(bad.sum()))
        if not bad.any() or since > _PATIENCE:
            return D, rounds
        before = D
        if rounds < _SMOOTH_ROUNDS:
            D = _smoothed(V, D, patches, np.unique(F[bad]), thickness, rounds)
            if pairs is not None:
                D = _shortened(V, F, D, patches, pairs % len(F), thickness)
        else:
            D = _retreated(V, F, D, patches, np.unique(F[bad]), thickness)
        changed = at_any_corner((before != D).any(1), F)
        flips[changed] = flipped(V, F[changed], D)
        if pairs is not None:
            pairs = _renewed(V, V + D, both, pairs, changed, cell)
        rounds += 1
    return D, rounds


def _hit(pairs: Ints, hopeless: Bools) -> Bools:
    """Mark faces that cross, but those that the outer sheet itself spoils."""
    hit = np.zeros(len(hopeless), bool)
    hit[pairs[~hopeless[pairs % len(hopeless)].any(1)].ravel() % len(hopeless)] = True
    return hit


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
