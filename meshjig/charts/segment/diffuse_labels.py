"""Straighten chart borders by letting labels diffuse."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from meshjig.charts.segment.dual_graph import Dual

__all__ = ["diffusion", "smooth"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


def smooth(dual: Dual, label: Ints, reach: float = 0.02, steps: int = 2) -> Ints:
    """Shorten borders; folds hold them in place.

    Each step diffuses the indicator of every label over the faces, and gives each face the label
    that it now has most of: motion of the border by its curvature.

    Parameters
    ----------
    dual : Dual
    label : (m,) int64, 0 to k - 1
    reach : float, of the root of the area: how far labels diffuse in a step
    steps : int

    Returns
    -------
    label : (m,) int64. Labels may be lost, and need not hang together.

    References
    ----------
    Merriman, Bence, Osher, "Diffusion Generated Motion by Mean Curvature", 1992.
    """
    diffuse = diffusion(dual, reach)
    for _ in range(steps):
        label = diffuse(label).argmax(1).astype(np.int64)
    return label


def diffusion(dual: Dual, reach: float) -> Callable[[Ints], Floats]:
    """Give the function that turns labels (m,) of faces into their diffused indicators (m, k).

    Parameters
    ----------
    dual : Dual
    reach : float, of the root of the area
    """
    from scipy.sparse import diags
    from scipy.sparse.linalg import splu

    fold = 0.02 + 0.98 * np.clip(dual.bend, 0, 1) ** 4
    W = dual.graph(dual.length / np.maximum(dual.span, 1e-9 * dual.span.max()) * fold)
    L = diags(np.asarray(W.sum(1)).ravel()) - W
    time = reach**2 * dual.area.sum()
    area = np.maximum(dual.area, 1e-9 * dual.area.mean())
    matrix = (diags(area) + time * L).tocsc()
    solver = splu(matrix, permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True})

    def diffuse(label: Ints) -> Floats:
        indicator = np.zeros((len(label), int(label.max()) + 1))
        indicator[np.arange(len(label)), label] = area
        shares: Floats = solver.solve(indicator)
        return shares

    return diffuse
