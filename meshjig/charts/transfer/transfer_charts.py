"""Charts of a light mesh as charts of a finer one: carried whole, in parts, or flattened anew."""

import numpy as np

from meshjig.charts.chart import Chart, plain
from meshjig.charts.flatten.flatten import Method, flat_share
from meshjig.charts.segment.dual_graph import dual
from meshjig.charts.segment.flatten_or_split import rescue
from meshjig.charts.segment.patches import patches
from meshjig.charts.transfer.proxy import coarsened
from meshjig.charts.transfer.transfer_chart import Carrier
from meshjig.charts.transfer.transfer_labels import transfer_labels
from meshjig.mesh.closest_points import nearest
from meshjig.mesh.components import components
from meshjig.mesh.halfedges import Edges, compact, edges
from meshjig.mesh.measure import face_areas
from meshjig.mesh.types import Bools, Floats, Ints

__all__ = ["carry_over"]

_HEAVY = 40_000  # faces: a larger region takes too long to flatten


def carry_over(
    V: Floats,
    F: Ints,
    light: tuple[Floats, Ints],
    light_leaf: Ints,
    charts: list[Chart],
    method: Method,
    seed: int = 0,
    settles: bool = True,
    e: Edges | None = None,
) -> tuple[list[Chart], Ints]:
    """Make charts of a light mesh charts of the mesh that it stands for.

    Parameters
    ----------
    V, F : (n, 3) float64, mm, and (m, 3) int64, manifold, one component
    light : (V, F) of its proxy
    light_leaf : (m',) int64, 0 to k - 1: regions of the proxy of which charts are made, glued or not
    charts : list of Chart, of the proxy
    method : str, how what can't be carried is flattened
    seed : int
    settles : bool, whether to look for details of the mesh that the proxy has not seen
    e : Edges, of F, where the caller has them

    Returns
    -------
    charts : list of Chart
        Discs without mirrored faces, with simple borders and a mean stretch of 1. A chart that can't be
        carried whole comes in the parts that it was glued from.
    leaf : (m,) int64

    Raises
    ------
    ChartError
        A face has no area.
    """
    W, G = light
    e = edges(F) if e is None else e
    places = nearest(V, W, G)
    leaf = transfer_labels(V, F, W, G, light_leaf, e, places)
    carrier = Carrier(V, F, leaf, W, G, light_leaf, e, places, settles)
    carried: list[Chart] = []
    for chart in charts:
        made, missing = _carried(carrier, chart, light_leaf)
        carried += made
        for part in missing:
            region = np.flatnonzero(leaf == light_leaf[part.faces[0]])
            carried += _pulled_or_anew(carrier, part, V, F, region, method, seed)
    return carried, leaf


def _pulled_or_anew(
    carrier: Carrier, part: Chart, V: Floats, F: Ints, region: Ints, method: Method, seed: int
) -> list[Chart]:
    """Carry a leaf whatever it loses, or flatten its faces anew where that is better."""
    pulled = carrier.carry(part, may_lose=1.0)
    if not len(region) or (pulled is not None and len(region) > _HEAVY):
        return [] if pulled is None else [pulled]
    if len(region) > _HEAVY:
        return _by_halves(V, F, region, method, seed)
    anew = [plain(F, *chart) for chart in rescue(V, F, region, method, seed)]
    return anew if pulled is None or _flat(V, F, anew) > _flat(V, F, [pulled]) else [pulled]


def _by_halves(V: Floats, F: Ints, region: Ints, method: Method, seed: int) -> list[Chart]:
    """Make charts of a heavy region: two or more, found on a coarser mesh of it."""
    H, kept = compact(F[region])
    W, G = light = coarsened(V[kept], H, _HEAVY)
    half = patches(dual(W, G), 2, seed, rounds=4)
    found = [plain(G, *one) for k in (0, 1) for one in rescue(W, G, np.flatnonzero(half == k), method, seed)]
    leaf = np.empty(len(G), np.int64)
    for number, chart in enumerate(found):
        leaf[chart.faces] = number
    made, _ = carry_over(V[kept], H, light, leaf, found, method, seed, settles=False)
    return [Chart(region[chart.faces], chart.uv, chart.corners) for chart in made]


def _flat(V: Floats, F: Ints, charts: list[Chart]) -> float:
    """Give the area of charts that lies within FLAT_LIMITS, mm2."""
    total = 0.0
    for chart in charts:
        X = np.empty((len(chart.uv), 3))
        X[chart.corners] = V[F[chart.faces]]
        total += flat_share(X, chart.corners, chart.uv) * float(face_areas(V, F[chart.faces]).sum())
    return total


def _carried(carrier: Carrier, chart: Chart, leaf: Ints) -> tuple[list[Chart], list[Chart]]:
    """Carry a chart whole, or what hangs together without the leaves that can't be carried, or its leaves.

    The second list holds the leaves that can't be carried.
    """
    whole = carrier.carry(chart)
    if whole is not None:
        return [whole], []
    numbers = np.unique(leaf[chart.faces]).tolist()
    if len(numbers) == 1:
        return [], [chart]
    leaves = {number: _parts(chart, leaf[chart.faces] == number)[0] for number in numbers}
    alone = {number: carrier.carry(leaves[number]) for number in numbers}
    sound = [number for number in numbers if alone[number] is not None]
    made: list[Chart] = []
    for part in _parts(chart, np.isin(leaf[chart.faces], sound)):
        inside = np.unique(leaf[part.faces]).tolist()
        glued = carrier.carry(part) if 1 < len(inside) < len(numbers) else None
        made += [glued] if glued is not None else [one for k in inside if (one := alone[k]) is not None]
    return made, [leaves[number] for number in numbers if alone[number] is None]


def _parts(chart: Chart, kept: Bools) -> list[Chart]:
    """Give the parts that hang together of a chart of which only some faces (k,) are kept."""
    n, part = components(chart.corners[kept])
    parts = []
    for k in range(n):
        rows = np.flatnonzero(kept)[part == k]
        corners, own = compact(chart.corners[rows])
        parts.append(Chart(chart.faces[rows], chart.uv[own], corners))
    return parts
