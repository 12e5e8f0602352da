"""The thin parts of a surface that are cut through."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints, connected
from meshjig.mesh.components import components
from meshjig.mesh.level_set import split_at_zero
from meshjig.mesh.measure import unit
from meshjig.mesh.mesh import Mesh
from meshjig.mesh.ray_thickness import RayThickness, ray_thickness
from meshjig.mesh.rays import RayScene
from meshjig.mesh.smoothing import Smoother
from meshjig.thin.sides import Sides, choose_sides, smoothed_sides
from meshjig.thin.thin_faces import linked_faces, thin_faces
from meshjig.thin.ways import ways_through

__all__ = ["ThroughParts", "large_parts", "through_parts"]

_BESIDE = -0.3  # cosine to the way through, over which a face beside a far side belongs to the other one
_SMOOTH = 0.5  # of the limit: how smooth the rim of a far side is
_RIM = 0.5  # of the limit: how wide the edge of a far side is where nothing may reach through
_SCALE = 2.0  # of the limit: how far directions even out
_LEAST_FAR_SIDE = 0.75  # of the square of the limit: what is smaller is no far side


class ThroughParts(NamedTuple):
    """What is cut through, by faces of a surface."""

    direction: Floats  # (m, 3), unit, through the part towards the side that owns it; zero elsewhere
    depth: Floats  # (m,), mm, the shortest way through; infinite where none was found
    owns: Bools  # (m,), faces whose pieces reach through
    far: Bools  # (m,), faces of the other side, which get no pieces of their own


def through_parts(surface: Mesh, limit: float, certain: float) -> tuple[Mesh, ThroughParts] | None:
    """Find the thin parts of a surface, and which of their sides gives pieces that reach through.

    Parameters
    ----------
    surface : Mesh
    limit : float, mm; what is thinner is cut through
    certain : float, mm; what is thinner than that is cut through however small it is

    Returns
    -------
    surface : Mesh, the same with faces cut along the rims of far sides, which are smooth lines
    parts : ThroughParts
        Both None where nothing is thin.
    """
    rays = ray_thickness(surface, limit)
    thin = thin_faces(surface, rays, limit, certain)
    if not thin.any():
        return None
    sides = choose_sides(surface, thin, rays, _SCALE * limit)
    least = _LEAST_FAR_SIDE * limit**2
    far = _large_enough(surface, sides.far, least)
    far = _large_enough(surface, _reached(surface, sides, far, limit), least)
    if not far.any():
        return None
    has = _has_far_side(surface, thin, rays, far)
    smooth, far, parent = _with_smooth_rims(surface, far, _SMOOTH * limit)
    far = _large_enough(smooth, far, least)
    facing = np.einsum("ij,ij->i", unit(smooth.area_vectors), sides.direction[parent])
    owns = thin[parent] & has[parent] & ~far & (sides.owns[parent] | (facing > _BESIDE))
    return smooth, ThroughParts(sides.direction[parent], rays.depth[parent], owns, far)


def _with_smooth_rims(surface: Mesh, far: Bools, scale: float) -> tuple[Mesh, Bools, Ints]:
    """Cut faces so that the borders of far sides are smooth; faces that are far, and parents."""
    V, F = surface
    total = np.bincount(F.ravel(), np.repeat(np.where(far, -1.0, 1.0) * surface.areas, 3), len(V))
    area = np.bincount(F.ravel(), np.repeat(surface.areas, 3), len(V))
    split = split_at_zero(V, F, Smoother(V, F)(total / area, scale))
    return Mesh(split.V, split.F), np.where(split.sign == 0, far[split.parent], split.sign < 0), split.parent


def _reached(surface: Mesh, sides: Sides, far: Bools, limit: float) -> Bools:
    """Leave faces beside what is thick out of a far side where no way through ends on them.

    So the rim of a far side is where pieces that reach through come out.
    """
    from scipy.spatial import cKDTree

    ways = ways_through(surface, sides.direction, sides.owns, far, limit)
    under = ways.under(*surface) & sides.owns
    P = surface.V[surface.F].mean(axis=1)
    thick = ~(sides.owns | sides.far)
    asked = np.flatnonzero(far)
    if not thick.any() or not under.any():
        return far
    near = cKDTree(P[thick]).query(P[asked], distance_upper_bound=_RIM * limit)[0] <= _RIM * limit
    asked = asked[near]
    hit = RayScene(surface.V, surface.F[under]).first_distance(P[asked], sides.direction[asked])
    far = far.copy()
    far[asked[hit > limit]] = False
    return smoothed_sides(surface, far, sides.owns | sides.far)


def _has_far_side(surface: Mesh, thin: Bools, rays: RayThickness, far: Bools) -> Bools:
    """Tell which faces belong to a part of which the far side is left out, (m,)."""
    i, j = linked_faces(surface)
    both = thin[i] & thin[j]
    across = np.flatnonzero(thin & (rays.far >= 0))
    n, part = connected(len(thin), np.r_[i[both], across], np.r_[j[both], rays.far[across]])
    return np.asarray((np.bincount(part, far, n) > 0)[part])


def large_parts(surface: Mesh, marked: Bools, least: float) -> Bools:
    """Mark those of some faces whose connected part is at least as large as an area, mm2; (m,)."""
    part, area = _parts(surface, marked)
    return marked & (area[part] >= least)


def _large_enough(surface: Mesh, far: Bools, least: float) -> Bools:
    """Leave out far sides that are too small, and fill holes in them that are."""
    for _ in range(3):
        part, area = _parts(surface, far)
        small = area[part] < least
        if not small.any():
            break
        far = np.where(small, ~far, far)
    return far


def _parts(surface: Mesh, marked: Bools) -> tuple[Ints, Floats]:
    """Number the connected parts of marked and of unmarked faces; and their areas, mm2."""
    twin = surface.edges.twin
    wall = marked[np.arange(len(twin)) // 3] != marked[twin // 3]
    n, part = components(surface.F, wall, twin)
    return part, np.bincount(part, surface.areas, n).astype(np.float64)
