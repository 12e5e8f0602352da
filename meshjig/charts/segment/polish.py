"""Shorten the borders between charts, pair by pair, for as long as both stay good charts."""

import numpy as np
from numpy.typing import NDArray

from meshjig.charts.segment.accept import Judge
from meshjig.charts.segment.clean_labels import tidy
from meshjig.charts.segment.diffuse_labels import diffusion
from meshjig.charts.segment.dual_graph import Dual

__all__ = ["polish"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

_REACH = (0.05, 0.035, 0.025, 0.02)  # of the root of the area: borders move far, then get smooth


def polish(F: Ints, graph: Dual, label: Ints, judge: Judge) -> Ints:
    """Let borders move by their curvature, over folds hardly at all.

    Parameters
    ----------
    F : (m, 3) int64, manifold, one component
    graph : Dual, of the mesh
    label : (m,) int64, 0 to k - 1, every chart one that the judge accepts
    judge : Judge

    Returns
    -------
    label : (m,) int64, 0 to k - 1, every chart one that the judge accepts
    """
    k = int(label.max()) + 1
    for reach in _REACH:
        wanted = tidy(F, diffusion(graph, reach)(label).argmax(1).astype(np.int64), graph.area)
        low, high = np.minimum(label, wanted), np.maximum(label, wanted)
        for pair in np.unique((low * k + high)[low != high]).tolist():
            moved = (low == pair // k) & (high == pair % k)
            after = np.where(moved, wanted, label)
            if _seam(graph, after) < _seam(graph, label) and all(
                judge.accepts(np.flatnonzero(after == chart)) for chart in (pair // k, pair % k)
            ):
                label = after
    return label


def _seam(graph: Dual, label: Ints) -> float:
    """Give the length of the borders between labels, mm; along folds they count for less."""
    rim = label[graph.first] != label[graph.second]
    return float((graph.length[rim] * (0.3 + 0.7 * np.clip(graph.bend[rim], 0, 1))).sum())
