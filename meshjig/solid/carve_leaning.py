"""Pieces whose walls lean: each is cut out of the shell under it and around it."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from meshjig.mesh.arrays import Floats, Ints, connected, ragged, starts
from meshjig.mesh.booleans import Body, body
from meshjig.mesh.halfedges import compact, edges
from meshjig.mesh.rays import RayScene
from meshjig.solid.border_chains import Chains
from meshjig.solid.solidify import solidify
from meshjig.solid.wall_edges import LabelledShell, bent

__all__ = ["LeaningWalls", "bands", "finer", "ruled"]

_MARGIN = 0.8  # mm, that a band goes past the walls in it
_APART = 0.4  # mm between places on a border around which the band is looked for
_NEAREST, _FARTHEST = 0.5, 4.0  # of half the thickness: where sheets are looked for
_ROUNDS = 12
_MARKS = 12  # points that tell which part of a band is the piece


class LeaningWalls(NamedTuple):
    """Where walls begin and end, at every vertex; half way they are on the border."""

    top: Floats  # (n, 3), mm
    D: Floats  # (n, 3), mm, to the bottom


def ruled(surface: LabelledShell, deep: Floats, at: Ints, wall: Floats) -> LeaningWalls:
    """Turn walls around the middle of the shell, and lead them from sheet to sheet.

    Parameters
    ----------
    surface : LabelledShell
    deep : (n, 3) float64, mm, walls that don't lean
    at : (k,) int64, the vertices where they do
    wall : (k, 3) float64, mm, as long as it takes from one sheet to the other where both are level
    """
    V, F, piece, D = surface
    way = np.zeros_like(V)
    way[at] = wall / 2
    tail, head = _between(F, piece, at, len(V))
    top, bottom = V.copy(), V + deep
    F = F[piece >= 0]
    for sheet, end, sign in ((V, top, -1), (V + D, bottom, 1)):
        scene = RayScene(sheet, F)
        far = np.ones(len(V))
        far[at] = _way_to(scene, V[at] + D[at] / 2, sign * way[at])
        half_way = (V[tail] + V[head]) / 2 + (D[tail] + D[head]) / 4
        between = _way_to(scene, half_way, sign * (way[tail] + way[head]) / 2)
        np.maximum.at(far, tail, between)
        np.maximum.at(far, head, between)
        end[at] = V[at] + D[at] / 2 + sign * far[at, None] * way[at]
    return LeaningWalls(top, bottom - top)


def _between(F: Ints, piece: Ints, at: Ints, n: int) -> tuple[Ints, Ints]:
    """Give the ends of edges between two pieces, of those whose ends are among some vertices."""
    e = edges(F)
    chosen = np.zeros(n, bool)
    chosen[at] = True
    border = np.zeros(len(e.E), bool)
    border[e.edge_of_halfedge[np.repeat(piece, 3) != piece[e.twin // 3]]] = True
    tail, head = e.E[border & chosen[e.E].all(axis=1)].T
    return tail, head


def _way_to(scene: RayScene, start: Floats, way: Floats) -> Floats:
    """Tell how far it is to a sheet, in lengths of the way; 1 where it is not near."""
    far = scene.first_distance(start, way)
    return np.where(far < _FARTHEST, np.maximum(far, _NEAREST), 1.0)


def finer(walls: LeaningWalls, chains: Chains, tolerance: float) -> tuple[LeaningWalls, Chains]:
    """Add places along borders where a wall turns too much to be two triangles; they come last."""
    top, D = walls
    vertex, start, pair = chains
    for _ in range(_ROUNDS):
        link = np.ones(len(vertex) - 1, bool)
        link[start[1:-1] - 1] = False
        i, j = vertex[:-1], vertex[1:]
        split = np.flatnonzero(link & bent(top, top + D, i, j, tolerance))
        if not len(split):
            break
        new = len(top) + np.arange(len(split))
        top = np.concatenate([top, (top[i[split]] + top[j[split]]) / 2])
        D = np.concatenate([D, (D[i[split]] + D[j[split]]) / 2])
        vertex = np.insert(vertex, split + 1, new)
        start = start + np.searchsorted(split, start, side="left")
    return LeaningWalls(top, D), Chains(vertex, start, pair)


def bands(
    surface: LabelledShell, walls: LeaningWalls, chosen: Ints, clearance: float
) -> dict[int, tuple[Body, Floats]]:
    """Give the shell under each of some pieces and a band around it, wide enough for the walls in it.

    With it come points on each piece's outer sheet, those farthest from its border.
    """
    from scipy.spatial import cKDTree

    V, F, piece, D = surface
    tree = cKDTree(V)
    n = len(V)
    ends = walls.top[:n], walls.top[:n] + walls.D[:n] - D
    lean = np.maximum(*(np.linalg.norm(end - V, axis=1) for end in ends))
    e = edges(F)
    border = np.zeros(len(V), bool)
    between = np.repeat(piece, 3) != piece[e.twin // 3]
    border[e.E[e.edge_of_halfedge[between]]] = True
    faces_at = np.argsort(F.ravel(), kind="stable") // 3
    n_at = np.bincount(F.ravel(), minlength=len(V))
    first_at = starts(n_at)
    order = np.argsort(piece, kind="stable")
    start = np.searchsorted(piece[order], np.arange(int(piece.max(initial=-1)) + 2))
    made = {}
    for k in chosen.tolist():
        own = order[start[k] : start[k + 1]]
        if not len(own):
            continue
        corner = np.unique(F[own])
        rim = corner[border[corner]]
        reach = float(lean[rim].max(initial=0)) + clearance / 2 + _MARGIN
        cells = np.unique(np.floor(V[rim] / _APART).astype(np.int64), axis=0, return_index=True)[1]
        found = tree.query_ball_point(V[rim[cells]], reach + _APART, return_sorted=False)
        near = np.unique(np.concatenate([np.asarray(x, np.int64) for x in found])) if len(found) else corner
        near = np.union1d(near, corner)
        faces = np.unique(faces_at[ragged(first_at[near], n_at[near])])
        faces = faces[piece[faces] >= 0]
        made[k] = _solid_of(V, F, D, _joined(faces, own, e.twin)), _farthest(V, F[own], V[rim])
    return made


def _farthest(V: Floats, F: Ints, rim: Floats) -> Floats:
    from scipy.spatial import cKDTree

    points = np.concatenate([V[np.unique(F)], V[F].mean(axis=1)])
    if not len(rim):
        return points[:_MARKS]
    away = cKDTree(rim).query(points)[0]
    return np.asarray(points[np.argsort(-away, kind="stable")[:_MARKS]])


def _joined(faces: Ints, own: Ints, twin: Ints) -> Ints:
    """Give the faces, of some sorted, that are connected over edges with the first of a piece's own."""
    across = twin.reshape(-1, 3)[faces] // 3
    at = np.minimum(np.searchsorted(faces, across), len(faces) - 1)
    a, k = np.nonzero(faces[at] == across)
    label = connected(len(faces), a, at[a, k])[1]
    return faces[label == label[np.searchsorted(faces, own[0])]]


def _solid_of(V: Floats, F: Ints, D: Floats, faces: Ints) -> Body:
    G, vertex = compact(F[faces])
    made = solidify(V[vertex], G, np.zeros(len(G), np.int64), D[vertex])[0][0]
    return body(made.V, made.F)
