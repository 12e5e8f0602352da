"""Cut a mesh into flat charts: the stage as a whole."""

from __future__ import annotations

import logging
from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields, replace
from typing import Any, Literal, get_args

import numpy as np

from meshjig.charts.atlas_distortion import AtlasDistortion, atlas_distortion, seam_over_sqrt_area
from meshjig.charts.auto import GATE, ChartOptions, chart_component
from meshjig.charts.chart import Chart, Charting, lay_out
from meshjig.charts.cuts import TrimmingCurve, trimming_curves
from meshjig.charts.lift import curve, lift
from meshjig.charts.regularize import regularize
from meshjig.charts.segment.segment import chart_options, get_ready
from meshjig.errors import ChartError, OptionError
from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.halfedges import compact
from meshjig.mesh.types import Atlas, Mesh
from meshjig.runtime.thresholds import CHARTS_WORTH_A_CHILD
from meshjig.runtime.worker import Background

__all__ = ["AtlasMethod", "ChartFacts", "MappedAtlas", "build_atlas"]


@dataclass(frozen=True)
class MappedAtlas(Atlas):
    """An atlas with the point-wise map of its charts."""

    def lift(self, chart: int, uv: Floats) -> tuple[Ints, Floats, Floats]:
        """Map points of the plane to the surface, as `meshjig.charts.lift` does."""
        return lift(self, chart, uv)

    def curve(self, chart: int, polyline: Floats) -> list[Floats]:
        """Map a polyline of the plane to the surface, as `meshjig.charts.curve` does."""
        return curve(self, chart, polyline)

    def trimming_curves(self) -> list[TrimmingCurve]:
        """The charts' borders with their mates, as `meshjig.charts.trimming_curves` does."""
        return trimming_curves(self)


AtlasMethod = Literal["auto", "lscm", "arap", "slim", "xatlas", "single", "periodic", "uv"]


@dataclass(frozen=True)
class ChartFacts(AtlasDistortion):
    """How good the charts of an atlas are, and how they came about: the report's "charts"."""

    method: str  # those of all components, joined by +
    n_charts_before_zip: int
    seam_before_zip: float  # as seam_over_sqrt_area
    zipped: int  # seams that were glued
    reason: str = ""  # a sentence


def build_atlas(
    mesh: Mesh,
    *,
    method: AtlasMethod = "auto",
    seed: int = 0,
    margin: float = 5.0,
    zipped: bool = True,
    xatlas_options: Mapping[str, object] | None = None,
    source: Any = None,
    to_source: Floats | None = None,
    log: logging.Logger | None = None,
) -> MappedAtlas:
    """Cut a mesh into few, large, nearly flat charts and lay them out in one plane.

    Parameters
    ----------
    mesh : Mesh
        Any genus, open or closed, any number of components.
    method : str
        "lscm", "arap" and "slim" flatten the charts of our own segmentation. "xatlas" lets xatlas choose
        the charts. "single" makes one chart of each component, "periodic" rings around it; "uv" takes
        what the file brought along. "auto" chooses for each component by measured gates.
    seed : int
    margin : float, mm, between the charts in the plane
    zipped : bool
        Glue the charts of our own segmentation along their seams for as long as they stay good.
    xatlas_options : dict, fields of xatlas.ChartOptions, for "xatlas"
    source : the mesh as it was loaded, with vertices, faces and look.uv, for "uv"
    to_source : (4, 4) float64, takes coordinates of the mesh to those of source; for "uv"
    log : logging.Logger, hears what was done

    Returns
    -------
    MappedAtlas
        Every chart is a disc, cut inside or not, or a ring cut open; no face is mirrored, and the mean
        stretch of each chart is 1. Its facts are the fields of ChartFacts.

    Raises
    ------
    OptionError
        The method or an option of xatlas is unknown, or the source is missing.
    ChartError
        The mesh is not manifold, has faces that can't be flattened, or does not suit the method.
    """
    if method not in get_args(AtlasMethod):
        raise OptionError(
            f"charts: unknown method {method!r}", hint="use " + ", ".join(get_args(AtlasMethod))
        )
    if method == "uv" and source is None:
        raise OptionError("charts: uv needs the mesh as it was loaded", hint="give it as source")
    chart_options(xatlas_options or {})
    if not len(mesh.F) or mesh.edges.n_faces.max() > 2:
        raise ChartError("the mesh is empty or not manifold", hint="repair it first")
    smooth = mesh
    parts: list[tuple[Ints, Charting]] = []  # faces, and how they were charted
    if method == "uv":
        from meshjig.charts.file_uv import file_uv

        brought = file_uv(mesh, source, np.eye(4) if to_source is None else to_source)
        parts = [(np.arange(len(mesh.F)), Charting(brought, "uv"))]
    else:
        searches = method in ("auto", "lscm", "arap", "slim") and len(mesh.F) >= CHARTS_WORTH_A_CHILD
        ready = Background(get_ready) if searches else None
        smooth = regularize(mesh, seed)
        options = ChartOptions(method, seed, zipped, xatlas_options)
        for c in range(mesh.n_components):
            faces = np.flatnonzero(mesh.component_of_face == c)
            F, kept = compact(mesh.F[faces])
            whole = len(faces) == len(mesh.F) and len(kept) == len(mesh.V)
            part = smooth if whole else Mesh(smooth.V[kept], F)
            parts.append((faces, chart_component(part, options, ready)))
    atlas = lay_out(mesh, [_shifted(chart, faces) for faces, made in parts for chart in made.charts], margin)
    facts = _facts(atlas, parts, smooth.V)
    if log is not None:
        log.info("charts: %s", facts.reason)
    return MappedAtlas(mesh, atlas.uv, atlas.F_uv, atlas.chart_of_face, asdict(facts), atlas.period)


def _shifted(chart: Chart, faces: Ints) -> Chart:
    """Let a chart of some faces be one of the whole mesh."""
    return Chart(faces[chart.faces], chart.uv, chart.corners, chart.period)


def _facts(atlas: Atlas, parts: list[tuple[Ints, Charting]], smoothed: Floats) -> ChartFacts:
    """Measure an atlas, and say how it came about."""
    found = atlas_distortion(atlas, smoothed)
    before = atlas.chart_of_face.copy()
    for faces, made in parts:
        if made.region is not None:
            before[faces] = made.region + before.max() + 1
    n_before = int((np.bincount(before) > 0).sum())
    seam = np.repeat(before, 3) != np.repeat(before, 3)[atlas.mesh.edges.twin]
    largest_first = sorted(parts, key=lambda part: -len(part[0]))
    facts = ChartFacts(
        **{field.name: getattr(found, field.name) for field in fields(found)},
        method="+".join(dict.fromkeys(made.method for _, made in largest_first)),
        n_charts_before_zip=n_before,
        seam_before_zip=seam_over_sqrt_area(atlas.mesh, seam),
        zipped=max(n_before - found.n_charts, 0),
    )
    return replace(facts, reason=_reason(facts, [made.note for _, made in largest_first]))


def _reason(facts: ChartFacts, notes: list[str]) -> str:
    """Say in one sentence what was taken, how good it is, and what was not taken."""
    n, share = facts.n_charts, facts.gate_share
    glued = f" glued from {facts.n_charts_before_zip}" if facts.zipped else ""
    short = "" if share >= GATE else f", short of {GATE:.0%}"
    said = f"{facts.method}: {n} chart{'s' * (n > 1)}{glued}, {share:.1%} of the area within the gate{short}"
    return "; ".join(dict.fromkeys([said, *filter(None, notes)]))
