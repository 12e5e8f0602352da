"""Cut a mesh into flat charts: the stage as a whole."""

import logging
from typing import Any, Literal, get_args

import numpy as np

from meshjig.charts.arrange import lay_out
from meshjig.charts.atlas_distortion import quality, seam_over_sqrt_area
from meshjig.charts.auto import GATE, chart_component
from meshjig.charts.chart import Chart, Charting
from meshjig.charts.mapped import MappedAtlas
from meshjig.charts.regularize import steady
from meshjig.charts.segment.segment import WORTH_A_CHILD, get_ready
from meshjig.charts.unwrap import chart_options
from meshjig.errors import ChartError, OptionError
from meshjig.mesh.halfedges import compact, edges
from meshjig.mesh.types import Atlas, Floats, Ints, Mesh
from meshjig.runtime.worker import Background

__all__ = ["AtlasMethod", "build_atlas"]

AtlasMethod = Literal["auto", "lscm", "arap", "slim", "xatlas", "single", "periodic", "uv"]


def build_atlas(
    mesh: Mesh,
    *,
    method: AtlasMethod = "auto",
    seed: int = 0,
    margin: float = 5.0,
    zipped: bool = True,
    xatlas_options: dict[str, Any] | None = None,
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
    source : trimesh.Trimesh, the mesh as it was loaded, for "uv"
    to_source : (4, 4) float64, takes coordinates of the mesh to those of source; for "uv"
    log : logging.Logger, hears what was done

    Returns
    -------
    MappedAtlas
        Every chart is a disc, cut inside or not, or a ring cut open; no face is mirrored, and the mean
        stretch of each chart is 1. Its facts are those of quality(), and method, reason (a sentence),
        n_charts_before_zip, seam_before_zip (as seam_over_sqrt_area) and zipped (seams that were glued).

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
    e = edges(mesh.F)
    if not len(mesh.F) or e.n_faces.max() > 2:
        raise ChartError("the mesh is empty or not manifold", hint="repair it first")
    V = mesh.V
    parts: list[tuple[Ints, Charting]] = []  # faces, and how they were charted
    if method == "uv":
        from meshjig.charts.file_uv.file_uv import own_uv

        brought = own_uv(mesh, source, np.eye(4) if to_source is None else to_source)
        parts = [(np.arange(len(mesh.F)), Charting(brought, "uv"))]
    else:
        searches = method in ("auto", "lscm", "arap", "slim") and len(mesh.F) >= WORTH_A_CHILD
        ready = Background(get_ready) if searches else None
        V = steady(mesh.V, mesh.F, seed, e)
        n, component = _components(e.twin)
        for c in range(n):
            faces = np.flatnonzero(component == c)
            F, kept = compact(mesh.F[faces])
            known = e if len(faces) == len(mesh.F) and len(kept) == len(V) else None
            made = chart_component(
                V[kept],
                F,
                method,
                seed=seed,
                zipped=zipped,
                xatlas_options=xatlas_options,
                e=known,
                ready=ready,
            )
            parts.append((faces, made))
    atlas = lay_out(mesh, [_shifted(chart, faces) for faces, made in parts for chart in made.charts], margin)
    facts = _facts(atlas, parts, V, e.twin)
    if log is not None:
        log.info("charts: %s", facts["reason"])
    return MappedAtlas(mesh, atlas.uv, atlas.F_uv, atlas.chart_of_face, facts, atlas.period)


def _components(twin: Ints) -> tuple[int, Ints]:
    """Number the faces (m,) that hang together, by the twins of their half-edges."""
    from scipy.sparse import csr_matrix
    from scipy.sparse.csgraph import connected_components

    m = len(twin) // 3
    around = csr_matrix((np.ones(3 * m, np.int8), twin // 3, np.arange(0, 3 * m + 1, 3)), shape=(m, m))
    n, part = connected_components(around, directed=False)
    return int(n), part.astype(np.int64)


def _shifted(chart: Chart, faces: Ints) -> Chart:
    """Let a chart of some faces be one of the whole mesh."""
    return Chart(faces[chart.faces], chart.uv, chart.corners, chart.period)


def _facts(atlas: Atlas, parts: list[tuple[Ints, Charting]], smoothed: Floats, twin: Ints) -> dict[str, Any]:
    """Measure an atlas, and say how it came about."""
    F, facts = atlas.mesh.F, quality(atlas, smoothed, twin)
    before = atlas.chart_of_face.copy()
    for faces, made in parts:
        if made.leaf is not None:
            before[faces] = made.leaf + before.max() + 1
    n_before = int((np.bincount(before) > 0).sum())
    seam = np.repeat(before, 3) != np.repeat(before, 3)[twin]
    largest_first = sorted(parts, key=lambda part: -len(part[0]))
    facts["method"] = "+".join(dict.fromkeys(made.method for _, made in largest_first))
    facts["n_charts_before_zip"] = n_before
    facts["seam_before_zip"] = seam_over_sqrt_area(atlas.mesh.V, F, seam, twin)
    facts["zipped"] = max(n_before - facts["n_charts"], 0)
    facts["reason"] = _reason(facts, [made.note for _, made in largest_first])
    return facts


def _reason(facts: dict[str, Any], notes: list[str]) -> str:
    """Say in one sentence what was taken, how good it is, and what was not taken."""
    n, share = facts["n_charts"], facts["gate_share"]
    glued = f" glued from {facts['n_charts_before_zip']}" if facts["zipped"] else ""
    short = "" if share >= GATE else f", short of {GATE:.0%}"
    said = (
        f"{facts['method']}: {n} chart{'s' * (n > 1)}{glued}, {share:.1%} of the area within the gate{short}"
    )
    return "; ".join(dict.fromkeys([said, *filter(None, notes)]))
