"""The shell map: a vector at every vertex that leads from the surface to the inner side of the wall."""

from __future__ import annotations

from typing import Any

import numpy as np

from meshjig.errors import SolidError
from meshjig.measure import face_areas
from meshjig.solid.directions import smooth_normals
from meshjig.solid.embedding import unfold
from meshjig.solid.local_thickness import inward_room, thin_share
from meshjig.solid.smoothing import Smoother
from meshjig.solid.surface_distance import SurfaceDistance
from meshjig.topology import border_halfedges
from meshjig.types import Floats, Ints

__all__ = ["check_thickness", "displacement"]

_POSITION_SCALE = 0.3  # of the thickness: bumps below it are not carried to the inner sheet
_LEAST_ROOM = 0.15  # mm; a wall is not planned thinner
_CORRECTIONS = 2
MITER = True
_THIN = 0.8  # of the thickness


def displacement(V: Floats, F: Ints, thickness: float) -> tuple[Floats, dict[str, Any]]:
    """Lay an inner sheet under a surface.

    Directions are normals averaged over the thickness, positions those of a slightly smoothed copy of the
    surface, so that the noise of a scan is not offset. The depth is held to what the model has room for,
    then corrected until the sheets are the thickness apart, at creases too. What still folds is unfolded.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, manifold, oriented outward; may be open or have several components
    thickness : float, mm

    Returns
    -------
    D : (n, 3) float64, mm; V + D is the inner sheet
    facts : dict; {"thin_area_share": share of the area that is below 0.8 of the thickness,
        "min_thickness": shortest D, mm, "folds_left": faces whose inner side still flips or crosses,
        "crossings_left": those that cross, "rounds": int}

    Raises
    ------
    SolidError
        The model is too thin for walls this thick.

    Notes
    -----
    Linear in the mesh. Sheets that don't cross keep the sheets of every piece apart; its walls, ruled along
    D, may still cut into them where the surface overhangs and D leans.
    """
    smoother = Smoother(V, F)
    d = smooth_normals(V, F, smoother, thickness)
    room = inward_room(V, F, d)
    check_thickness(V, F, thickness, room)
    depth = _depth(F, thickness, room, smoother)
    D = _drift(V, depth, thickness, smoother) - depth[:, None] * d
    surface = SurfaceDistance(V, F)
    for _ in range(_CORRECTIONS):
        distance = surface.behind_planes(V + D) if MITER else surface.nearest(V + D)[0]
        D = _corrected(V, F, D, d, depth, room, thickness, smoother, distance)
    D, folds = unfold(V, F, D, thickness)
    length = np.linalg.norm(D, axis=1)
    thin = thin_share(V, F, length < _THIN * thickness)
    return D, {"thin_area_share": thin, "min_thickness": float(length.min()), **folds}


def check_thickness(V: Floats, F: Ints, thickness: float, room: Floats) -> None:
    """Refuse walls that the model has no room for.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64
    thickness : float, mm
    room : (n,) float64, mm, as `inward_room` gives it

    Raises
    ------
    SolidError
        The thickness is over a third of a closed model's smallest extent, or twice what more than half of
        the surface has room for; the sentence names the largest thickness that works.
    """
    largest = 2 * _median(room[F].mean(1), face_areas(V, F))
    if not len(border_halfedges(F)):
        largest = min(largest, float(np.ptp(V[F.ravel()], axis=0).min()) / 3)
    if thickness <= largest:
        return
    step = 10.0 ** np.floor(np.log10(max(largest, 1e-6)) - 1)
    raise SolidError(
        f"walls of {thickness:g} mm are too thick for this model",
        hint=f"the largest thickness that works at this size is {np.floor(largest / step) * step:.3g} mm",
    )


def _median(values: Floats, weights: Floats) -> float:
    order = np.argsort(values)
    share = np.cumsum(weights[order])
    return float(values[order[np.searchsorted(share, share[-1] / 2)]])


def _depth(F: Ints, thickness: float, room: Floats, smoother: Smoother) -> Floats:
    """Hold the thickness to the room at each vertex, with a smooth passage to where it is free."""
    depth = np.minimum(thickness, np.maximum(room, _LEAST_ROOM))
    lowest = depth.copy()
    np.minimum.at(lowest, F.ravel(), np.repeat(depth[F].min(1), 3))
    if (lowest < thickness).any():
        depth = np.minimum(depth, smoother(lowest, thickness))
    return np.maximum(depth, _LEAST_ROOM)


def _drift(V: Floats, depth: Floats, thickness: float, smoother: Smoother) -> Floats:
    """Give the step to a smoothed copy of the surface, shorter where the wall is thin.

    Smoothing what smoothing took away puts most of the shrinkage back.
    """
    scale = _POSITION_SCALE * thickness
    once = smoother(V, scale)
    drift = once + smoother(V - once, scale) - V
    length = np.linalg.norm(drift, axis=1)
    share = np.minimum(depth / thickness, _POSITION_SCALE * thickness / np.maximum(length, 1e-9))
    return drift * np.minimum(1.0, share)[:, None]


def _corrected(
    V: Floats, F: Ints, D: Floats, d: Floats, depth: Floats, room: Floats, thickness: float, smoother: Smoother,
    distance: Floats,
) -> Floats:
    """Move the inner sheet along d by what its true distance to the surface lacks."""
    lack = np.clip(depth - distance, -0.3 * thickness, 0.4 * thickness)
    D = D - smoother(lack, _POSITION_SCALE * thickness)[:, None] * d
    beyond = -np.einsum("ij,ij->i", D, d) - np.maximum(room, _LEAST_ROOM)
    return D + np.maximum(0.0, beyond)[:, None] * d
