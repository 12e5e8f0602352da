"""Which pieces are too thin, and where that is because the model itself is."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from meshjig.check.sheet_rays import OPPOSITE, Rays, SheetRays
from meshjig.check.soup import first_hit, soup
from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.measure import unit
from meshjig.mesh.mesh import Mesh
from meshjig.mesh.rays import RayScene

__all__ = ["MOST_THIN", "ThinParts", "ThinShares", "thin_shares"]

MOST_THIN = 0.001  # of a piece's sheets, that may be thinner than the least wall
_RAYS, _MORE_RAYS = 1000, 10_000  # a piece; the more, where the first came near the least wall
_NEAR = 1.5  # least walls
_TOGETHER = 300  # pieces that are measured at a time, for the sake of memory
_ROUNDING = 1e-3  # mm
_ON_MODEL = 0.01  # mm, that an end of a ray may be off the model's surface


@dataclass(frozen=True)
class ThinParts:
    """What the judgement may know of the model's thin parts."""

    model: Mesh | None = None  # mm, the surface that pieces have outside, oriented outward
    model_thin: Mapping[str, float] = field(default_factory=dict)  # piece: share of its sheets, found earlier
    through_pieces: Collection[str] = ()  # names of pieces that reach through, as thick as the part itself


class ThinShares(NamedTuple):
    """How much of each piece's sheets is thinner than the least wall."""

    own: Floats  # (n,), where the model is thicker, or is not known
    model: Floats  # (n,), where the model is as thin

    def broken(self, names: Sequence[str], known: ThinParts) -> list[int]:
        """List the pieces of which more is too thin than what is known of the model explains."""
        allowed = [MOST_THIN + known.model_thin.get(name, 0.0) for name in names]
        return np.flatnonzero(self.own > np.array(allowed)).tolist()

    def of_model(self, names: Sequence[str]) -> dict[str, float]:
        """Give the share of each piece that is thin because the model is, where there is any."""
        return {names[i]: float(self.model[i]) for i in np.flatnonzero(self.model).tolist()}


def thin_shares(rays: SheetRays, n: int, least: float, model: Mesh | None = None) -> ThinShares:
    """Measure how much of each piece is thinner than the least wall.

    Each piece gets 1,000 rays. Where one of them comes near the least wall it gets 10,000 others, so that
    0.1 % are ten.

    Parameters
    ----------
    rays : SheetRays, of the pieces
    n : int, how many pieces there are
    least : float, mm
    model : Mesh, optional
        A ray that starts or ends on it, and for which it is as thin along the same line, is the model's.

    Returns
    -------
    ThinShares
    """
    asked, found = np.zeros(n), [_none()]
    for some in np.array_split(np.arange(n), max(1, -(-n // _TOGETHER))):
        few = _sheets(rays, some, _RAYS)
        near = some[np.bincount(few.piece[few.way < _NEAR * least], minlength=n)[some] > 0]
        if len(near):
            more = _sheets(rays, near, _MORE_RAYS)
            asked += np.bincount(more.piece, minlength=n)
            thin = more.where(more.way < least - _ROUNDING)
            found.append(thin.where(~rays.at_edges(thin)))
    thin = Rays(*(np.concatenate(x) for x in zip(*found, strict=True)))
    pardoned = np.zeros(len(thin.way), bool) if model is None else _model_is_thin(model, thin, least)
    own, models = (np.bincount(thin.piece[some], minlength=n) for some in (~pardoned, pardoned))
    return ThinShares(own / np.maximum(asked, 1), models / np.maximum(asked, 1))


def _sheets(rays: SheetRays, some: Ints, n: int) -> Rays:
    found = rays.of_each(some, n)
    return found.where(found.sheet)


def _none() -> Rays:
    points, flags = np.zeros((0, 3)), np.zeros(0, bool)
    return Rays(points, points, np.zeros(0), np.zeros(0, np.int64), flags, flags, np.zeros((0, 2), np.int64))


def _model_is_thin(model: Mesh, rays: Rays, least: float) -> Bools:
    """Tell for which rays the model is thinner than the least wall, along the same line, (k,) bool."""
    import igl

    s, found = soup([model]), np.zeros(len(rays.way), bool)
    if not len(found):
        return found
    scene = RayScene(s.V, s.F)
    for start, end in ((rays.start, rays.end), (rays.end, rays.start)):
        squared, face, foot = igl.point_mesh_squared_distance(start, model.V, model.F)
        on = np.flatnonzero(squared <= _ON_MODEL**2)
        direction = unit(end[on] - start[on])
        far, way = first_hit(scene, s, foot[on], direction)
        thin = (far >= 0) & (way < least) & (np.einsum("ij,ij->i", s.N[far], s.N[face[on]]) <= OPPOSITE)
        found[on[thin]] = True
    return found
