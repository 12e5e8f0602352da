"""Every cell flattened to the plane, all side by side."""

import numpy as np

from meshjig.cells.cell_mesh import CellMesh
from meshjig.cells.flatten.batched_arap import arap
from meshjig.cells.flatten.flatten_fallback import rescued
from meshjig.cells.flatten.planar import Patches, folded, patches, projected, scaled, simple, subset
from meshjig.cells.flatten.untangle_cells import unfolded
from meshjig.mesh.measure import face_areas
from meshjig.mesh.types import Atlas, Bools, Floats

__all__ = ["cell_atlas"]

_APART = 0.6  # of the largest cell's extent
_TORN = 1e-6  # mm between the places of one vertex


def cell_atlas(cells: CellMesh, known: Floats | None = None) -> Atlas:
    """Flatten every cell, all at once, and lay them side by side.

    Cells are looked at along their mean normal, then brought near isometry, small folds smoothed out;
    the few that stay folded, or whose border grows into itself, start from a round disc instead.

    Parameters
    ----------
    cells : CellMesh
    known : (m, 3, 2) float64, mm, optional
        Where the corners of faces lie in some plane, near to isometry; cells that are whole in it, without
        folds, stay as they are there.

    Returns
    -------
    Atlas
        Chart i is cell i: no face mirrored, its area that of the cell in space, and as far from all
        others as 0.6 of the largest chart's extent. facts: rescued (cells that folded at first), flips
        (faces mirrored or flat in the end).
    """
    p = patches(cells.mesh.V, cells.mesh.F, cells.cell)
    uv, todo = np.zeros((len(p.V), 2)), np.ones(p.n, bool)
    if known is not None:
        uv, torn = _placed(p, known)
        todo = torn | folded(p, uv) | ~simple(p, uv)
    if todo.any():
        q, moved = subset(p, todo)
        uv[moved] = unfolded(q, arap(q, projected(q)))
    uv = scaled(p, uv)
    bad = todo & (folded(p, uv) | ~simple(p, uv))
    if bad.any():
        kept, apart = rescued(p, bad)
        uv[kept] = apart
    facts = {"rescued": int(bad.sum()), "flips": int((face_areas(uv, p.F) <= 0).sum())}
    return Atlas(cells.mesh, _side_by_side(p, uv), p.F, p.cell, facts)


def _placed(p: Patches, corners: Floats) -> tuple[Floats, Bools]:
    """Give the places of vertices (k, 2) by those of corners (m, 3, 2), and the cells torn by it, (n,)."""
    uv = np.zeros((len(p.V), 2))
    uv[p.F] = corners
    torn = (np.abs(uv[p.F] - corners) > _TORN).any((1, 2))
    return uv, np.bincount(p.cell, torn, minlength=p.n) > 0


def _side_by_side(p: Patches, uv: Floats) -> Floats:
    """Place cells on a square grid."""
    low, high = np.full((p.n, 2), np.inf), np.full((p.n, 2), -np.inf)
    np.minimum.at(low, p.of_vertex, uv)
    np.maximum.at(high, p.of_vertex, uv)
    pitch = float(np.linalg.norm(high - low, axis=1).max()) * (1 + _APART)
    side = int(np.ceil(np.sqrt(p.n)))
    cell = np.arange(p.n)
    corner = np.stack([cell % side, cell // side], 1) * pitch
    return uv + (corner - (low + high) / 2)[p.of_vertex]
