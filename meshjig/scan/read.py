"""The scan stage in one call: from a file to the mesh that the puzzle is made of."""

from __future__ import annotations

from typing import Any, Literal

import numpy as np

from meshjig.mesh.components import components
from meshjig.mesh.halfedges import border_halfedges, edges
from meshjig.mesh.intersections import self_crossings
from meshjig.mesh.types import Ints, Mesh, Scan
from meshjig.scan.load import load
from meshjig.scan.repair import repair
from meshjig.scan.resolution import decimate
from meshjig.scan.resurface import resurface as rebuild
from meshjig.scan.resurface import resurfacing_cell
from meshjig.scan.scale import to_millimetres

__all__ = ["describe", "read_scan"]


def read_scan(
    source: Any,
    *,
    size: float | None = None,
    faces: int | Literal["all"] = 100_000,
    cavities: bool = False,
    resurface: bool = False,
) -> Scan:
    """Load, repair, scale and simplify a mesh.

    Parameters
    ----------
    source : path, trimesh.Trimesh, trimesh.Scene, or (V (n, 3), F (m, 3))
    size : float, mm, the largest extent; None: see `to_millimetres`
    faces : int or "all", the working resolution
    cavities : bool, whether shells that lie inside a solid stay
    resurface : bool, whether the outer surface is rebuilt, without crossings; see `resurface`

    Returns
    -------
    Scan
        facts is the report's ``input``: ``file``, ``reader``, ``notes`` (what
        of the file was left out, a sentence each), ``faces`` (as loaded), ``components``,
        ``borders`` (open loops), ``genus`` (summed over components), ``self_crossings`` (None: not counted
        here), ``repairs`` (see `repair`), ``scale``, ``size_mm``, ``units``, ``moved_mm``,
        ``working_faces``, ``decimated_from`` (faces before, or None), ``resurfaced`` (see `resurface`; None
        when it was not asked for).

    Raises
    ------
    InputError
        The mesh can't be read, or is no surface; the sentence says why.
    """
    loaded = load(source)
    V, F, repairs = repair(loaded.V, loaded.F, cavities=cavities)
    scaled = to_millimetres(V, size)
    V, resurfaced = scaled.V, None
    if resurface:
        V, F, resurfaced = rebuild(V, F, resurfacing_cell(V, F, faces), cavities=cavities)
    n_clean = len(F)
    if faces != "all":
        V, F = decimate(V, F, faces)
    facts = {
        **loaded.facts,
        "faces": len(loaded.F),
        **_topology(F),
        "self_crossings": None,
        "repairs": repairs,
        **scaled.facts,
        "working_faces": len(F),
        "decimated_from": n_clean if len(F) < n_clean else None,
        "resurfaced": resurfaced,
    }
    return Scan(
        Mesh(np.ascontiguousarray(V), np.ascontiguousarray(F)), loaded.source, scaled.to_source, facts
    )


def describe(
    source: Any, *, size: float | None = None, faces: int | Literal["all"] = 100_000, cavities: bool = False
) -> dict[str, Any]:
    """Say what a mesh is and what would be done to it, without making a puzzle.

    Parameters
    ----------
    source, size, faces, cavities
        As for `read_scan`.

    Returns
    -------
    dict
        The facts of `read_scan`, with ``self_crossings`` counted on the working mesh (None when the test
        failed).

    Raises
    ------
    InputError
        As `read_scan`.
    """
    scan = read_scan(source, size=size, faces=faces, cavities=cavities)
    pairs = self_crossings(scan.mesh.V, scan.mesh.F)
    return {**scan.facts, "self_crossings": None if pairs is None else len(pairs)}


def _topology(F: Ints) -> dict[str, int]:
    """Count components, border loops and handles of a manifold mesh."""
    n, _ = components(F)
    euler = int(F.max()) + 1 - len(edges(F).E) + len(F)
    borders = _loops(F)
    return {"components": n, "borders": borders, "genus": (2 * n - euler - borders) // 2}


def _loops(F: Ints) -> int:
    """Count border loops: one fan a vertex makes every border vertex part of one loop."""
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components

    h = border_halfedges(F)
    if not len(h):
        return 0
    a, b = F.ravel()[h], F[h // 3, (h + 1) % 3]
    vertices, number = np.unique(np.concatenate([a, b]), return_inverse=True)
    a, b = number[: len(h)], number[len(h) :]
    graph = coo_matrix((np.ones(len(h), np.int8), (a, b)), shape=(len(vertices), len(vertices)))
    return int(connected_components(graph, directed=False)[0])
