"""Which faces of finished pieces lie on the inner sheet, and how thick the wall is there."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from meshjig.mesh.measure import area_vectors, unit
from meshjig.mesh.rays import RayScene
from meshjig.mesh.types import Floats, Ints, Mesh

__all__ = ["wall_behind"]

_SKIN = 0.03  # mm; how far a piece may be off the sheet that it was made from
_ALIKE = 0.9  # cosine between a face and the sheet that it lies on


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
    centre = outer.V.mean(axis=0)  # Embree has 32 bits
    way = np.zeros(len(middle))
    sheet = Mesh(outer.V + D - centre, outer.F[:, ::-1])
    face, distance = _hits(sheet, middle - centre + _SKIN * normal, -normal)
    alike = np.einsum("ij,ij->i", unit(area_vectors(sheet.V, sheet.F))[face], normal) > _ALIKE
    on = np.flatnonzero((face >= 0) & (distance < 2 * _SKIN) & alike)
    through = Mesh(outer.V - centre, outer.F)
    face, distance = _hits(through, middle[on] - centre, -normal[on])
    way[on] = np.where(face >= 0, distance, 0.0)
    return np.split(way, np.cumsum([len(F) for _, F in pieces])[:-1])


def _hits(mesh: Mesh, origin: Floats, toward: Floats) -> tuple[Ints, Floats]:
    """Give the first face that each ray meets, -1 for none, and the way there."""
    found = RayScene(mesh.V, mesh.F).hits(origin, toward)
    return np.asarray(found["primID"], np.int64), np.asarray(found["tfar"], np.float64)
