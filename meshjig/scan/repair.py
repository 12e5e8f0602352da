"""Turn whatever triangles were loaded into clean, oriented surfaces, and count every change."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from meshjig.errors import InputError
from meshjig.mesh.components import components
from meshjig.mesh.halfedges import compact
from meshjig.mesh.measure import face_areas
from meshjig.mesh.types import Floats, Ints
from meshjig.scan.manifold import is_clean, make_manifold
from meshjig.scan.orient import make_coherent, turn_outward
from meshjig.scan.weld import drop_doubles, flip_flat, weld

__all__ = ["Repaired", "repair"]

_WELD = 1e-7  # of the diagonal; float32 files are this exact
_FLAT = 1e-7  # of the diagonal: height under which a face counts as flat
_CRUMB = 1e-3  # of the area: components below it are dropped


class Repaired(NamedTuple):
    """A clean mesh and what was done for it."""

    V: Floats  # (n, 3)
    F: Ints  # (m, 3)
    changes: dict[str, Any]


def repair(V: Floats, F: Ints, *, cavities: bool = False) -> Repaired:
    """Make a mesh that every later stage can rely on.

    Every edge has one or two faces, every vertex one fan, neighbours agree on their side, closed
    components face outward, and no vertex is unused. Shape is kept: nothing is filled or smoothed.

    Parameters
    ----------
    V : (n, 3) float64
    F : (m, 3) int64
    cavities : bool, whether shells that lie inside a solid stay

    Returns
    -------
    Repaired
        changes counts, all int but the last: ``merged_vertices``, ``null_faces`` (two corners in one
        place), ``flat_faces`` (no area; flipped away), ``duplicate_faces``, ``non_manifold_edges``,
        ``non_manifold_vertices``, ``reoriented`` (faces), ``turned_inside_out`` (components),
        ``dropped_components`` and ``dropped_area_share`` (crumbs under 1/1000 of the area), ``cavities``
        (shells inside a solid), ``unused_vertices``.

    Raises
    ------
    InputError
        No faces are left, the mesh is a heap of loose crumbs, or the surface has one side only.
    """
    n = len(V)
    diagonal = float(np.linalg.norm(np.ptp(V[F].reshape(-1, 3), axis=0)))
    V, F = _used(V, F)
    changes: dict[str, Any] = {"unused_vertices": n - len(V)}
    V, F, changes["merged_vertices"] = weld(V, F, _WELD * diagonal)
    F, changes["null_faces"], changes["duplicate_faces"] = drop_doubles(F)
    F, changes["flat_faces"] = flip_flat(V, F, _FLAT * diagonal)
    changes |= {"reoriented": 0, "non_manifold_edges": 0, "non_manifold_vertices": 0}
    V, F = _used(V, F)
    clean = is_clean(F, len(V))
    if not clean:
        F, changes["reoriented"] = make_coherent(F, strict=False)
        V, F, changes["non_manifold_edges"], changes["non_manifold_vertices"] = make_manifold(V, F)
    V, F, dropped = _without_crumbs(V, F)
    changes |= dropped
    if not clean:
        F, turned = make_coherent(F)
        changes["reoriented"] += turned
    sides = turn_outward(V, F)
    F, changes["turned_inside_out"] = sides.F, sides.turned
    changes["cavities"] = components(F[sides.cavity])[0] if sides.cavity.any() else 0
    if not cavities and sides.cavity.any():
        V, F = _used(V, F[~sides.cavity])
    if not (clean or is_clean(F, len(V))):
        raise InputError(
            "the mesh is still no clean surface after repair",
            hint="repair it in a mesh editor, such as MeshLab",
        )
    return Repaired(V, F, changes)


def _used(V: Floats, F: Ints) -> tuple[Floats, Ints]:
    """Give the mesh without unused vertices."""
    if not len(F):
        raise InputError("no faces are left after repair: all were points, lines or doubles")
    F, kept = compact(F)
    return V[kept], F


def _without_crumbs(V: Floats, F: Ints) -> tuple[Floats, Ints, dict[str, Any]]:
    """Give the mesh without components that are too small to matter."""
    n, component = components(F)
    area = np.bincount(component, face_areas(V, F), n)
    total = float(area.sum())
    crumb = area < _CRUMB * total
    share = float(area[crumb].sum()) / total if total else 0.0
    facts = {"dropped_components": int(crumb.sum()), "dropped_area_share": share}
    if not crumb.any():
        return V, F, facts
    if share > 0.5:
        raise InputError(
            f"the mesh is a heap of {n} loose parts, most of them under a thousandth of its area",
            hint="join them to one surface in a mesh editor, such as MeshLab",
        )
    return *_used(V, F[~crumb[component]]), facts
