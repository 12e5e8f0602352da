"""Charts by our own segmentation, or by xatlas: found on a proxy, glued there, carried to the mesh."""

from collections.abc import Callable

import numpy as np

from meshjig.charts.carry import Carrier
from meshjig.charts.chart import Chart, Charting, plain
from meshjig.charts.flatten import Method, border_is_simple, flat_share, flatten
from meshjig.charts.rescue import rescue
from meshjig.charts.transfer import transfer_labels
from meshjig.measure import face_areas
from meshjig.topology import compact, components
from meshjig.types import Bools, Floats, Ints

__all__ = ["own_charts"]

_LEAST_SHARE = 0.95  # of the area within FLAT_LIMITS, of a glued chart that is flattened once more
_LEAST_OF_LEAF = 0.97  # the same of a region of the proxy: less stretched parts of it can be glued later

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
    carrier = Carrier(V, F, transfer_labels(V, F, W, G, light_leaf), W, G, light_leaf)
    carried: list[Chart] = []
    for chart in charts:
        made, missing = _carried(carrier, chart, leaves, light_leaf)
        carried += made
        for number in missing:
            region = np.flatnonzero(carrier.leaf == number)
            anew = _sound_charts(V, F, [region], method, seed)
            pulled = carrier.carry(leaves[number], may_lose=1.0)
            carried += anew if pulled is None or _flat(V, F, anew) > _flat(V, F, [pulled]) else [pulled]
    return Charting(carried, method, carrier.leaf)


def _flat(V: Floats, F: Ints, charts: list[Chart]) -> float:
    """Give the area of charts that lies within FLAT_LIMITS, mm2."""
    total = 0.0
    for chart in charts:
        X = np.empty((len(chart.uv), 3))
        X[chart.corners] = V[F[chart.faces]]
        total += flat_share(X, chart.corners, chart.uv) * float(face_areas(V, F[chart.faces]).sum())
    return total


def _carried(
    carrier: Carrier, chart: Chart, leaves: list[Chart], leaf: Ints
) -> tuple[list[Chart], list[int]]:
    """Carry a chart whole, or what hangs together without the leaves that can't be carried, or its leaves.

    The second list holds the leaves that can't be carried.
    """
    whole = carrier.carry(chart)
    if whole is not None:
        return [whole], []
    numbers = np.unique(leaf[chart.faces]).tolist()
    alone = {number: carrier.carry(leaves[number]) for number in numbers} if len(numbers) > 1 else {}
    sound = [number for number in numbers if alone.get(number) is not None]
    made: list[Chart] = []
    for part in _parts(chart, np.isin(leaf[chart.faces], sound)):
        inside = np.unique(leaf[part.faces]).tolist()
        glued = carrier.carry(part) if 1 < len(inside) < len(numbers) else None
        made += [glued] if glued is not None else [one for k in inside if (one := alone[k]) is not None]
    return made, [number for number in numbers if number not in sound]


def _parts(chart: Chart, kept: Bools) -> list[Chart]:
    """Give the parts that hang together of a chart of which only some faces (k,) are kept."""
    n, part = components(chart.corners[kept])
    parts = []
    for k in range(n):
        rows = np.flatnonzero(kept)[part == k]
        corners, own = compact(chart.corners[rows])
        parts.append(Chart(chart.faces[rows], chart.uv[own], corners))
    return parts


def _sound_charts(
    V: Floats, F: Ints, regions: list[Ints], method: Method, seed: int, least_share: float = 0.0
) -> list[Chart]:
    given = [region for region in regions if len(region)]
    return [plain(F, *chart) for region in given for chart in rescue(V, F, region, method, seed, least_share)]


def _flattened_by(
    V: Floats, F: Ints, chart: Chart, method: Method, leaves: list[Chart], leaf: Ints
) -> list[Chart]:
    """Flatten a glued chart as asked; where that is hardly flat, give what stands in for it."""
    if method == "slim":
        return [chart]
    X = np.empty((len(chart.uv), 3))
    X[chart.corners] = V[F[chart.faces]]
    uv = flatten(X, chart.corners, method)
    if border_is_simple(uv, chart.corners) and flat_share(X, chart.corners, uv) >= _LEAST_SHARE:
        return [Chart(chart.faces, uv, chart.corners)]
    # SLIM, by which it was glued, gives maps like ARAP's; a conformal one has to be of smaller parts
    return [chart] if method == "arap" else [leaves[k] for k in np.unique(leaf[chart.faces])]
