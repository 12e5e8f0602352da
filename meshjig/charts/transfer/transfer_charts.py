"""Charts of a proxy as charts of its mesh: transferred whole, in parts, or flattened afresh."""

import numpy as np

from meshjig.charts.chart import Chart, Charting, uncut_chart
from meshjig.charts.distortion import flat_share
from meshjig.charts.flatten.flatten import Method
from meshjig.charts.segment.dual_graph import dual_graph, patches
from meshjig.charts.segment.split import flatten_or_split
from meshjig.charts.transfer.proxy import coarsened
from meshjig.charts.transfer.transfer_chart import ChartTransfer
from meshjig.charts.transfer.transfer_labels import transfer_labels
from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.closest_points import nearest
from meshjig.mesh.components import components
from meshjig.mesh.halfedges import compact
from meshjig.mesh.measure import face_areas
from meshjig.mesh.mesh import Mesh

__all__ = ["transfer_charts"]

_HEAVY = 40_000  # faces: a larger region takes too long to flatten


def transfer_charts(
    mesh: Mesh, proxy: Mesh, found: Charting, method: Method, seed: int = 0, details: bool = True
) -> Charting:
    """Make charts of a proxy charts of the mesh that it stands for.

    Parameters
    ----------
    mesh : Mesh, manifold, one component
    proxy : Mesh
    found : Charting
        Of the proxy: charts are made of its regions, glued or not; it is one region where none are named.
    method : str, how what can't be transferred is flattened
    seed : int
    details : bool, whether to look for details of the mesh that the proxy has not seen

    Returns
    -------
    Charting
        Discs without mirrored faces, with simple borders and a mean stretch of 1. A chart that can't be
        transferred whole comes in the parts that it was glued from.

    Raises
    ------
    ChartError
        A face has no area.
    """
    proxy_region = np.zeros(len(proxy.F), np.int64) if found.region is None else found.region
    places = nearest(mesh.V, proxy.V, proxy.F)
    region = transfer_labels(mesh, proxy, proxy_region, places)
    transfer = ChartTransfer(mesh, region, proxy, proxy_region, places, details)
    charts: list[Chart] = []
    for chart in found.charts:
        made, missing = _transferred(transfer, chart, proxy_region)
        charts += made
        for part in missing:
            faces = np.flatnonzero(region == proxy_region[part.faces[0]])
            charts += _pulled_or_flattened(transfer, part, faces, method, seed)
    return Charting(charts, found.method, region, found.note)


def _pulled_or_flattened(
    transfer: ChartTransfer, part: Chart, faces: Ints, method: Method, seed: int
) -> list[Chart]:
    """Transfer a region whatever it loses, or flatten its faces afresh where that is better."""
    pulled = transfer.apply(part, may_lose=1.0)
    if not len(faces) or (pulled is not None and len(faces) > _HEAVY):
        return [] if pulled is None else [pulled]
    if len(faces) > _HEAVY:
        return _by_halves(transfer.mesh, faces, method, seed)
    V, F = transfer.mesh
    afresh = [uncut_chart(F, *chart) for chart in flatten_or_split(V, F, faces, method, seed)]
    return afresh if pulled is None or _flat(V, F, afresh) > _flat(V, F, [pulled]) else [pulled]


def _by_halves(mesh: Mesh, faces: Ints, method: Method, seed: int) -> list[Chart]:
    """Make charts of a heavy region: two or more, found on a coarser mesh of it."""
    H, kept = compact(mesh.F[faces])
    part = Mesh(mesh.V[kept], H)
    W, G = coarse = coarsened(part, _HEAVY)
    half = patches(dual_graph(W, G), 2, seed, rounds=4)
    halves = [np.flatnonzero(half == k) for k in (0, 1)]
    charts = [uncut_chart(G, *one) for some in halves for one in flatten_or_split(W, G, some, method, seed)]
    region = np.empty(len(G), np.int64)
    for number, chart in enumerate(charts):
        region[chart.faces] = number
    made = transfer_charts(part, coarse, Charting(charts, method, region), method, seed, details=False)
    return [Chart(faces[chart.faces], chart.uv, chart.corners) for chart in made.charts]


def _flat(V: Floats, F: Ints, charts: list[Chart]) -> float:
    """The area of charts that lies within FLAT_LIMITS, mm2."""
    total = 0.0
    for chart in charts:
        X = np.empty((len(chart.uv), 3))
        X[chart.corners] = V[F[chart.faces]]
        total += flat_share(X, chart.corners, chart.uv) * float(face_areas(V, F[chart.faces]).sum())
    return total


def _transferred(transfer: ChartTransfer, chart: Chart, region: Ints) -> tuple[list[Chart], list[Chart]]:
    """Transfer a chart whole, or what is connected of its regions that can be, or its regions one by one.

    The second list holds the regions that can't be transferred.
    """
    whole = transfer.apply(chart)
    if whole is not None:
        return [whole], []
    numbers = np.unique(region[chart.faces]).tolist()
    if len(numbers) == 1:
        return [], [chart]
    regions = {number: _parts(chart, region[chart.faces] == number)[0] for number in numbers}
    alone = {number: transfer.apply(regions[number]) for number in numbers}
    sound = [number for number in numbers if alone[number] is not None]
    made: list[Chart] = []
    for part in _parts(chart, np.isin(region[chart.faces], sound)):
        inside = np.unique(region[part.faces]).tolist()
        glued = transfer.apply(part) if 1 < len(inside) < len(numbers) else None
        made += [glued] if glued is not None else [one for k in inside if (one := alone[k]) is not None]
    return made, [regions[number] for number in numbers if alone[number] is None]


def _parts(chart: Chart, kept: Bools) -> list[Chart]:
    """The parts that are connected of a chart of which only some faces (k,) are kept."""
    n, part = components(chart.corners[kept])
    parts = []
    for k in range(n):
        rows = np.flatnonzero(kept)[part == k]
        corners, own = compact(chart.corners[rows])
        parts.append(Chart(chart.faces[rows], chart.uv[own], corners))
    return parts
