"""Divide a mesh into few, large, nearly flat discs."""

import numpy as np
from numpy.typing import NDArray

from meshjig.charts.dissolve import dissolve
from meshjig.charts.dual import dual
from meshjig.charts.judge import Judge
from meshjig.charts.merge import merge
from meshjig.charts.patches import patches
from meshjig.charts.smooth import smooth
from meshjig.charts.split import split
from meshjig.charts.tidy import tidy

__all__ = ["segment"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


def segment(V: Floats, F: Ints, n_patches: int = 90, seed: int = 0, rounds: int = 2) -> Ints:
    """Label each face of one component with its chart.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, manifold, one component
    n_patches : int, how many patches the charts are merged from
    seed : int
    rounds : int, of smoothing borders and merging again

    Returns
    -------
    chart_of_face : (m,) int64, 0 to k - 1; every chart is one that the Judge accepts, or a single face
    """
    judge = Judge(V, F)
    whole = np.zeros(len(F), np.int64)
    if judge.accepts(np.arange(len(F))):
        return whole
    graph = dual(V, F)
    label = merge(graph, split(V, F, patches(graph, n_patches, seed), judge.accepts, seed), judge)
    for _ in range(rounds):
        straight = tidy(F, smooth(graph, label), graph.area)
        smoother = merge(graph, split(V, F, straight, judge.accepts, seed), judge)
        if smoother.max() > label.max():
            break
        label = dissolve(V, F, graph, smoother, judge, seed)
    return label
