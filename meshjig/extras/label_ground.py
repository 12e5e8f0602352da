"""Where on a piece a label may stand: on its inner side, or on a wall where both its sides are seen."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.measure import area_vectors, unit
from meshjig.mesh.mesh import Mesh, concatenate
from meshjig.mesh.rays import RayScene

__all__ = ["LabelGround", "label_grounds", "wall_behind"]

_SKIN = 0.03  # mm; how far a piece may be off the sheet that it was made from
_ALIKE = 0.9  # cosine between a face and the sheet that it lies on


class LabelGround(NamedTuple):
    """How thick a piece is behind its faces, mm; 0 where no label may stand."""

    inner: Floats  # (m,), behind faces of the inner sheet
    side: Floats | None = None  # (m,), behind walls; None where labels stand on the inner side only


def label_grounds(
    pieces: Sequence[tuple[Floats, Ints]], outer: Mesh, D: Floats, reach: Floats | None = None
) -> list[LabelGround]:
    """Find the faces of pieces on which a label may stand.

    On a piece that reaches through a thin part, these are faces of the inner sheet that don't look at
    another side of the piece itself across a narrow hollow, and walls that look at another piece: those can
    be read once the piece is in a hand, and nothing can be seen of them on the model.

    Parameters
    ----------
    pieces : list of (V, F)
        V (n, 3) float64, mm; F (m, 3) int64, closed and oriented outward.
    outer : Mesh, the outer sheet
    D : (k, 3) float64, mm, from its vertices to the inner sheet
    reach : (p,) float64, mm, optional
        How thick the thin parts are at most that each piece reaches through; 0 for none.

    Returns
    -------
    list of LabelGround
    """
    inner = wall_behind(pieces, outer, D)
    if reach is None or not reach.any():
        return [LabelGround(wall) for wall in inner]
    V, F, _, piece = concatenate([Mesh(*solid) for solid in pieces])
    centre, wall = V.mean(axis=0), np.concatenate(inner)
    scene = RayScene(V - centre, F)  # Embree has 32 bits
    at = np.flatnonzero(reach[piece] > 0)
    P, N = V[F[at]].mean(axis=1), unit(area_vectors(V, F[at]))
    beside, free = _hits(scene, P - centre + _SKIN * N, N)
    near, own = (beside >= 0) & (free < reach[piece[at]]), piece[beside] == piece[at]
    on_sheet = (wall[at] > 0) | _lies_on(outer, P, N)
    wall[at[near & own]] = 0.0
    free_side = near & ~own & ~on_sheet
    end, behind = _hits(scene, P[free_side] - centre - _SKIN * N[free_side], -N[free_side])
    side = np.zeros(len(F))
    side[at[free_side]] = np.where(end >= 0, behind + _SKIN, 0.0)
    bounds = np.cumsum([len(G) for _, G in pieces])[:-1]
    grounds = zip(np.split(wall, bounds), np.split(side, bounds), reach.tolist(), strict=True)
    return [LabelGround(a, b if deep else None) for a, b, deep in grounds]


def _lies_on(sheet: Mesh, P: Floats, normal: Floats) -> Bools:
    centre = sheet.V.mean(axis=0)
    moved = Mesh(sheet.V - centre, sheet.F)
    face, distance = _hits(RayScene(*moved), P - centre + _SKIN * normal, -normal)
    alike = np.einsum("ij,ij->i", unit(area_vectors(*moved))[face], normal) > _ALIKE
    return np.asarray((face >= 0) & (distance < 2 * _SKIN) & alike)


def wall_behind(pieces: Sequence[tuple[Floats, Ints]], outer: Mesh, D: Floats) -> list[Floats]:
    """Measure the wall behind the faces on the inner sheet.

    Parameters
    ----------
    pieces : list of (V, F)
        V (n, 3) float64, mm; F (m, 3) int64, closed and oriented outward.
    outer : Mesh, the outer sheet
    D : (k, 3) float64, mm, from its vertices to the inner sheet

    Returns
    -------
    list of (m,) float64, mm
        From a face's middle straight through the piece to the outer sheet; 0 for faces that don't lie on the
        inner sheet.

    Notes
    -----
    Two rays a face.
    """
    corners = np.concatenate([V[F] for V, F in pieces])
    normal = unit(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]))
    middle = corners.mean(axis=1)
    on = np.flatnonzero(_lies_on(Mesh(outer.V + D, outer.F[:, ::-1]), middle, normal))
    centre = outer.V.mean(axis=0)  # Embree has 32 bits
    face, distance = _hits(RayScene(outer.V - centre, outer.F), middle[on] - centre, -normal[on])
    way = np.zeros(len(middle))
    way[on] = np.where(face >= 0, distance, 0.0)
    return np.split(way, np.cumsum([len(F) for _, F in pieces])[:-1])


def _hits(scene: RayScene, origin: Floats, toward: Floats) -> tuple[Ints, Floats]:
    """Give the first face that each ray meets, -1 for none, and the way there."""
    found = scene.hits(origin, toward)
    return np.asarray(found["primID"], np.int64), np.asarray(found["tfar"], np.float64)
