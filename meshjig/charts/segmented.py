"""Charts by our own segmentation, or by xatlas: found on a proxy, glued there, transferred to the mesh."""

from collections.abc import Callable

import numpy as np

from meshjig.charts.chart import Chart, Charting, uncut_chart
from meshjig.charts.distortion import border_is_simple, flat_share
from meshjig.charts.flatten.flatten import Method, flatten
from meshjig.charts.segment.segment import segment
from meshjig.charts.segment.split import flatten_or_split
from meshjig.charts.transfer.transfer_charts import transfer_charts
from meshjig.charts.zip.zip import zip_charts
from meshjig.errors import ChartError
from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.mesh import Mesh
from meshjig.runtime.thresholds import CHARTS_WORTH_A_CHILD
from meshjig.runtime.worker import Background

__all__ = ["own_charts", "single_chart"]

_LEAST_SHARE = 0.95  # of the area within FLAT_LIMITS, of a glued chart that ARAP flattens once more
_LEAST_OF_REGION = 0.97  # the same of LSCM, and of a region of the proxy: less stretched parts of it glue

_SHARES = (0.985, 0.95, 0.9, 0.8)  # of the area within FLAT_LIMITS, the best first; less is hopeless
_EFFORT = 40_000  # faces flattened, for each of them

Zip = Callable[[Floats, Ints, list[Chart]], list[Chart]]


def own_charts(
    mesh: Mesh, proxy: Mesh, label: Ints, method: Method, seed: int = 0, zipped: Zip | None = None
) -> Charting:
    """Flatten labelled regions of a component, glue them, and make them charts of the mesh.

    Parameters
    ----------
    mesh : Mesh, manifold, one component
    proxy : Mesh
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
    W, G = proxy
    labelled = [np.flatnonzero(label == k) for k in range(int(label.max()) + 1)]
    regions = _sound_charts(W, G, labelled, method, seed, _LEAST_OF_REGION)
    region = np.empty(len(G), np.int64)
    for number, chart in enumerate(regions):
        region[chart.faces] = number
    charts = regions
    if zipped is not None and len(regions) > 1:
        glued = zipped(W, G, regions)
        charts = [one for chart in glued for one in _flattened_by(proxy, chart, method, regions, region)]
    found = Charting(charts, method, region)
    return found if proxy is mesh else transfer_charts(mesh, proxy, found, method, seed)


def _sound_charts(
    V: Floats, F: Ints, regions: list[Ints], method: Method, seed: int, least_share: float = 0.0
) -> list[Chart]:
    """Flatten regions, every second one in a child, the largest here."""
    given = [region for region in regions if len(region)]
    order = sorted(range(len(given)), key=lambda k: -len(given[k]))
    found: list[list[Chart]] = [[] for _ in given]
    asked = (V, F, [given[k] for k in order[1::2]], method, seed, least_share)
    other = Background(_rescued, *asked, alone=len(F) < CHARTS_WORTH_A_CHILD or len(given) < 2)
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
    return [
        [uncut_chart(F, *one) for one in flatten_or_split(V, F, faces, method, seed, least_share)]
        for faces in regions
    ]


def _flattened_by(
    mesh: Mesh, chart: Chart, method: Method, regions: list[Chart], region: Ints
) -> list[Chart]:
    """Flatten a glued chart as asked; where that is hardly flat, give what stands in for it."""
    if method == "slim":
        return [chart]
    X = np.empty((len(chart.uv), 3))
    X[chart.corners] = mesh.V[mesh.F[chart.faces]]
    uv = flatten(X, chart.corners, method)
    least_share = _LEAST_SHARE if method == "arap" else _LEAST_OF_REGION
    if border_is_simple(uv, chart.corners) and flat_share(X, chart.corners, uv) >= least_share:
        return [Chart(chart.faces, uv, chart.corners)]
    # SLIM, by which it was glued, gives maps like ARAP's; a conformal one has to be of smaller parts
    return [chart] if method == "arap" else [regions[k] for k in np.unique(region[chart.faces])]


def single_chart(mesh: Mesh, proxy: Mesh, seed: int = 0) -> Charting:
    """Cut a component open so that it is one disc, and flatten it by SLIM.

    The cuts are what is left of the seams between few flat regions after these were glued to one: they
    pass through tips and creases, where a cut takes most stretch away.

    Parameters
    ----------
    mesh : Mesh, manifold, one component
    proxy : Mesh
    seed : int

    Returns
    -------
    Charting

    Raises
    ------
    ChartError
        The component would stretch too much, or lie on itself.
    """
    label = segment(proxy.V, proxy.F, seed=seed)
    made = own_charts(mesh, proxy, label, "slim", seed, _glued_to_one)
    if len(made.charts) == 1:
        return Charting(made.charts, "single", made.region)
    area = mesh.areas
    largest = max(float(area[chart.faces].sum() / area.sum()) for chart in made.charts)
    raise ChartError(
        f"one chart of {len(mesh.F)} faces would lie on itself, or stretch more than {1 - _SHARES[-1]:.0%} "
        f"of its area by more than a fifth; {len(made.charts)} charts are left, "
        f"the largest with {largest:.0%}",
        hint="use --charts auto",
    )


def _glued_to_one(V: Floats, F: Ints, regions: list[Chart]) -> list[Chart]:
    """Glue charts to one, at the least stretch first; to a few where that fails."""
    return zip_charts(V, F, regions, _SHARES, _EFFORT)
