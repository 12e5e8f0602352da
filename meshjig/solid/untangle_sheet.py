"""Unfold an inner sheet: rounds that smooth it, and at last draw it nearer, where it flips or crosses."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.measure import area_vectors, unit
from meshjig.solid.crossing_pairs import at_any_corner, cell_size, crossing_pairs, near
from meshjig.solid.directions import visible_directions
from meshjig.solid.vertex_patches import VertexPatches, submesh_around

__all__ = ["FoldFacts", "flipped", "untangle_sheet"]

_FLIP_ROUNDS = 4  # rounds that look at flips alone, which are cheap to find
_SMOOTH_ROUNDS = 9  # rounds that smooth; later ones retreat towards the outer sheet
_MAX_ROUNDS = 24
_PATIENCE = 8  # rounds without progress
_PASSES = 3  # looks at the sheet as a whole
_PART = 4.0  # of the thickness: how far around a bad face the sheet may move or be met
_SHORTEST = 0.06  # mm, where retreating ends


class FoldFacts(NamedTuple):
    """What untangling has left, and how long it took."""

    folds_left: int  # faces that still flip or cross
    crossings_left: int  # those that cross
    outer_crossings: int  # faces near crossings at which the outer sheet itself crosses
    rounds: int


def untangle_sheet(
    V: Floats, F: Ints, D: Floats, thickness: float, clear: Floats | None = None
) -> tuple[Floats, FoldFacts]:
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
    facts : FoldFacts

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
    outer = _Outer(V, F, thickness, np.zeros(len(F), bool), np.zeros(len(V), bool))
    start = D
    D, rounds = _settled(outer, D, flipped(V, F, D), None, 0)
    clear = np.where((start != D).any(1), 0.0, 0.0 if clear is None else clear)
    pairs, hopeless = _listed(outer, V + D, clear)
    outer = replace(outer, hopeless=hopeless)
    for _ in range(_PASSES):
        hit, flips = _hit(pairs, hopeless), flipped(V, F, D)
        bad = hit | (flips & (rounds < _SMOOTH_ROUNDS))
        if not bad.any() or rounds >= _MAX_ROUNDS:
            break
        before = D
        D, rounds = _settled(outer, D, bad, pairs, rounds)
        changed = at_any_corner((before != D).any(1), F)
        pairs = _renewed(outer, V + D, pairs, changed)
    hit, flips = _hit(pairs, hopeless), flipped(V, F, D)
    return D, FoldFacts(int((flips | hit).sum()), int(hit.sum()), int(hopeless.sum()), rounds)


@dataclass(frozen=True)
class _Outer:
    """The outer sheet, or a part of it."""

    V: Floats  # (n, 3), mm
    F: Ints  # (m, 3)
    thickness: float  # mm
    hopeless: Bools  # (m,), faces that cross themselves
    held: Bools  # (n,), vertices whose D stays

    @cached_property
    def both(self) -> Ints:
        """The faces of both sheets, those of the inner one after the outer ones', (2 m, 3)."""
        return np.concatenate([self.F, self.F + len(self.V)])

    @cached_property
    def cell(self) -> float:
        """The edge of a box, mm, that all but a few faces fit into."""
        return cell_size(self.V, self.F, self.thickness)


def _listed(outer: _Outer, inner: Floats, clear: Floats) -> tuple[Ints, Bools]:
    """List all crossings of the inner sheet, and mark the faces around them that cross on the outer sheet."""
    V, F, both, cell, m = outer.V, outer.F, outer.both, outer.cell, len(outer.F)
    X = np.concatenate([V, inner])
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


def _settled(outer: _Outer, D: Floats, bad: Bools, pairs: Ints | None, rounds: int) -> tuple[Floats, int]:
    """Run the rounds on the part of the mesh around bad faces; without pairs, those for flips alone."""
    if not bad.any():
        return D, rounds
    part = submesh_around(outer.V, outer.F, bad, _PART * outer.thickness)
    if pairs is not None:
        pairs = part.inside(pairs, len(outer.F))
    inside = _Outer(outer.V[part.vertices], part.F, outer.thickness, outer.hopeless[part.faces], part.held)
    E, rounds = _rounds(inside, D[part.vertices], pairs, rounds)
    D = D.copy()
    D[part.vertices] = E
    return D, rounds


