"""Cells taken apart, for all of them to be flattened at once."""

from typing import NamedTuple

import numpy as np

from meshjig.mesh.chains import cycles
from meshjig.mesh.halfedges import border_halfedges, compact, next_halfedge
from meshjig.mesh.measure import area_vectors, face_areas, sums, unit
from meshjig.mesh.types import Bools, Floats, Ints, Mesh

__all__ = ["CellPatches", "folded", "mirrored", "patches", "projected", "rims", "scaled", "simple", "subset"]

_SLIVER = 0.01  # mm; faces of less height hardly matter


class CellPatches(NamedTuple):
    """All cells side by side, as one mesh in which they share no vertex."""

    V: Floats  # (k, 3), mm
    F: Ints  # (m, 3), the faces in their order
    cell: Ints  # (m,), of a face
    of_vertex: Ints  # (k,), the cell of a vertex
    n: int  # cells
    area: Floats  # (m,), of a face in space, mm2


def patches(mesh: Mesh, cell: Ints) -> CellPatches:
    """Take cells apart: a vertex on a border has a copy for each cell."""
    V, F = mesh
    n = int(cell.max(initial=-1)) + 1
    key = np.repeat(cell, 3) * np.int64(len(V)) + F.ravel()
    found, corner = np.unique(key, return_inverse=True)
    return CellPatches(V[found % len(V)], corner.reshape(-1, 3), cell, found // len(V), n, mesh.areas)


def projected(p: CellPatches) -> Floats:
    """Look at every cell along its mean normal, (k, 2)."""
    total = np.stack([sums(p.cell, x, p.n) for x in area_vectors(p.V, p.F).T], 1)
    normal = unit(total + 1e-12)
    across = np.eye(3)[np.abs(normal).argmin(1)]
    x = unit(np.cross(across, normal))
    y = np.cross(normal, x)
    return np.stack([np.einsum("ij,ij->i", p.V, axis[p.of_vertex]) for axis in (x, y)], 1)


def mirrored(p: CellPatches, uv: Floats) -> Bools:
    """Tell which faces are mirrored or empty, (m,)."""
    out: Bools = ~(face_areas(uv, p.F) > 1e-6 * p.area)
    return out


def folded(p: CellPatches, uv: Floats) -> Bools:
    """Tell which cells have a mirrored or empty face, unless it is hardly there, (n,)."""
    fold = np.flatnonzero(mirrored(p, uv))
    x = p.V[p.F[fold]]
    longest = np.linalg.norm(x - x[:, [1, 2, 0]], axis=2).max(1)
    thick = 2 * p.area[fold] > _SLIVER * longest
    out: Bools = np.bincount(p.cell[fold], thick, minlength=p.n) > 0
    return out


def scaled(p: CellPatches, uv: Floats) -> Floats:
    """Give each cell the area in the plane that it has in space."""
    size = sums(p.cell, p.area, p.n) / np.maximum(sums(p.cell, np.abs(face_areas(uv, p.F)), p.n), 1e-300)
    return uv * np.sqrt(size)[p.of_vertex, None]


def simple(p: CellPatches, uv: Floats) -> Bools:
    """Tell which cells have a border that does not meet itself in the plane, (n,)."""
    import shapely

    rim = rims(p)
    lines = shapely.linearrings(uv[rim], indices=p.of_vertex[rim])
    out: Bools = shapely.is_simple(lines)
    return out


def rims(p: CellPatches) -> Ints:
    """Order the border of every cell: its vertices, cell by cell, the lowest first, (b,).

    Cells are discs; borders run with the cell on their left.
    """
    h = border_halfedges(p.F)
    start, end = p.F.ravel()[h], p.F.ravel()[next_halfedge(h)]
    order = np.argsort(start)
    rim = start[order]
    return rim[cycles(np.searchsorted(rim, end[order])).members]


def subset(p: CellPatches, chosen: Bools) -> tuple[CellPatches, Ints]:
    """Take some of the cells, and say which vertices they have."""
    faces = chosen[p.cell]
    F, kept = compact(p.F[faces])
    number = np.cumsum(chosen) - 1
    cell, of_vertex = number[p.cell[faces]], number[p.of_vertex[kept]]
    return CellPatches(p.V[kept], F, cell, of_vertex, int(chosen.sum()), p.area[faces]), kept
