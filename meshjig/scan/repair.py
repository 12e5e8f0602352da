"""Turn whatever triangles were loaded into clean, oriented surfaces, and count every change."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from meshjig.errors import InputError
from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.components import components
from meshjig.mesh.halfedges import compact
from meshjig.mesh.mesh import Mesh
from meshjig.scan.hanging import join_hanging
from meshjig.scan.loss import loss
from meshjig.scan.manifold import is_clean, make_manifold
from meshjig.scan.orient import make_coherent, turn_outward
from meshjig.scan.walls import double_walls
from meshjig.scan.weld import drop_doubles, flip_flat, weld

__all__ = ["Repaired", "Repairs", "loss", "repair"]

_WELD = 1e-7  # of the diagonal; float32 files are this exact
_HANGING = 1e-6  # of the diagonal; a text file with six digits is this exact
_FLAT = 1e-7  # of the diagonal: height under which a face counts as flat
_CRUMB = 1e-3  # of the area: components below it are dropped


@dataclass(frozen=True)
class Repairs:
    """How often repair changed what: the report's ``repairs``."""

    unused_vertices: int
    merged_vertices: int
    null_faces: int  # two corners in one place
    duplicate_faces: int
    flat_faces: int  # no area; flipped away
    hanging_vertices: int  # lay on an edge of the face across, which was split there
    shared_walls: int  # faces inside, between two bodies; each body has its own now
    reoriented: int  # faces
    non_manifold_edges: int
    non_manifold_vertices: int
    dropped_components: int  # crumbs under 1/1000 of the area
    dropped_area_share: float
    turned_inside_out: int  # components
    cavities: int  # shells inside a solid
    lost_faces_share: float  # of the faces as read
    lost_area_share: float


class Repaired(NamedTuple):
    """A clean mesh and what was done for it."""

    V: Floats  # (n, 3)
    F: Ints  # (m, 3)
    changes: Repairs


def repair(V: Floats, F: Ints, *, cavities: bool = False) -> Repaired:
    """Make a mesh that every later stage can rely on.

    Every edge has one or two faces, every vertex one fan, neighbours agree on their side, closed
    components face outward, and no vertex is unused. Where bodies share a wall, each is closed by its own.
    Shape is kept: nothing is filled or smoothed.

    Parameters
    ----------
    V : (n, 3) float64
    F : (m, 3) int64
    cavities : bool, whether shells that lie inside a solid stay

    Returns
    -------
    Repaired

    Raises
    ------
    InputError
        No faces are left, the mesh is a heap of loose crumbs, or the surface has one side only.
    """
    n_given, given = len(V), (V, F)
    V, F = _used(V, F)
    diagonal = float(np.linalg.norm(np.ptp(V, axis=0)))
    unused = n_given - len(V)
    V, F, merged = weld(V, F, _WELD * diagonal)
    F, null, duplicate = drop_doubles(F)
    F, flat = flip_flat(V, F, _FLAT * diagonal)
    V, F = _used(V, F)
    mesh = Mesh(V, F)
    F, hanging = join_hanging(V, F, _HANGING * diagonal, mesh.edges)
    mesh = Mesh(V, F) if hanging else mesh
    clean = is_clean(F, len(V), mesh.edges)
    turned = crowded_edges = split_vertices = walls = 0
    if not clean:
        F, turned = make_coherent(F, strict=False)
        F, walls, turned_walls = double_walls(V, F)
        turned += turned_walls
        V, F, crowded_edges, split_vertices = make_manifold(V, F)
        mesh = Mesh(V, F)
    crumb, n_crumbs, share = _crumbs(mesh)
    if n_crumbs:
        V, F = _used(V, F[~crumb])
        mesh = Mesh(V, F)
    if not clean:
        F, turned_again = make_coherent(F)
        turned += turned_again
        mesh = Mesh(V, F)
    sides = turn_outward(mesh)
    F, cavity = sides.F, sides.cavity
    n_cavities = components(F[cavity])[0] if cavity.any() else 0
    if not cavities and cavity.any():
        V, F = _used(V, F[~cavity])
    if not (clean or is_clean(F, len(V))):
        raise InputError(
            "the mesh is still no clean surface after repair",
            hint="repair it in a mesh editor, such as MeshLab",
        )
    lost = loss(given, (V, F))
    changes = Repairs(
        unused_vertices=unused,
        merged_vertices=merged,
        null_faces=null,
        duplicate_faces=duplicate,
        flat_faces=flat,
        hanging_vertices=hanging,
        shared_walls=walls,
        reoriented=turned,
        non_manifold_edges=crowded_edges,
        non_manifold_vertices=split_vertices,
        dropped_components=n_crumbs,
        dropped_area_share=share,
        turned_inside_out=sides.turned,
        cavities=n_cavities,
        lost_faces_share=lost.faces,
        lost_area_share=lost.area,
    )
    return Repaired(V, F, changes)


def _used(V: Floats, F: Ints) -> tuple[Floats, Ints]:
    """The mesh without unused vertices."""
    if not len(F):
        raise InputError("no faces are left after repair: all were points, lines or doubles")
    F, kept = compact(F)
    return V[kept], F


def _crumbs(mesh: Mesh) -> tuple[Bools, int, float]:
    """Tell which faces are in components too small to matter, how many these are, and their share of area."""
    n, component = mesh.n_components, mesh.component_of_face
    area = np.bincount(component, mesh.areas, n)
    total = float(area.sum())
    crumb = area < _CRUMB * total
    share = float(area[crumb].sum()) / total if total else 0.0
    if share > 0.5:
        raise InputError(
            f"the mesh is a heap of {n} loose parts, most of them under a thousandth of its area",
            hint="join them to one surface in a mesh editor, such as MeshLab",
        )
    return crumb[component], int(crumb.sum()), share
