"""Lay an inner sheet deep again where untangling has drawn it too near to the outer one."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.measure import sums
from meshjig.mesh.mesh import Mesh
from meshjig.solid.crossing_pairs import at_any_corner, cell_size, crossing_pairs, near
from meshjig.solid.surface_distance import SurfaceDistance
from meshjig.solid.untangle_sheet import flipped
from meshjig.solid.vertex_patches import VertexPatches, submesh_around

__all__ = ["restore_depth"]

_TOO_NEAR = 0.7  # of the depth that was aimed at
_WORTH = 0.5  # of the thickness: where less was aimed at, the model is too thin for walls anyway
_LOOKS = 2  # at what is too near
_RADIUS = 1.0  # of the thickness: how far around what is too near the sheet is laid anew
_REACH = 2.0  # of the thickness, beyond that: what it may meet there
_STEPS = 14  # of relaxing
_SOFT = 0.5  # of the way to the depth, in the later half of the steps: what jags goes
_FLIP_TRIES = 3  # tries that smooth flips as well as crossings
_SMOOTH_TRIES = 8  # tries that smooth; later ones go back to the old sheet
_HALF_TRIES = 11  # tries after which they go all the way back
_TRIES = 14
_GROWTH = 0.3  # of the thickness: how far around a crossing the first tries smooth
_WIDE = 0.75  # of the thickness: a face with a longer edge is looked at inside, too
_INSIDE = np.array([[2, 2, 2], [3, 3, 0], [0, 3, 3], [3, 0, 3]]) / 6  # where, barycentric
_SCALE = 0.5  # of the thickness, of smoothing


def restore_depth(
    mesh: Mesh, D: Floats, distance: Floats, aimed: Floats, thickness: float, surface: SurfaceDistance
) -> Floats:
    """Lay an inner sheet anew where it is nearer to the outer one than 0.7 of what was aimed at.

    There it becomes a membrane that hangs in the sheet around it, at the depth that was aimed at: vertices
    move to the middle of their neighbours and then to that depth, in turn. Where it crosses something it
    is smoothed, and at last drawn back to the old sheet. A patch that still crosses, or is no deeper than
    before, stays as it was.

    Parameters
    ----------
    mesh : Mesh, mm, the outer sheet
    D : (n, 3) float64, mm; V + D is the inner sheet
    distance : (n,) float64, mm, of V + D from the outer sheet
    aimed : (n,) float64, mm, the distance that it should have
    thickness : float, mm
    surface : SurfaceDistance, of the mesh

    Returns
    -------
    (n, 3) float64, D, the same but in patches around what was too near

    Notes
    -----
    Faces that cross afterwards crossed before. Flips alone may be more: D leans there.
    """
    V, F = mesh
    for _ in range(_LOOKS):
        squeezed = (distance < _TOO_NEAR * aimed) & (aimed > _WORTH * thickness)
        if not squeezed.any():
            break
        part = submesh_around(V, F, at_any_corner(squeezed, F), (_RADIUS + _REACH) * thickness)
        v = part.vertices
        patches = VertexPatches(V[v], part.F, part.held)
        patch = patches.around(np.flatnonzero(squeezed[v]), _RADIUS * thickness)
        if not len(patch):
            break
        wide = _wide(V[v], part.F, patch, _WIDE * thickness)
        sheet = _Sheet(V[v], part.F, aimed[v], thickness, surface, patches, patch, wide)
        D, distance = D.copy(), distance.copy()
        D[v], distance[v] = sheet.restored(D[v], distance[v])
    return D


def _wide(V: Floats, F: Ints, patch: Ints, longest: float) -> Ints:
    """List the faces at a patch that have a longer edge, (l, 3)."""
    mark = np.zeros(len(V), bool)
    mark[patch] = True
    G = F[at_any_corner(mark, F)]
    corner = V[G]
    return G[np.linalg.norm(corner - corner[:, [1, 2, 0]], axis=2).max(1) > longest]


@dataclass(frozen=True)
class _Sheet:
    """The part of a sheet around patches of it that are laid anew."""

    V: Floats  # (n, 3), mm
    F: Ints  # (m, 3)
    aimed: Floats  # (n,), mm
    thickness: float  # mm
    surface: SurfaceDistance
    patches: VertexPatches
    patch: Ints  # (k,), vertices
    wide: Ints  # (l, 3), faces at the patches that the sheet may cut a corner with

    def restored(self, D: Floats, distance: Floats) -> tuple[Floats, Floats]:
        """Give D, and the distance it comes to, (n,), mm."""
        active = np.zeros(len(self.V), bool)
        active[self.patch] = True
        active = at_any_corner(active, self.F)
        E = self._relaxed(D)
        pairs = self._pairs(E, active)
        crossed = self._hit(self._pairs(D, active) if len(pairs) else pairs)
        E, pairs = self._settled(D, E, pairs, crossed)
        found = distance.copy()
        found[self.patch] = self.surface.distance((self.V + E)[self.patch])
        component = self.patches.components(self.patch)
        old = self._lack(component, D, distance)
        while True:
            touched = np.zeros(len(self.V), bool)
            touched[self.F[self._hit(pairs) & ~crossed].ravel()] = True
            refused = self._lack(component, E, found) >= old
            refused[component[touched[self.patch]]] = True
            back = self.patch[refused[component] & (E != D)[self.patch].any(1)]
            if not len(back):
                return E, found
            E[back], found[back] = D[back], distance[back]
            pairs = self._renewed(E, back, pairs)

    def _relaxed(self, D: Floats) -> Floats:
        """Hang a membrane in the sheet around the patches, at the depth that was aimed at."""
        patch, X = self.patch, self.V + D
        X[patch] = self.V[patch] + self.patches.filled(D, patch)
        for i in range(_STEPS):
            X[patch] = 0.5 * X[patch] + 0.5 * self.patches.mean(X, patch)
            late = i >= _STEPS // 2
            share = _SOFT if late else 1.0
            X[patch] = self.surface.to_depth(X[patch], self.aimed[patch], share, 0.5 * self.thickness)
            if late:
                X[patch] += self._beneath_wide(X)[patch]
        E = D.copy()
        E[patch] = X[patch] - self.V[patch]
        return E

    def _settled(self, D: Floats, E: Floats, pairs: Ints, crossed: Bools) -> tuple[Floats, Ints]:
        """Smooth E where it crosses, ever wider, then draw it back to D; give the pairs that still cross."""
        folded = flipped(self.V, self.F, D)
        for i in range(_TRIES):
            bad = self._hit(pairs) & ~crossed
            if i < _FLIP_TRIES:
                bad |= flipped(self.V, self.F, E) & ~folded
            if not bad.any():
                break
            core = np.unique(self.F[bad])
            if i < _SMOOTH_TRIES:
                around = self.patches.around(core, _GROWTH * (1 + i // 2) * self.thickness)
                around = np.intersect1d(around, self.patch)
                X = self.patches.smoothed(self.V + E, _SCALE * self.thickness, around)
                E[around] = X - self.V[around]
            else:
                around, weight = self.patches.bump(core, 0.3 * self.thickness)
                E[around] += (0.5 if i < _HALF_TRIES else 1.0) * weight * (D - E)[around]
            pairs = self._renewed(E, around, pairs)
        return E, pairs

    def _beneath_wide(self, X: Floats) -> Floats:
        """Give the step at each vertex that brings the wide faces there to their depth inside, (n, 3), mm."""
        P, aimed = self._inside_wide(X)
        step = self.surface.to_depth(P, aimed, 1.0, 0.5 * self.thickness, np.inf) - P
        order = np.argsort((step**2).sum(1), kind="stable")  # the longest step wins
        steps = np.zeros_like(X)
        steps[np.repeat(self.wide, len(_INSIDE), 0)[order]] = step[order, None]
        return steps

    def _inside_wide(self, X: Floats) -> tuple[Floats, Floats]:
        """Give points inside the wide faces, (4 l, 3), and the depth that they should have, (4 l,), mm."""
        P = np.einsum("kc,fcd->fkd", _INSIDE, X[self.wide])
        return P.reshape(-1, 3), (self.aimed[self.wide] @ _INSIDE.T).ravel()

    def _lack(self, component: Ints, D: Floats, distance: Floats) -> Floats:
        """Sum up by how much each patch is too near, at its vertices and inside its wide faces."""
        lack = np.maximum(0.0, _TOO_NEAR * self.aimed - distance)
        P, aimed = self._inside_wide(self.V + D)
        inside = np.maximum(0.0, _TOO_NEAR * aimed - self.surface.distance(P))
        lack += sums(self.wide.ravel(), np.repeat(inside.reshape(-1, len(_INSIDE)).sum(1), 3), len(lack))
        return sums(component, lack[self.patch], int(component.max(initial=-1)) + 1)

    def _renewed(self, E: Floats, moved: Ints, pairs: Ints) -> Ints:
        """Bring crossing pairs up to date after some vertices have moved."""
        mark = np.zeros(len(self.V), bool)
        mark[moved] = True
        active = at_any_corner(mark, self.F)
        still = ~np.concatenate([np.zeros(len(self.F), bool), active])[pairs].any(1)
        return np.concatenate([pairs[still], self._pairs(E, active)])

    def _pairs(self, D: Floats, active: Bools) -> Ints:
        """List crossings of active inner faces, (k, 2); inner faces come after the outer ones."""
        X, m = np.concatenate([self.V, self.V + D]), len(self.F)
        both = np.concatenate([self.F, self.F + len(self.V)])
        active = np.concatenate([np.zeros(m, bool), active])
        some = np.flatnonzero(near(X, both, active, cell_size(self.V, self.F, self.thickness)))
        pairs = some[crossing_pairs(X, both[some])[0]]
        return np.asarray(pairs[active[pairs].any(1)])

    def _hit(self, pairs: Ints) -> Bools:
        """Mark the faces that some pairs are about, (m,) bool."""
        hit = np.zeros(len(self.F), bool)
        hit[pairs.ravel() % len(self.F)] = True
        return hit
