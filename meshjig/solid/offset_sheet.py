"""The shell map: a vector at every vertex that leads from the surface to the inner side of the wall."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np

from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.mesh import Mesh
from meshjig.mesh.smoothing import Smoother
from meshjig.solid.directions import smooth_normals
from meshjig.solid.local_thickness import (
    ThinFacts,
    check_thickness,
    inward_room,
    refuse_crowds,
    thinness,
)
from meshjig.solid.restore_depth import restore_depth
from meshjig.solid.rounded_join import JoinFacts, rounded
from meshjig.solid.surface_distance import SurfaceDistance
from meshjig.solid.untangle_sheet import FoldFacts, flipped, untangle_sheet

__all__ = ["ShellFacts", "displacement", "offset_sheet"]

_POSITION_SCALE = 0.3  # of the thickness: bumps below it are not carried to the inner sheet
_LEAST_ROOM = 0.15  # mm; a wall is not planned thinner
_ROUGHLY = 3e-3  # tolerance for what is small itself
_CORRECTIONS = 2
_EXACT = 0.02  # of the thickness; what moves less keeps the depth that was read
_HOPELESS = 1e-3  # share of the faces that may be left crossing


@dataclass(frozen=True)
class ShellFacts:
    """What the report says of the shell."""

    side: str
    join: str
    thin_area_share: float  # see ThinFacts
    min_thickness: float
    thinnest_at: list[float]
    join_method: str  # see JoinFacts
    join_cell: float | None
    joined_share: float | None
    folds_left: int  # see FoldFacts
    crossings_left: int
    outer_crossings: int
    rounds: int


class SheetFacts(NamedTuple):
    """How one sheet was made."""

    joined: JoinFacts
    folds: FoldFacts

    def told(self, side: str, join: str, thin: ThinFacts) -> ShellFacts:
        """Give what the report says of a shell whose only sheet, or first, it is."""
        return ShellFacts(side, join, *thin, *self.joined, *self.folds)


def displacement(
    V: Floats, F: Ints, thickness: float, *, join: Literal["miter", "round"] = "miter"
) -> tuple[Floats, ShellFacts]:
    """Lay an inner sheet under a surface.

    Directions are normals averaged over the thickness, positions those of a slightly smoothed copy of the
    surface, so that the noise of a scan is not offset. The depth is held to what the model has room for,
    then corrected until the sheets are the thickness apart, at creases too. What still folds is unfolded, and
    what came too near by that is laid down again.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, manifold, oriented outward; may be open or have several components
    thickness : float, mm
    join : {"miter", "round"}
        Whether offset creases stay sharp or are rounded; rounded joins are for closed meshes.

    Returns
    -------
    D : (n, 3) float64, mm; V + D is the inner sheet
    facts : ShellFacts

    Raises
    ------
    SolidError
        The model is too thin for walls this thick, or the sheets would cross in many places.

    Notes
    -----
    Linear in the mesh. Sheets that don't cross keep the sheets of every piece apart; its walls, ruled along
    D, may still cut into them where the surface overhangs and D leans.
    """
    D, distance, facts = offset_sheet(V, F, thickness, join)
    return D, facts.told("in", join, thinness(V, F, distance, thickness))


def offset_sheet(
    V: Floats, F: Ints, thickness: float, join: Literal["miter", "round"], crowded: bool = False
) -> tuple[Floats, Floats, SheetFacts]:
    """Lay an inner sheet; give D, how far V + D is from the surface (n,), and facts.

    Where the model may be crowded, it is not refused for having no room.
    """
    smoother = Smoother(V, F)
    d = smooth_normals(V, F, smoother, thickness)
    room = inward_room(V, F, d, enough=thickness)
    if not crowded:
        check_thickness(V, F, thickness, room)
    depth = _depth(F, thickness, room, smoother)
    D = _drift(V, depth, thickness, smoother) - depth[:, None] * d
    gauge = _Gauge(V, F, join)
    for _ in range(_CORRECTIONS):
        lack = depth - gauge.read(D, _EXACT * thickness)[0]
        D = _corrected(D, d, lack, room, thickness, smoother)
    joined = JoinFacts("plane distances")
    if join == "round":
        exact, joined = rounded(V, F, D, thickness, gauge.surface)
        D = np.where(depth[:, None] > 0.99 * thickness, exact, D)
    distance = gauge.read(D, _EXACT * thickness)[1] - _EXACT * thickness
    D, folds = untangle_sheet(V, F, D, thickness, distance)
    distance = gauge.read(D, _EXACT * thickness)[1]
    hopeless = folds.crossings_left > _HOPELESS * len(F) and not folds.outer_crossings
    if hopeless and not crowded:
        refuse_crowds(V, F, thickness, room, distance)
    before, D = D, restore_depth(Mesh(V, F), D, distance, depth, thickness, gauge.surface)
    if D is not before:
        leaning = int(flipped(V, F, D).sum()) - int(flipped(V, F, before).sum())
        folds = folds._replace(folds_left=folds.folds_left + leaning)
        distance = gauge.read(D, _EXACT * thickness)[1]
    return D, distance, SheetFacts(joined, folds)


class _Gauge:
    """Read how deep an inner sheet is, again only where it has moved since."""

    def __init__(self, V: Floats, F: Ints, join: Literal["miter", "round"]) -> None:
        self.surface = SurfaceDistance(V, F)
        self._V, self._join = V, join
        self._depth, self._distance = np.zeros(len(V)), np.zeros(len(V))
        self._D = np.full_like(V, np.inf)

    def read(self, D: Floats, within: float) -> tuple[Floats, Floats]:
        """Give depth (n,), as the join counts it, and distance (n,), mm, both within some mm."""
        old = np.flatnonzero(~(np.linalg.norm(D - self._D, axis=1) <= within))
        points = (self._V + D)[old]
        if self._join == "miter":
            self._depth[old], self._distance[old] = self.surface.behind_planes(points)
        else:
            self._depth[old] = self._distance[old] = self.surface.distance(points)
        self._D[old] = D[old]
        return self._depth.copy(), self._distance.copy()


def _depth(F: Ints, thickness: float, room: Floats, smoother: Smoother) -> Floats:
    """Hold the thickness to the room at each vertex, with a smooth passage to where it is free."""
    depth = np.minimum(thickness, np.maximum(room, _LEAST_ROOM))
    lowest = depth.copy()
    np.minimum.at(lowest, F.ravel(), np.repeat(depth[F].min(1), 3))
    if (lowest < thickness).any():
        depth = np.minimum(depth, smoother(lowest, thickness, tolerance=_ROUGHLY))
    return np.maximum(depth, _LEAST_ROOM)


def _drift(V: Floats, depth: Floats, thickness: float, smoother: Smoother) -> Floats:
    """Give the step to a smoothed copy of the surface, shorter where the wall is thin.

    Smoothing what smoothing took away puts most of the shrinkage back.
    """
    scale = _POSITION_SCALE * thickness
    centred = V - V.mean(0)
    once = smoother(centred, scale, tolerance=1e-4)
    drift = once + smoother(centred - once, scale, tolerance=_ROUGHLY) - centred
    length = np.linalg.norm(drift, axis=1)
    share = np.minimum(depth / thickness, _POSITION_SCALE * thickness / np.maximum(length, 1e-9))
    return drift * np.minimum(1.0, share)[:, None]


def _corrected(
    D: Floats, d: Floats, lack: Floats, room: Floats, thickness: float, smoother: Smoother
) -> Floats:
    """Move the inner sheet along d by what it lacks in depth, within the room there is."""
    lack = np.clip(lack, -0.3 * thickness, 0.4 * thickness)
    D = D - smoother(lack, _POSITION_SCALE * thickness, tolerance=_ROUGHLY)[:, None] * d
    beyond = -np.einsum("ij,ij->i", D, d) - np.maximum(room, _LEAST_ROOM)
    return D + np.maximum(0.0, beyond)[:, None] * d
