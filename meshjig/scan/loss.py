"""How much of a mesh is gone after it was repaired, and what to say of it."""

from __future__ import annotations

from typing import NamedTuple

from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.measure import face_areas

__all__ = ["MUCH", "Loss", "loss"]

_ROUNDING = 1e-9
MUCH = 0.1  # of the faces, or of the area: what is lost beyond it is said


class Loss(NamedTuple):
    """What is gone of a mesh, as shares from 0 to 1."""

    faces: float
    area: float

    @property
    def much(self) -> bool:
        """Whether more is gone than should go without a word."""
        return max(self) > MUCH


def loss(before: tuple[Floats, Ints], after: tuple[Floats, Ints]) -> Loss:
    """Give the shares of the faces and of the area that a mesh has lost.

    Parameters
    ----------
    before, after : (V (n, 3) float64, F (m, 3) int64), in one unit

    Returns
    -------
    Loss
        0 where something came in addition.
    """
    faces = 1 - len(after[1]) / max(len(before[1]), 1)
    area = 1 - float(face_areas(*after).sum()) / max(float(face_areas(*before).sum()), 1e-300)
    return Loss(max(faces, 0.0), area if area > _ROUNDING else 0.0)
