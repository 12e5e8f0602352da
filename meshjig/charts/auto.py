"""The method for a component: the one that was asked for, or the best by measured gates."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Literal

from meshjig.charts.atlas_distortion import AtlasDistortion, atlas_distortion
from meshjig.charts.chart import Chart, Charting, lay_out
from meshjig.charts.flatten.flatten import Method
from meshjig.charts.regularize import smoothed
from meshjig.charts.segment.segment import segment, unwrap
from meshjig.charts.segmented import own_charts, single_chart
from meshjig.charts.transfer.proxy import coarsened, proxy_mesh
from meshjig.charts.transfer.transfer_charts import transfer_charts
from meshjig.charts.zip.zip import zip_charts
from meshjig.errors import ChartError
from meshjig.mesh.mesh import Mesh
from meshjig.runtime.worker import Background

__all__ = ["GATE", "ChartOptions", "ComponentMethod", "chart_component"]

ComponentMethod = Literal["auto", "lscm", "arap", "slim", "xatlas", "single", "periodic"]

GATE = 0.97  # of the area within FLAT_LIMITS
_HEAVY = 300_000  # faces: charts of more are found on a coarser mesh
_MIDDLE = 60_000  # faces of that, at most
_PASSES = 1  # that take away what noise coarsening leaves
_FEW_SEAMS = 3.5  # length over the root of the area: our segmentation hardly ever needs less


@dataclass(frozen=True)
class ChartOptions:
    """How components are cut into charts."""

    method: ComponentMethod = "auto"
    seed: int = 0
    zipped: bool = True  # glue the charts of our own segmentation
    xatlas: Mapping[str, object] | None = None  # fields of xatlas.ChartOptions


def chart_component(mesh: Mesh, options: ChartOptions, ready: Background | None = None) -> Charting:
    """Cut one component into charts.

    "auto" takes the charts with the shortest seams among those that pass the gates: no mirrored
    faces, no overlaps, GATE of the area within FLAT_LIMITS. Rings are tried where the component looks
    like a tube, and our own segmentation where rings fail or have long seams; where neither passes,
    the latter is taken, which is flattened without folds whatever it stretches.

    Parameters
    ----------
    mesh : Mesh, manifold, one component
    options : ChartOptions
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
    method, seed = options.method, options.seed
    if method == "periodic":
        return Charting(_rings(mesh, seed), "periodic")
    if len(mesh.F) > _HEAVY:
        coarse = coarsened(mesh, _MIDDLE)
        if coarse is not mesh:
            return _of_heavy(mesh, smoothed(coarse, _PASSES), options, ready)
    proxy = proxy_mesh(mesh)
    if method == "single":
        return single_chart(mesh, proxy, seed)
    if method == "xatlas":
        label = unwrap(proxy.V, proxy.F, seed, options.xatlas)
        return Charting(own_charts(mesh, proxy, label, "slim", seed).charts, "xatlas")
    rings, note = _good_rings(mesh, proxy, seed) if method == "auto" else (None, "")
    if rings is not None and _seams(mesh, rings) <= _FEW_SEAMS:
        return rings
    flattening: Method = "slim" if method == "auto" else method
    if ready is not None:
        ready.result()
    label = segment(proxy.V, proxy.F, seed=seed, conformal=flattening == "lscm")
    own = own_charts(mesh, proxy, label, flattening, seed, zip_charts if options.zipped else None)
    if rings is not None and _seams(mesh, rings) <= _seams(mesh, own):
        return rings
    return replace(own, note=note)


def _of_heavy(mesh: Mesh, coarse: Mesh, options: ChartOptions, ready: Background | None) -> Charting:
    """Cut a coarser mesh into charts, and transfer them."""
    found = chart_component(coarse, options, ready)
    if found.region is None:  # rings, which follow heights of the mesh itself
        rings, note = _good_rings(mesh, coarse, options.seed)
        if rings is not None:
            return rings
        found = replace(chart_component(coarse, replace(options, method="slim")), note=note)
    flattening: Method = "lscm" if options.method == "lscm" else "slim"
    return transfer_charts(mesh, coarse, found, flattening, options.seed, details=False)


def _rings(mesh: Mesh, seed: int) -> list[Chart]:
    from meshjig.charts.tubes.periodic import periodic

    return periodic(mesh, seed)


def _good_rings(mesh: Mesh, proxy: Mesh, seed: int) -> tuple[Charting | None, str]:
    """Give rings around a component where they pass the gates; else why not."""
    from meshjig.charts.tubes.periodic import is_tubular

    if not is_tubular(proxy):
        return None, ""
    try:
        rings = Charting(_rings(mesh, seed), "periodic")
    except ChartError as error:
        return None, f"periodic refused: {error.message}"
    facts = _measured(mesh, rings)
    if facts.flips or facts.overlaps or facts.gate_share < GATE:
        return None, f"periodic refused: {facts.gate_share:.1%} of the area within the gate"
    return rings, "periodic refused: longer seams"


def _seams(mesh: Mesh, charting: Charting) -> float:
    return _measured(mesh, charting).seam_over_sqrt_area


def _measured(mesh: Mesh, charting: Charting) -> AtlasDistortion:
    return atlas_distortion(lay_out(mesh, charting.charts))
