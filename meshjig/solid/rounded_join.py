"""The rounded join: the inner sheet laid on the surface that is everywhere the thickness away."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.measure import mesh_volume
from meshjig.mesh.rays import RayScene
from meshjig.solid.surface_distance import SurfaceDistance

__all__ = ["JoinFacts", "rounded"]

_CELLS_A_THICKNESS = 2
_MAX_CELLS = 150  # along the longest side; twice as many take eight times as long
_REACH = 0.45  # of the thickness, how far a vertex is carried
_POLISH = 2


class JoinFacts(NamedTuple):
    """How offset creases were joined."""

    join_method: str
    join_cell: float | None = None  # mm, edge of a cell of the grid
    joined_share: float | None = None  # share of the vertices


def rounded(
    V: Floats, F: Ints, D: Floats, thickness: float, surface: SurfaceDistance
) -> tuple[Floats, JoinFacts]:
    """Carry an inner sheet to the offset surface of a closed mesh, along D.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, closed; the sheet is on its back
    D : (n, 3) float64, mm; V + D is the sheet, roughly the thickness away
    thickness : float, mm
    surface : SurfaceDistance of the mesh

    Returns
    -------
    D : (n, 3) float64, mm; unchanged where the offset surface is out of reach, since the model lacks the room
    facts : JoinFacts

    Notes
    -----
    The offset surface comes from distances on a grid, whose cells blunt its creases. So it tells where a
    vertex goes; the vertex then settles at the exact distance from the mesh.
    """
    S, G, cell = _offset_surface(V, F, thickness)
    target, found = _carried(V, D, thickness, S, G)
    for _ in range(_POLISH):
        distance, _face, foot = surface.nearest(target[found])
        away = target[found] - foot
        target[found] = foot + away * (thickness / np.maximum(distance, 1e-9))[:, None]
    reached = found & (np.linalg.norm(target - V - D, axis=1) < 2 * _REACH * thickness)
    facts = JoinFacts("libigl offset_surface", cell, float(reached.mean()))
    return np.where(reached[:, None], target - V, D), facts


def _offset_surface(V: Floats, F: Ints, thickness: float) -> tuple[Floats, Ints, float]:
    import igl

    side = 1.0 if mesh_volume(V, F) > 0 else -1.0
    extent = float(np.ptp(V[F.ravel()], axis=0).max())
    cells = int(np.clip(extent * _CELLS_A_THICKNESS / thickness, 20, _MAX_CELLS))
    S, G, grid, _sides, _values = igl.offset_surface(
        V, F[:, :: int(side)], -side * thickness, cells, igl.SIGNED_DISTANCE_TYPE_FAST_WINDING_NUMBER
    )
    return S, np.asarray(G, np.int64), float(np.ptp(grid, axis=0).max()) / cells


def _carried(V: Floats, D: Floats, thickness: float, S: Floats, G: Ints) -> tuple[Floats, Any]:
    """Follow D to the offset surface; take its nearest point where D misses it."""
    target, found = V + D, np.zeros(len(V), bool)
    if not len(G):
        return target, found
    length = np.linalg.norm(D, axis=1)
    way = D / np.maximum(length, 1e-300)[:, None]
    start = np.maximum(length - _REACH * thickness, 0.0)
    origin = V + start[:, None] * way
    hit = RayScene(S, G).first_distance(origin, way)
    along = hit < length - start + _REACH * thickness
    target[along] = origin[along] + hit[along, None] * way[along]
    found |= along
    rest = np.flatnonzero(~along)
    if len(rest):
        distance, _face, foot = SurfaceDistance(S, G).nearest(target[rest])
        close = distance < _REACH * thickness
        target[rest[close]] = foot[close]
        found[rest[close]] = True
    return target, found
