"""Charts by our own segmentation, or by xatlas: found on a proxy, glued there, carried to the mesh."""

from collections.abc import Callable

import numpy as np

from meshjig.charts.chart import Chart, Charting, plain
from meshjig.charts.flatten.flatten import Method, border_is_simple, flat_share, flatten
from meshjig.charts.segment.flatten_or_split import rescue
from meshjig.charts.segment.segment import WORTH_A_CHILD
from meshjig.charts.transfer.transfer_charts import carry_over
from meshjig.mesh.halfedges import Edges
from meshjig.mesh.types import Floats, Ints
from meshjig.runtime.worker import Background

__all__ = ["own_charts"]

_LEAST_SHARE = 0.95  # of the area within FLAT_LIMITS, of a glued chart that ARAP flattens once more
_LEAST_OF_LEAF = 0.97  # the same of LSCM, and of a region of the proxy: less stretched parts of it glue

Zip = Callable[[Floats, Ints, list[Chart]], list[Chart]]


def own_charts(
    V: Floats,
    F: Ints,
    light: tuple[Floats, Ints],
    label: Ints,
    method: Method,
    *,
    seed: int = 0,
    zipped: Zip | None = None,
    e: Edges | None = None,
) -> Charting:
    """Flatten labelled regions of a component, glue them, and make them charts of the mesh.

    Parameters
    ----------
    V, F : (n, 3) float64, mm, and (m, 3) int64, manifold, one component
    light : (V, F) of its proxy
    label : (m',) int64, 0 to k - 1, the region of each face of the proxy
    method : str, how charts are flattened
    seed : int
    zipped : callable, glues charts of the proxy; none are glued without it
    e : Edges, of F, where the caller has them

    Returns
    -------
    Charting
        Every chart is a disc without mirrored faces, with a simple border and a mean stretch of 1. A
        glued chart that makes no such chart of the mesh is left in the parts that it was glued from.

    Raises
    ------
    ChartError
        A face has no area.
    """
    W, G = light
    regions = [np.flatnonzero(label == k) for k in range(int(label.max()) + 1)]
    leaves = _sound_charts(W, G, regions, method, seed, _LEAST_OF_LEAF)
    light_leaf = np.empty(len(G), np.int64)
    for number, leaf in enumerate(leaves):
        light_leaf[leaf.faces] = number
    charts = leaves
    if zipped is not None and len(leaves) > 1:
        glued = zipped(W, G, leaves)
        charts = [one for chart in glued for one in _flattened_by(W, G, chart, method, leaves, light_leaf)]
    if G is F:
        return Charting(charts, method, light_leaf)
    carried, full_leaf = carry_over(V, F, light, light_leaf, charts, method, seed, e=e)
    return Charting(carried, method, full_leaf)


def _sound_charts(
    V: Floats, F: Ints, regions: list[Ints], method: Method, seed: int, least_share: float = 0.0
) -> list[Chart]:
    """Flatten regions, every second one in a child, the largest here."""
    given = [region for region in regions if len(region)]
    order = sorted(range(len(given)), key=lambda k: -len(given[k]))
    found: list[list[Chart]] = [[] for _ in given]
    asked = (V, F, [given[k] for k in order[1::2]], method, seed, least_share)
    other = Background(_rescued, *asked, alone=len(F) < WORTH_A_CHILD or len(given) < 2)
    try:
        for k in order[::2]:
            found[k] = _rescued(V, F, [given[k]], method, seed, least_share)[0]
        for k, charts in zip(order[1::2], other.result(), strict=True):
            found[k] = charts
    except BaseException:
        other.cancel()
        raise
    return [chart for charts in found for chart in charts]


def _rescued(
    V: Floats, F: Ints, regions: list[Ints], method: Method, seed: int, least_share: float
) -> list[list[Chart]]:
    return [[plain(F, *one) for one in rescue(V, F, faces, method, seed, least_share)] for faces in regions]


def _flattened_by(
    V: Floats, F: Ints, chart: Chart, method: Method, leaves: list[Chart], leaf: Ints
) -> list[Chart]:
    """Flatten a glued chart as asked; where that is hardly flat, give what stands in for it."""
    if method == "slim":
        return [chart]
    X = np.empty((len(chart.uv), 3))
    X[chart.corners] = V[F[chart.faces]]
    uv = flatten(X, chart.corners, method)
    least_share = _LEAST_SHARE if method == "arap" else _LEAST_OF_LEAF
    if border_is_simple(uv, chart.corners) and flat_share(X, chart.corners, uv) >= least_share:
        return [Chart(chart.faces, uv, chart.corners)]
    # SLIM, by which it was glued, gives maps like ARAP's; a conformal one has to be of smaller parts
    return [chart] if method == "arap" else [leaves[k] for k in np.unique(leaf[chart.faces])]
