"""Rays through triangles, by Embree."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from meshjig.mesh.arrays import Bools, Floats, Ints

__all__ = ["Floats32", "Numbers", "RayScene"]

Floats32 = NDArray[np.float32]
Numbers = Floats | Floats32


class RayScene:
    """Triangles that are ready for rays; Embree works in float32.

    Parameters
    ----------
    V : (n, 3) float64
    F : (m, 3) int64
    robust : bool
        Whether no ray slips through between two triangles; a little slower than otherwise.
    """

    def __init__(self, V: Floats, F: Ints, robust: bool = True) -> None:
        from embreex.mesh_construction import TriangleMesh
        from embreex.rtcore_scene import EmbreeScene

        self._scene = EmbreeScene(robust=robust)
        TriangleMesh(self._scene, V[F].astype(np.float32))

    def first_face(self, origin: Numbers, direction: Numbers, reach: Numbers | None = None) -> Ints:
        """Give the first face that each ray meets, -1 for none, (k,).

        Parameters
        ----------
        origin, direction : (k, 3)
        reach : (k,), how far the rays go, in lengths of their direction
        """
        far = () if reach is None else (reach.astype(np.float32),)
        return np.asarray(self._scene.run(_single(origin), _single(direction), *far), np.int64)

    def first_distance(self, origin: Numbers, direction: Numbers) -> Floats:
        """Give how far each ray goes to the first face, in lengths of its direction; huge for none, (k,)."""
        return np.asarray(self._scene.run(_single(origin), _single(direction), query="DISTANCE"), np.float64)

    def is_hidden(self, origin: Numbers, direction: Numbers, reach: Numbers) -> Bools:
        """Tell which rays meet anything within their reach, (k,) bool."""
        found = self._scene.run(
            _single(origin), _single(direction), dists=reach.astype(np.float32), query="OCCLUDED"
        )
        return np.asarray(found >= 0)

    def hits(self, origin: Numbers, direction: Numbers) -> Mapping[str, NDArray[Any]]:
        """Give all that Embree says of the first hit: primID, tfar, u, v, Ng; each (k,) or (k, 3)."""
        return self._scene.run(_single(origin), _single(direction), output=1)


def _single(x: Numbers) -> Any:
    return np.ascontiguousarray(x, np.float32)
