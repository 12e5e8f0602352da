"""What of a model its pieces cover: of its surface, and of the volume of its thin parts."""

from __future__ import annotations

from typing import NamedTuple

import igl
import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.mesh import Mesh, concatenate
from meshjig.mesh.ray_thickness import ray_thickness
from thin.model import ON_SURFACE, Model, spread

__all__ = ["Lost", "Uncovered", "lost_volume", "uncovered"]

_ON_FACES, _IN_PARTS = 40_000, 20_000
_NEAR = 0.75  # of the clearance: what is farther from every piece lies in no gap


class Uncovered(NamedTuple):
    """What of a model's surface no piece is near."""

    share: float  # of the area
    farthest: float  # mm, from the surface to the nearest piece
    at: Floats  # (3,), where that is


class Lost(NamedTuple):
    """What of a model's thin parts is neither in a piece nor in a gap."""

    share: float  # of their volume
    part: float  # of the model's area that is thin
    samples: int


def uncovered(model: Model, pieces: list[Mesh], clearance: float) -> Uncovered:
    """Ask of 40,000 points of a model's surface how far the nearest piece is."""
    points, _ = spread(model.mesh, _ON_FACES)
    whole = concatenate(pieces)
    far = np.sqrt(igl.point_mesh_squared_distance(points, whole.V, whole.F)[0])
    most = max(_NEAR * clearance, ON_SURFACE)
    return Uncovered(float((far > most).mean()), float(far.max()), points[far.argmax()])


def lost_volume(model: Model, pieces: list[Mesh], clearance: float, limit: float) -> Lost:
    """Ask of 20,000 points within a model's thin parts whether they are in a piece, or between two.

    Parameters
    ----------
    model : Model
    pieces : closed meshes, mm
    clearance : float, mm; a point between two pieces is no farther than this from both
    limit : float, mm, the ray thickness below which the part at a face is thin
    """
    depth = ray_thickness(model.mesh, limit).depth
    thin = np.isfinite(depth)
    part = float(model.mesh.areas[thin].sum() / model.mesh.areas.sum())
    points = _within_thin(model.mesh, depth, limit)
    if not len(points):
        return Lost(0.0, part, 0)
    whole = concatenate(pieces)
    free = np.asarray(igl.fast_winding_number(whole.V, whole.F, points)) < 0.5
    lost = free.copy()
    lost[free] = _pieces_near(points[free], pieces, clearance) < 2
    return Lost(float(lost.mean()), part, len(points))


def _within_thin(mesh: Mesh, depth: Floats, limit: float) -> Floats:
    """Draw points evenly from the volume of the thin parts: inside, the nearest face thin; (k, 3)."""
    thin = np.flatnonzero(np.isfinite(depth))
    if not len(thin):
        return np.zeros((0, 3))
    rng, cell = np.random.default_rng(0), limit / 2
    cells = _cells_below(mesh, thin, limit, cell)
    found: list[Floats] = []
    for _ in range(100):
        points = cell * (cells[rng.integers(len(cells), size=_IN_PARTS)] + rng.random((_IN_PARTS, 3)))
        nearest = igl.point_mesh_squared_distance(points, mesh.V, mesh.F)[1]
        points = points[np.isfinite(depth[nearest])]
        inside: Bools = np.asarray(igl.fast_winding_number(mesh.V, mesh.F, points)) > 0.5
        found.append(points[inside])
        if sum(map(len, found)) >= _IN_PARTS:
            break
    return np.concatenate(found)[:_IN_PARTS]


def _cells_below(mesh: Mesh, thin: Ints, limit: float, cell: float) -> Ints:
    """Give the cells of a grid in which a point may lie that has a thin face nearest, (c, 3).

    Such a point is at most half the limit below a face, or a little more beside an edge.
    """
    part = Mesh(mesh.V, mesh.F[thin])
    n = max(20_000, round(float(part.areas.sum()) / (cell / 2) ** 2))
    points = np.concatenate([spread(part, n)[0], mesh.V[np.unique(part.F)]])
    met = np.unique(np.floor(points / cell).astype(np.int64), axis=0)
    reach = int(np.ceil(limit / 2 / cell)) + 1
    ring = np.indices([2 * reach + 1] * 3).reshape(3, -1).T - reach
    return np.unique((met[:, None] + ring).reshape(-1, 3), axis=0)


def _pieces_near(points: Floats, pieces: list[Mesh], reach: float) -> Ints:
    """Count the pieces that are within reach of points, (k,)."""
    count = np.zeros(len(points), np.int64)
    for V, F in pieces:
        near = np.flatnonzero(((points > V.min(0) - reach) & (points < V.max(0) + reach)).all(1))
        if len(near):
            squared = igl.point_mesh_squared_distance(points[near], V, F)[0]
            count[near] += squared <= reach**2
    return count
