"""From the plane to the surface: how wide things drawn in the plane are in space."""

from typing import Any

import numpy as np

from meshjig.mesh.measure import barycentric, interpolate
from meshjig.mesh.types import Atlas, Floats

__all__ = ["Lift"]

_NEAREST = 8  # faces among which the one that a point lies in is looked for


class Lift:
    """Points of an atlas in space; a point in none of the nearest faces takes the plane of one.

    Parameters
    ----------
    atlas : Atlas
    """

    def __init__(self, atlas: Atlas) -> None:
        from scipy.spatial import cKDTree

        self._atlas = atlas
        self._tree: Any = cKDTree(atlas.uv[atlas.F_uv].mean(1), balanced_tree=False, compact_nodes=False)

    def widths(self, pairs: Floats) -> Floats:
        """Give the distance in space between two points (k, 2, 2) each; (k,), mm."""
        p = pairs.reshape(-1, 2)
        uv, F = self._atlas.uv, self._atlas.F_uv
        k = min(_NEAREST, len(F))
        face = self._tree.query(p, k)[1].reshape(len(p), k)
        bary = barycentric(uv, F, face.ravel(), np.repeat(p, k, axis=0)).reshape(len(p), k, 3)
        best = bary.min(2).argmax(1)
        row = np.arange(len(p))
        x = interpolate(self._atlas.mesh.V, self._atlas.mesh.F, face[row, best], bary[row, best])
        return np.linalg.norm(x[0::2] - x[1::2], axis=1)
