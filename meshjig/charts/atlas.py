"""Cut a mesh into flat charts: the stage as a whole."""

import logging
from collections.abc import Callable
from typing import Any, Literal, get_args

import numpy as np
from numpy.typing import NDArray

from meshjig.charts.flatten import Method, border_is_simple, flatten, is_unflipped, unit_stretch
from meshjig.charts.layout import lie_along, shelves
from meshjig.charts.mapped import MappedAtlas
from meshjig.charts.part import part
from meshjig.charts.proxy import proxy
from meshjig.charts.quality import quality
from meshjig.charts.rescue import rescue
from meshjig.charts.segment import segment
from meshjig.charts.steady import steady
from meshjig.charts.transfer import transfer_labels, transfer_uv
from meshjig.charts.untangle import untangle
from meshjig.charts.unwrap import unwrap
from meshjig.errors import ChartError, OptionError
from meshjig.topology import compact, components, edges, is_disc
from meshjig.types import Atlas, Mesh

__all__ = ["AtlasMethod", "build_atlas"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Chart = tuple[Ints, Floats]  # faces; uv of the vertices that compact(F[faces]) keeps
AtlasMethod = Literal["auto", "lscm", "arap", "slim", "xatlas"]


def build_atlas(
    mesh: Mesh,
    *,
    method: AtlasMethod = "auto",
    seed: int = 0,
    margin: float = 5.0,
    log: logging.Logger | None = None,
) -> MappedAtlas:
    """Cut a mesh into few, large, nearly flat charts and lay them out in one plane.

    Parameters
    ----------
    mesh : Mesh
        Any genus, open or closed, any number of components.
    method : str
        How charts are flattened; "auto" is SLIM. With "xatlas", xatlas also chooses the charts.
    seed : int
    margin : float, mm, between the charts in the plane
    log : logging.Logger, hears what was done

    Returns
    -------
    MappedAtlas
        Every chart is a disc, no face is mirrored, and the mean stretch of each chart is 1. Its
        facts are those of quality(), and the method.

    Raises
    ------
    OptionError
        The method is unknown.
    ChartError
        The mesh is not manifold, or has faces that can't be flattened.
    """
    if method not in get_args(AtlasMethod):
        raise OptionError(
            f"charts: unknown method {method!r}", hint="use " + ", ".join(get_args(AtlasMethod))
        )
    if not len(mesh.F) or edges(mesh.F).n_faces.max() > 2:
        raise ChartError("the mesh is empty or not manifold", hint="repair it first")
    flattening: Method = "slim" if method == "auto" or method == "xatlas" else method
    chooser = unwrap if method == "xatlas" else segment
    charts: list[Chart] = []
    V = steady(mesh.V, mesh.F, seed)
    n, component = components(mesh.F)
    for c in range(n):
        faces = np.flatnonzero(component == c)
        G, kept = compact(mesh.F[faces])
        charts += [(faces[own], uv) for own, uv in _charts(V[kept], G, flattening, seed, chooser)]
    atlas = _lay_out(mesh, charts, margin)
    facts: dict[str, Any] = {**quality(atlas), "method": "xatlas" if method == "xatlas" else flattening}
    if log is not None:
        log.info("charts: %s", facts)
    return MappedAtlas(mesh, atlas.uv, atlas.F_uv, atlas.chart_of_face, facts)


def _charts(V: Floats, F: Ints, method: Method, seed: int, choose: Callable[..., Ints]) -> list[Chart]:
    """Cut and flatten one component."""
    W, G = proxy(V, F)
    of_light = choose(W, G, seed=seed)
    of_face = of_light if G is F else transfer_labels(V, F, W, G, of_light)
    charts: list[Chart] = []
    for label in range(int(of_light.max()) + 1):
        faces = np.flatnonzero(of_face == label)
        if not len(faces):
            continue
        uv = _carried(V, F[faces], W, G[of_light == label], method) if G is not F else None
        charts += [(faces, uv)] if uv is not None else rescue(V, F, faces, method, seed)
    return charts


def _carried(V: Floats, F: Ints, W: Floats, G: Ints, method: Method) -> Floats | None:
    """Flatten a chart by way of its proxy; None where that makes no sound chart."""
    if not is_disc(F):
        return None
    (F, kept), (G, light) = compact(F), compact(G)
    V, W = V[kept], W[light]
    try:
        uv = part(V, F, untangle(V, F, transfer_uv(V, W, G, flatten(W, G, method))))
    except ChartError:
        return None
    return unit_stretch(V, F, uv) if is_unflipped(uv, F) and border_is_simple(uv, F) else None


def _lay_out(mesh: Mesh, charts: list[Chart], margin: float) -> Atlas:
    """Number the charts, the largest first, and place them in one plane."""
    charts = sorted(charts, key=lambda chart: -len(chart[0]))
    plans = [lie_along(uv) for _, uv in charts]
    corners = shelves(np.array([uv.max(0) for uv in plans]), margin)
    F_uv = np.empty_like(mesh.F)
    chart_of_face = np.empty(len(mesh.F), np.int64)
    start = 0
    for number, (faces, uv) in enumerate(charts):
        F_uv[faces] = compact(mesh.F[faces])[0] + start
        chart_of_face[faces] = number
        start += len(uv)
    placed = np.concatenate([uv + corner for uv, corner in zip(plans, corners, strict=True)])
    return Atlas(mesh, placed, F_uv, chart_of_face)
