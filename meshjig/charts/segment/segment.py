"""Divide a mesh into few, large, nearly flat discs."""

import importlib

import numpy as np
from numpy.typing import NDArray

from meshjig.charts.segment.absorb import dissolve
from meshjig.charts.segment.accept import Judge
from meshjig.charts.segment.clean_labels import tidy
from meshjig.charts.segment.diffuse_labels import smooth
from meshjig.charts.segment.dual_graph import Dual, dual
from meshjig.charts.segment.merge import merge
from meshjig.charts.segment.neck_free import stouter
from meshjig.charts.segment.patches import patches
from meshjig.charts.segment.polish import polish
from meshjig.charts.segment.split import split
from meshjig.runtime.worker import Background

__all__ = ["WORTH_A_CHILD", "get_ready", "segment"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

WORTH_A_CHILD = 4000  # faces; below, a child process takes longer to start than it saves


def segment(
    V: Floats, F: Ints, n_patches: int = 90, seed: int = 0, rounds: int = 1, conformal: bool = False
) -> Ints:
    """Label each face of one component with its chart.

    Patches are merged to charts, twice from other patches, side by side; the better division is taken.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, manifold, one component
    n_patches : int, how many patches the charts are merged from
    seed : int
    rounds : int, of smoothing borders and merging again
    conformal : bool, whether charts will be flattened with their angles kept, which takes more of them

    Returns
    -------
    chart_of_face : (m,) int64, 0 to k - 1; every chart is one that the Judge accepts, or a single face
    """
    judge = Judge(V, F, conformal=conformal)
    if judge.accepts(np.arange(len(F))):
        return np.zeros(len(F), np.int64)
    graph = dual(V, F)
    other = Background(_searched, V, F, n_patches, seed + 1, rounds, conformal, alone=len(F) < WORTH_A_CHILD)
    try:
        found = _search(V, F, graph, judge, n_patches, seed, rounds), other.result()
    except BaseException:
        other.cancel()
        raise
    return polish(F, graph, min(found, key=lambda label: _cost(graph, label)), judge)


def get_ready() -> None:
    """Import what a search needs: in a child, while the mesh is still made lighter."""
    for name in ("igl", "shapely", "scipy.sparse.csgraph", "scipy.sparse.linalg"):
        importlib.import_module(name)


def _searched(V: Floats, F: Ints, n_patches: int, seed: int, rounds: int, conformal: bool) -> Ints:
    return _search(V, F, dual(V, F), Judge(V, F, conformal=conformal), n_patches, seed, rounds)


def _search(V: Floats, F: Ints, graph: Dual, judge: Judge, n_patches: int, seed: int, rounds: int) -> Ints:
    """Merge patches to charts, then smooth and merge again for as long as that helps."""
    label = merge(graph, split(V, F, patches(graph, n_patches, seed), judge.accepts, seed), judge)
    for _ in range(rounds):
        straight = stouter(F, tidy(F, smooth(graph, label), graph.area), graph.area)
        smoother = merge(graph, split(V, F, straight, judge.accepts, seed), judge)
        if smoother.max() > label.max():
            break
        label = dissolve(V, F, graph, smoother, judge, seed)
    return label


def _cost(graph: Dual, label: Ints) -> float:
    """Weigh charts against the length of their seams, in roots of the area."""
    seam = graph.length[label[graph.first] != label[graph.second]].sum()
    return float(label.max() + seam / np.sqrt(graph.area.sum()))
