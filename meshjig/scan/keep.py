"""Keep the largest parts of a model, and leave out the rest."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.components import components
from meshjig.mesh.halfedges import compact
from meshjig.mesh.measure import face_areas, sums
from meshjig.scan.preparation import Keep

__all__ = ["Kept", "keep_largest"]


class Kept(NamedTuple):
    """What is left of a mesh."""

    V: Floats  # (n, 3)
    F: Ints  # (m, 3)
    left_out: int  # connected parts
    area_share: float  # of what was left out


def keep_largest(V: Floats, F: Ints, keep: Keep) -> Kept:
    """Keep the connected parts with the largest areas.

    Parameters
    ----------
    V : (n, 3) float64
    F : (m, 3) int64, manifold
    keep : int, how many; "largest" is 1, "all" leaves out none

    Returns
    -------
    Kept
    """
    if keep == "all":
        return Kept(V, F, 0, 0.0)
    n, component = components(F)
    most = 1 if keep == "largest" else keep
    if n <= most:
        return Kept(V, F, 0, 0.0)
    area = sums(component, face_areas(V, F), n)
    stays = np.zeros(n, bool)
    stays[np.argsort(-area, kind="stable")[:most]] = True
    G, used = compact(F[stays[component]])
    return Kept(V[used], G, n - most, float(area[~stays].sum() / area.sum()))
