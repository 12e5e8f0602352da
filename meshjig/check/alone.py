"""What is found of each piece by itself, without its neighbours' help."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from meshjig.check.closed import is_closed_as_stl, is_one_component, volume
from meshjig.check.self_intersection import self_intersections
from meshjig.check.sheet_rays import SheetRays
from meshjig.check.thickness import Thickness, thickness_of
from meshjig.check.thin_parts import ThinShares, thin_shares
from meshjig.mesh.mesh import Mesh
from meshjig.mesh.pieces import Pieces, piece_names

__all__ = ["Alone", "each_alone"]


class Alone(NamedTuple):
    """What was found of the pieces by themselves."""

    unsound: dict[str, list[int]]  # promise: pieces that break it
    crossings: list[int]  # of each piece
    sheets: Thickness
    thin: ThinShares | None  # None where the least wall is not known


def each_alone(solids: Sequence[Mesh], min_wall: float | None, model: Mesh | None) -> Alone:
    """List the pieces that are no sound solids, count the crossings of each, and measure their thickness.

    Parameters
    ----------
    solids : list of Mesh, mm
    min_wall : float, mm; None where it is not known
    model : Mesh, the surface that pieces have outside, where it is known
    """
    n = len(solids)
    unsound = {
        "closed": [i for i in range(n) if not is_closed_as_stl(*solids[i])],
        "one_component": [i for i in range(n) if not is_one_component(solids[i].F)],
        "positive_volume": [i for i in range(n) if volume(*solids[i]) <= 0],
    }
    rays = SheetRays(Pieces(tuple(piece_names(n)), tuple(solids)))
    thin = thin_shares(rays, n, min_wall, model) if min_wall else None
    return Alone(unsound, [len(self_intersections(*mesh)) for mesh in solids], thickness_of(rays), thin)
