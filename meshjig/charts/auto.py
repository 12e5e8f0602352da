"""The method for a component: the one that was asked for, or the best by measured gates."""

from typing import Any, Literal

import numpy as np

from meshjig.charts.arrange import lay_out
from meshjig.charts.atlas_distortion import quality
from meshjig.charts.chart import Chart, Charting
from meshjig.charts.denoise import smoothed
from meshjig.charts.flatten.flatten import Method
from meshjig.charts.segment.segment import segment
from meshjig.charts.segmented import own_charts
from meshjig.charts.single import single_chart
from meshjig.charts.transfer.proxy import coarsened, proxy
from meshjig.charts.transfer.transfer_charts import carry_over
from meshjig.charts.unwrap import unwrap
from meshjig.charts.zip.zip import zip_charts
from meshjig.errors import ChartError
from meshjig.mesh.halfedges import Edges, edges
from meshjig.mesh.types import Floats, Ints, Mesh
from meshjig.runtime.worker import Background

__all__ = ["GATE", "ComponentMethod", "chart_component"]

ComponentMethod = Literal["auto", "lscm", "arap", "slim", "xatlas", "single", "periodic"]

GATE = 0.97  # of the area within FLAT_LIMITS
_HEAVY = 300_000  # faces: charts of more are found on a coarser mesh
_MIDDLE = 60_000  # faces of that, at most
_PASSES = 1  # that take away what noise coarsening leaves
_FEW_SEAMS = 3.5  # length over the root of the area: our segmentation hardly ever needs less


def chart_component(
    V: Floats,
    F: Ints,
    method: ComponentMethod,
    *,
    seed: int = 0,
    zipped: bool = True,
    xatlas_options: dict[str, Any] | None = None,
    e: Edges | None = None,
    ready: Background | None = None,
) -> Charting:
    """Cut one component into charts.

    "auto" takes the charts with the shortest seams among those that pass the gates: no mirrored
    faces, no overlaps, GATE of the area within FLAT_LIMITS. Rings are tried where the component looks
    like a tube, and our own segmentation where rings fail or have long seams; where neither passes,
    the latter is taken, which is flattened without folds whatever it stretches.

    Parameters
    ----------
    V, F : (n, 3) float64, mm, and (m, 3) int64, manifold, one component
    method : str
    seed : int
    zipped : bool, glue the charts of our own segmentation
    xatlas_options : dict, fields of xatlas.ChartOptions
    e : Edges, of F, where the caller has them
    ready : Background, a child that was told to get ready for the search

    Returns
    -------
    Charting

    Raises
    ------
    OptionError
        xatlas has no such option.
    ChartError
        The method does not fit the component, or a face has no area.
    """
    if method == "periodic":
        return Charting(_rings(V, F, seed), "periodic")
    if len(F) > _HEAVY:
        e = edges(F) if e is None else e
        W, G = coarsened(V, F, _MIDDLE, e)
        if len(G) < len(F):
            middle = smoothed(W, G, _PASSES), G
            return _of_heavy(V, F, e, middle, method, seed, zipped, xatlas_options, ready)
    light = proxy(V, F, e=e)
    if method == "single":
        return single_chart(V, F, light, seed)
    if method == "xatlas":
        label = unwrap(*light, seed, xatlas_options)
        return Charting(own_charts(V, F, light, label, "slim", seed=seed, e=e).charts, "xatlas")
    rings, note = _good_rings(V, F, light, seed) if method == "auto" else (None, "")
    if rings is not None and _seams(V, F, rings) <= _FEW_SEAMS:
        return rings
    flattening = "slim" if method == "auto" else method
    if ready is not None:
        ready.result()
    label = segment(*light, seed=seed, conformal=flattening == "lscm")
    own = own_charts(V, F, light, label, flattening, seed=seed, zipped=zip_charts if zipped else None, e=e)
    if rings is not None and _seams(V, F, rings) <= _seams(V, F, own):
        return rings
    return Charting(own.charts, own.method, own.leaf, note)


def _of_heavy(
    V: Floats,
    F: Ints,
    e: Edges,
    middle: tuple[Floats, Ints],
    method: ComponentMethod,
    seed: int,
    zipped: bool,
    xatlas_options: dict[str, Any] | None,
    ready: Background | None,
) -> Charting:
    """Cut a coarser mesh into charts, and carry them over."""
    found = chart_component(
        *middle, method, seed=seed, zipped=zipped, xatlas_options=xatlas_options, ready=ready
    )
    note = found.note
    if found.leaf is None:  # rings, which follow heights of the mesh itself
        rings, note = _good_rings(V, F, middle, seed)
        if rings is not None:
            return rings
        found = chart_component(*middle, "slim", seed=seed, zipped=zipped)
    light_leaf = np.zeros(len(middle[1]), np.int64) if found.leaf is None else found.leaf
    flattening: Method = "lscm" if method == "lscm" else "slim"
    charts, leaf = carry_over(V, F, middle, light_leaf, found.charts, flattening, seed, settles=False, e=e)
    return Charting(charts, found.method, leaf, note)


def _rings(V: Floats, F: Ints, seed: int) -> list[Chart]:
    from meshjig.charts.tubes.periodic import periodic

    return periodic(V, F, seed)


def _good_rings(V: Floats, F: Ints, light: tuple[Floats, Ints], seed: int) -> tuple[Charting | None, str]:
    """Give rings around a component where they pass the gates; else why not."""
    from meshjig.charts.tubes.periodic import suits

    if not suits(*light):
        return None, ""
    try:
        rings = Charting(_rings(V, F, seed), "periodic")
    except ChartError as error:
        return None, f"periodic refused: {error.message}"
    facts = _facts(V, F, rings)
    if facts["flips"] or facts["overlaps"] or facts["gate_share"] < GATE:
        return None, f"periodic refused: {facts['gate_share']:.1%} of the area within the gate"
    return rings, "periodic refused: longer seams"


def _seams(V: Floats, F: Ints, charting: Charting) -> float:
    return float(_facts(V, F, charting)["seam_over_sqrt_area"])


def _facts(V: Floats, F: Ints, charting: Charting) -> dict[str, Any]:
    return quality(lay_out(Mesh(V, F), charting.charts))
