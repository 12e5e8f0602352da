"""Rebuild the outer surface of a mesh that crosses itself."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np

from meshjig.errors import InputError
from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.halfedges import edges
from meshjig.mesh.intersections import self_crossings
from meshjig.mesh.measure import face_areas
from meshjig.scan.contour import Contour, contour
from meshjig.scan.facing import turn_by_sight
from meshjig.scan.field import signed_field, well_composed
from meshjig.scan.repair import repair

__all__ = ["Offset", "ResurfaceFacts", "Resurfaced", "resurface", "resurfacing_cell"]

_FINEST = 1 / 300  # of the largest extent
_FACES_A_CELL = 3.2  # faces that an area of one squared cell gets, at most
_NEAR = 2.0  # cells: what is farther from the other surface has no counterpart there
_MOST_CAPPED = 0.07  # of the new surface: with more over holes, the old one was not nearly closed
_MOST_LOST = 0.1  # of the old area: with more left outside, it bounds no solid
_SHORTEST = 0.05  # cells: vertices nearer to each other are taken apart
_STEP = 0.5  # of a leg on the way back, that a vertex goes then, or when its faces cross
_PATIENCE = 8  # steps before the neighbours go back too


@dataclass(frozen=True)
class Offset:
    """How far new vertices are from the old surface, mm; those over holes left out."""

    median: float
    p99: float
    max: float


@dataclass(frozen=True)
class ResurfaceFacts:
    """The report's ``resurfaced``."""

    cell_mm: float
    off_mm: Offset
    capped_area_share: float  # of the new area, over holes
    lost_area_share: float  # of the old area, neither near the new surface nor inside


class Resurfaced(NamedTuple):
    """A closed surface without crossings, and how far it is from the old one."""

    V: Floats  # (n, 3)
    F: Ints  # (m, 3)
    facts: ResurfaceFacts


def resurface(V: Floats, F: Ints, cell: float, *, cavities: bool = False) -> Resurfaced:
    """Rebuild the outer surface of a closed or nearly closed mesh that may cross itself.

    The zero surface of the signed distance, sampled on a grid, is closed, manifold and oriented by its
    making. Creases stay sharp; what is thinner than a cell may close up or vanish. Open sheets are first
    turned to the side from which they are seen.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, manifold, as `repair` leaves it
    cell : float, mm, edge of a cube of the grid
    cavities : bool, whether shells that lie inside the solid stay

    Returns
    -------
    Resurfaced

    Raises
    ------
    InputError
        The surface is open, or bounds nothing.

    Notes
    -----
    About 2 s for 100,000 faces.
    """
    F = turn_by_sight(V, F)
    field = signed_field(V, F, cell)
    if not len(field.cubes):
        raise _too_open("it bounds no solid")
    if field.over_holes > _MOST_CAPPED:
        raise _holes(field.over_holes)
    made = contour(well_composed(field))
    new, G, _ = repair(_uncrossed(made, cell), made.F, cavities=cavities)
    facts = _deviation(V, F, new, G, cell)
    if facts.capped_area_share > _MOST_CAPPED:
        raise _holes(facts.capped_area_share)
    if facts.lost_area_share > _MOST_LOST:
        raise _too_open(f"{100 * facts.lost_area_share:.0f} % of it would be lost")
    return Resurfaced(new, G, facts)


def resurfacing_cell(V: Floats, F: Ints, faces: int | Literal["all"]) -> float:
    """Say how large the cells should be for a number of faces; at least a 300th of the extent.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64
    faces : int or "all", the working resolution

    Returns
    -------
    float, mm
    """
    finest = float(np.ptp(V, axis=0).max()) * _FINEST
    if faces == "all":
        return finest
    return max(finest, float(np.sqrt(_FACES_A_CELL * face_areas(V, F).sum() / faces)))


def _uncrossed(made: Contour, cell: float) -> Floats:
    """Move vertices until no two faces cross.

    Those that are in the way go back in two legs: to the middle of the surface in their cube, then to the
    middle of the cube. Where all have come so far, none can cross.
    """
    leg = np.zeros((len(made.V), 1))
    V, E, turn = made.V, edges(made.F).E, 0
    while len(moved := _in_each_others_way(V, E, made, cell)) and leg.min() < 2:
        if turn >= _PATIENCE:
            moved = np.unique(made.F[np.isin(made.F, moved).any(axis=1)])
        leg[moved] = np.minimum(leg[moved] + _STEP, 2)
        V = made.V + np.minimum(leg, 1) * (made.middle - made.V)
        V = V + np.maximum(leg - 1, 0) * (made.centre - V)
        turn += 1
    return V


def _in_each_others_way(V: Floats, E: Ints, made: Contour, cell: float) -> Ints:
    """List the vertices of faces that cross, and of short edges the end that is farther from its middle."""
    pairs = self_crossings(V, made.F)
    crossing = made.F[pairs].ravel() if pairs is not None else np.zeros(0, np.int64)
    short = E[np.linalg.norm(V[E[:, 0]] - V[E[:, 1]], axis=1) < _SHORTEST * cell]
    strayed = np.linalg.norm((V - made.centre)[short], axis=2).argmax(axis=1)
    return np.unique(np.concatenate([crossing, short[np.arange(len(short)), strayed]]))


def _deviation(V: Floats, F: Ints, new: Floats, G: Ints, cell: float) -> ResurfaceFacts:
    """Say how far new vertices are from the old surface, and what shares of area are new and lost."""
    import igl

    distance = np.sqrt(igl.point_mesh_squared_distance(new, V, F)[0])
    median, high, most = np.percentile(distance[distance <= _NEAR * cell], [50, 99, 100]).tolist()
    area = face_areas(new, G)
    over_hole = (distance[G] > cell).all(axis=1)
    middle = V[F].mean(axis=1)
    lost = igl.point_mesh_squared_distance(middle, new, G)[0] > (_NEAR * cell) ** 2
    lost[lost] = np.asarray(igl.fast_winding_number(new, G, middle[lost])) < 0.5
    old = face_areas(V, F)
    shares = float(area[over_hole].sum() / area.sum()), float(old[lost].sum() / old.sum())
    return ResurfaceFacts(cell, Offset(median, high, most), *shares)


def _holes(share: float) -> InputError:
    return _too_open(f"its holes would make {100 * share:.0f} % or more of the new surface")


def _too_open(why: str) -> InputError:
    return InputError(
        f"the mesh is too open to be resurfaced: {why}", hint="close its holes, or leave resurfacing off"
    )
