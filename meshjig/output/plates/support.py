"""What a printer has to hold up: faces that lean over, and the room below them."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.measure import area_vectors
from meshjig.mesh.rays import RayScene
from meshjig.output.plates.pose import ON_PLATE, STEEP

__all__ = ["Support", "support_under"]

_BELOW = 1e-3  # mm under a face, where its ray starts


class Support(NamedTuple):
    """What is under a piece as it lies."""

    overhang: float  # mm2, the shadow of faces that need support
    room: float  # mm3, below them down to the plate, or to the piece itself


def support_under(V: Floats, F: Ints) -> Support:
    """Measure how much of a piece hangs over, and how high.

    Parameters
    ----------
    V : (n, 3) float64, mm, as it lies: the plate is at its least z
    F : (m, 3) int64, oriented outward

    Returns
    -------
    Support
    """
    A, height = area_vectors(V, F) / 2, V[:, 2] - V[:, 2].min()
    leaning = -A[:, 2] > np.cos(np.radians(STEEP)) * np.linalg.norm(A, axis=1)
    hanging = np.flatnonzero(leaning & ~(height < ON_PLATE)[F].all(axis=1))
    if not len(hanging):
        return Support(0.0, 0.0)
    middle, scale = V.mean(axis=0), float(np.ptp(V, axis=0).max())
    start = V[F[hanging]].mean(axis=1) - [0, 0, _BELOW]
    found = RayScene((V - middle) / scale, F, robust=True).hits(
        (start - middle) / scale, np.broadcast_to([0.0, 0.0, -1.0], start.shape)
    )
    down_to_plate = height[F[hanging]].mean(axis=1)
    drop = np.where(found["primID"] >= 0, np.minimum(found["tfar"], 1e6) * scale, down_to_plate)
    shadow = -A[hanging, 2]
    return Support(float(shadow.sum()), float(shadow @ drop))
