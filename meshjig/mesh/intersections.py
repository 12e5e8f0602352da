"""Where a surface passes through itself."""

from __future__ import annotations

import numpy as np

from meshjig.mesh.types import Floats, Ints

__all__ = ["self_crossings"]


def self_crossings(V: Floats, F: Ints) -> Ints | None:
    """List the pairs of faces that cross, by exact arithmetic.

    Faces that meet in a shared edge or corner only are no crossing; neighbours that pass through each
    other are, and so are faces that overlap in one plane. Every pair counts, however shallow: the
    coordinates are taken as given.

    Parameters
    ----------
    V : (n, 3) float64
    F : (m, 3) int64

    Returns
    -------
    pairs : (k, 2) int64, each with the lower face first, in lexicographic order; None when the test could
        not be run

    Notes
    -----
    About 0.15 s for 100,000 faces: a sweep over boxes first, then CGAL's exact predicates. Two faces
    whose corners lie in the same three places are not reported.
    """
    if not len(F):
        return np.zeros((0, 2), np.int64)
    if F.min() < 0 or F.max() >= len(V) or not np.isfinite(V[F]).all():
        return None  # native code would read beyond the array
    try:
        from igl.copyleft.cgal import remesh_self_intersections

        found = remesh_self_intersections(V, F, detect_only=True)[2]
    except (ImportError, RuntimeError, ValueError):
        return None
    pairs = np.sort(np.asarray(found, np.int64).reshape(-1, 2), axis=1)
    return np.unique(pairs, axis=0)
