"""Divide a mesh into few, large, nearly flat discs, by a search of our own or by xatlas."""

import importlib
from collections.abc import Mapping
from typing import Any

import numpy as np

from meshjig.charts.segment.accept import Acceptance
from meshjig.charts.segment.clean_labels import clean_labels, smooth
from meshjig.charts.segment.dual_graph import DualGraph, dual_graph, patches
from meshjig.charts.segment.merge import absorb, merge, polish
from meshjig.charts.segment.region import without_necks
from meshjig.charts.segment.split import split
from meshjig.errors import OptionError
from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.components import components, is_disc
from meshjig.mesh.mesh import Mesh
from meshjig.runtime.thresholds import CHARTS_WORTH_A_CHILD
from meshjig.runtime.worker import Background

__all__ = ["chart_options", "get_ready", "segment", "unwrap"]


def segment(
    V: Floats, F: Ints, n_patches: int = 90, seed: int = 0, rounds: int = 1, conformal: bool = False
) -> Ints:
    """Label each face of one component with its chart.

    Patches are merged to charts, twice from other patches, side by side; the better division is taken.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, manifold, one component
    n_patches : int, how many patches the charts are merged from
    seed : int
    rounds : int, of smoothing borders and merging again
    conformal : bool, whether charts will be flattened with their angles kept, which takes more of them

    Returns
    -------
    chart_of_face : (m,) int64, 0 to k - 1; every chart is one that Acceptance accepts, or a single face
    """
    acceptance = Acceptance(V, F, conformal=conformal)
    if acceptance.accepts(np.arange(len(F))):
        return np.zeros(len(F), np.int64)
    mesh, graph = Mesh(V, F), dual_graph(V, F)
    other = Background(
        _searched, V, F, n_patches, seed + 1, rounds, conformal, alone=len(F) < CHARTS_WORTH_A_CHILD
    )
    try:
        found = _search(mesh, graph, acceptance, n_patches, seed, rounds), other.result()
    except BaseException:
        other.cancel()
        raise
    return polish(mesh, graph, min(found, key=lambda label: _cost(graph, label)), acceptance)


def get_ready() -> None:
    """Import what a search needs: in a child, while the mesh is still made coarser."""
    for name in ("igl", "shapely", "scipy.sparse.csgraph", "scipy.sparse.linalg"):
        importlib.import_module(name)


def _searched(V: Floats, F: Ints, n_patches: int, seed: int, rounds: int, conformal: bool) -> Ints:
    mesh, acceptance = Mesh(V, F), Acceptance(V, F, conformal=conformal)
    return _search(mesh, dual_graph(V, F), acceptance, n_patches, seed, rounds)


def _search(
    mesh: Mesh, graph: DualGraph, acceptance: Acceptance, n_patches: int, seed: int, rounds: int
) -> Ints:
    """Merge patches to charts, then smooth and merge again for as long as that helps."""
    label = merge(graph, split(mesh, patches(graph, n_patches, seed), acceptance.accepts, seed), acceptance)
    for _ in range(rounds):
        straight = without_necks(mesh, clean_labels(mesh, smooth(graph, label), graph.area), graph.area)
        smoother = merge(graph, split(mesh, straight, acceptance.accepts, seed), acceptance)
        if smoother.max() > label.max():
            break
        label = absorb(mesh, graph, smoother, acceptance, seed)
    return label


def _cost(graph: DualGraph, label: Ints) -> float:
    """Weigh charts against the length of their seams, in roots of the area."""
    seam = graph.length[label[graph.first] != label[graph.second]].sum()
    return float(label.max() + seam / np.sqrt(graph.area.sum()))


def unwrap(V: Floats, F: Ints, seed: int = 0, options: Mapping[str, object] | None = None) -> Ints:
    """Label each face with its xatlas chart.

    Only the division into charts is kept: xatlas mirrors many charts, and packs them for textures.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, manifold; xatlas is slow beyond some thousand faces
    seed : int
    options : dict, fields of xatlas.ChartOptions

    Returns
    -------
    chart_of_face : (m,) int64, 0 to k - 1; every chart is a disc

    Raises
    ------
    OptionError
        xatlas has no such option, or does not take the value.
    """
    import xatlas

    atlas = xatlas.Atlas()
    atlas.add_mesh(V.astype(np.float32), F.astype(np.uint32))
    packing = xatlas.PackOptions()
    packing.resolution = 256
    atlas.generate(chart_options=chart_options(options or {}), pack_options=packing)
    _, corners, _ = atlas[0]
    _, label = components(corners.astype(np.int64))
    return split(Mesh(V, F), label, lambda faces: is_disc(F[faces]), seed)


def chart_options(given: Mapping[str, object]) -> Any:
    """Make an xatlas.ChartOptions of keywords.

    Raises
    ------
    OptionError
        A name is unknown, or xatlas does not take the value.
    """
    import xatlas

    options = xatlas.ChartOptions()
    known = [name for name in dir(options) if not name.startswith("_") and name != "use_input_mesh_uvs"]
    for name, value in given.items():
        if name not in known:
            raise OptionError(
                f"xatlas-options: unknown name {name!r}", hint=f"xatlas knows {', '.join(known)}"
            )
        try:
            setattr(options, name, value)
        except TypeError:
            wanted = type(getattr(options, name)).__name__
            raise OptionError(f"xatlas-options: {name} can't be {value!r}", hint=f"give a {wanted}") from None
    return options
