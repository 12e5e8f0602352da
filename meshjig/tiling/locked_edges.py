"""Which tiles of a tiling hold on to each other in the plane."""

import numpy as np

from meshjig.mesh.types import Bools, Floats
from meshjig.tiling.outline import edge_curves
from meshjig.tiling.unit import Unit

__all__ = ["locked_edges"]

_SLACK = 0.01  # radians that a border must curl back by


def locked_edges(unit: Unit) -> Bools:
    """Tell which edges lie between two tiles that can't be pulled apart in any one direction.

    A tile can be pulled off its neighbour if all their border's normals point to one side; so the border,
    all edges between the two, locks when its directions leave no half turn free.

    Parameters
    ----------
    unit : Unit

    Returns
    -------
    (e,) bool
    """
    borders: dict[tuple[int, ...], list[tuple[int, Floats]]] = {}
    for edge, curve in enumerate(edge_curves(unit)):
        (left, i, j), (right, k, m) = unit.sides[edge].tolist()
        forth, back = (left, right, k - i, m - j), (right, left, i - k, j - m)
        along = np.diff(curve if forth <= back else curve[::-1], axis=0)
        borders.setdefault(min(forth, back), []).append((edge, along))
    locked = np.zeros(len(unit.sides), bool)
    for border in borders.values():
        locked[[edge for edge, _ in border]] = _curls_back(np.vstack([along for _, along in border]))
    return locked


def _curls_back(along: Floats) -> bool:
    angles = np.sort(np.arctan2(along[:, 1], along[:, 0]))
    widest = np.diff(np.r_[angles, angles[0] + 2 * np.pi]).max()
    return bool(widest < np.pi - _SLACK)