def _rounds(outer: _Outer, D: Floats, pairs: Ints | None, rounds: int) -> tuple[Floats, int]:
    """Smooth, then retreat, until nothing is bad; give D and the rounds so far."""
    V, F = outer.V, outer.F
    patches = VertexPatches(V, F, outer.held)
    flips = flipped(V, F, D)
    least, since = len(F) + 1, 0
    last = _FLIP_ROUNDS if pairs is None else _MAX_ROUNDS
    while rounds < last:
        hit = _hit(pairs, outer.hopeless) if pairs is not None else np.zeros(len(F), bool)
        bad = hit if rounds >= _SMOOTH_ROUNDS else hit | flips
        since = 0 if bad.sum() < least or rounds == _SMOOTH_ROUNDS else since + 1
        least = min(least, int(bad.sum()))
        if not bad.any() or since > _PATIENCE:
            return D, rounds
        before = D
        if rounds < _SMOOTH_ROUNDS:
            D = _smoothed(outer, D, patches, np.unique(F[bad]), rounds)
            if pairs is not None:
                D = _shortened(outer, D, patches, pairs % len(F))
        else:
            D = _retreated(outer, D, patches, np.unique(F[bad]))
        changed = at_any_corner((before != D).any(1), F)
        flips[changed] = flipped(V, F[changed], D)
        if pairs is not None:
            pairs = _renewed(outer, V + D, pairs, changed)
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


def _renewed(outer: _Outer, inner: Floats, known: Ints, changed: Bools) -> Ints:
    """Bring a list of crossing pairs up to date, testing only what moved against what is near."""
    X, both = np.concatenate([outer.V, inner]), outer.both
    active = np.concatenate([np.zeros(len(changed), bool), changed])
    some = np.flatnonzero(near(X, both, active, outer.cell))
    pairs = some[crossing_pairs(X, both[some])[0]]
    still = known[~active[known].any(1)]
    return np.concatenate([still, pairs[active[pairs].any(1)]])


def _smoothed(outer: _Outer, D: Floats, patches: VertexPatches, core: Ints, round_: int) -> Floats:
    """Smooth inner positions around the core; where edges are long rather D, which moves less."""
    V, thickness = outer.V, outer.thickness
    patch = patches.around(core, 0.4 * thickness * (2 + round_ // 4))
    scale = (0.5 if round_ < 4 else 0.7) * thickness
    share = 0.75 * np.clip(1.75 - patches.edge[patch] / thickness, 0.0, 1.0)[:, None]
    positions = patches.smoothed(V + D, scale, patch) - V[patch]
    D = D.copy()
    D[patch] = share * positions + (1 - share) * patches.smoothed(D, scale, patch)
    return D


def _shortened(outer: _Outer, D: Floats, patches: VertexPatches, pairs: Ints) -> Floats:
    """Draw D in where faces cross that are far apart on the outer sheet: two walls share the room."""
    V, F, thickness = outer.V, outer.F, outer.thickness
    centre = V[F[pairs]].mean(2)
    met = pairs[np.linalg.norm(centre[:, 0] - centre[:, 1], axis=1) > 1.2 * thickness]
    if not len(met):
        return D
    patch, weight = patches.bump(np.unique(F[met]), 0.3 * thickness)
    weight = weight * (np.linalg.norm(D[patch], axis=1, keepdims=True) > 5 * _SHORTEST)
    D = D.copy()
    D[patch] *= 1 - 0.1 * weight
    return D


def _retreated(outer: _Outer, D: Floats, patches: VertexPatches, core: Ints) -> Floats:
    """Shorten D at the core, turn it to where it sees the faces around, and blend it into the rest."""
    V, F, thickness = outer.V, outer.F, outer.thickness
    patch, weight = patches.bump(core, 0.3 * thickness)
    weight = weight * (np.linalg.norm(D[patch], axis=1, keepdims=True) > _SHORTEST)
    D = D.copy()
    D[patch] *= 1 - 0.25 * weight
    length = np.linalg.norm(D[core], axis=1, keepdims=True)
    D[core] = length * unit(unit(D[core]) - visible_directions(V, F, core, -D[core]))
    rest = np.setdiff1d(patch, core)
    D[rest] = 0.6 * D[rest] + 0.4 * patches.smoothed(D, 0.3 * thickness, rest)
    return D
