"""Close the holes that scanning left: a chart must go round each of them, and a tile may fall into it."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from meshjig.mesh.components import components
from meshjig.mesh.halfedges import border_halfedges, edges, next_halfedge
from meshjig.mesh.measure import face_areas
from meshjig.mesh.types import Bools, Floats, Ints
from meshjig.scan.manifold import is_clean

__all__ = ["Filled", "fill_holes"]

_SCRAP = 4.0  # a component is worth closing when its area is that of so many discs as wide as the hole


class Filled(NamedTuple):
    """A mesh with its small holes closed; the vertices of the input come first."""

    V: Floats  # (n, 3), mm
    F: Ints  # (m, 3)
    facts: dict[str, Any]


def fill_holes(V: Floats, F: Ints, diameter: float) -> Filled:
    """Close every hole up to a diameter by a patch as fine as the mesh around it.

    The outer border of a small scrap is no hole: what would only double it is left open.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, manifold
    diameter : float, mm, between the farthest points of a hole's border

    Returns
    -------
    Filled
        facts: up_to_mm, closed (holes), area_mm2 (of the patches), left (open borders that stay).
    """
    h = border_halfedges(F)
    n_loops, loop = _loops(F, h)
    facts: dict[str, Any] = {"up_to_mm": float(diameter), "closed": 0, "area_mm2": 0.0, "left": n_loops}
    small = _is_hole(V, F, h, loop, n_loops, diameter)
    if not small.any():
        return Filled(V, F, facts)
    rims = [h[loop == k] for k in np.flatnonzero(small)]
    n = len(V)
    parts = []
    for rim in rims:
        patch, n_new = _disc(_in_order(F, rim), V, n)
        parts.append(patch)
        n += n_new
    patches = np.concatenate(parts)
    G = np.concatenate([F, patches])
    if not is_clean(G, n):
        return Filled(V, F, facts)
    W = np.concatenate([V, _smoothly_placed(V, F, patches, n)])
    left = _loops(G, border_halfedges(G))[0]
    area = float(face_areas(W, patches).sum())
    return Filled(W, G, facts | {"closed": n_loops - left, "area_mm2": area, "left": left})


def _loops(F: Ints, h: Ints) -> tuple[int, Ints]:
    """Number the border loops that half-edges h lie on: how many, and whose each is."""
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components

    if not len(h):
        return 0, h
    start, end = F.ravel()[h], F.ravel()[next_halfedge(h)]
    vertices, number = np.unique(np.concatenate([start, end]), return_inverse=True)
    rows, cols = number[: len(h)], number[len(h) :]
    graph = coo_matrix((np.ones(len(h), np.int8), (rows, cols)), shape=(len(vertices), len(vertices)))
    n, of_vertex = connected_components(graph, directed=False)
    return int(n), of_vertex[rows].astype(np.int64)


def _is_hole(V: Floats, F: Ints, h: Ints, loop: Ints, n_loops: int, diameter: float) -> Bools:
    """Tell which loops are holes to be closed, (n_loops,)."""
    from scipy.spatial.distance import pdist

    n, component = components(F)
    area = np.bincount(component, face_areas(V, F), n)
    hole = np.zeros(n_loops, bool)
    length = np.linalg.norm(V[F.ravel()[next_halfedge(h)]] - V[F.ravel()[h]], axis=1)
    girth = np.bincount(loop, length, n_loops)
    for k in np.flatnonzero(girth <= np.pi * 2 * diameter):
        mine = h[loop == k]
        wide = float(pdist(V[F.ravel()[mine]]).max())
        around = area[component[mine[0] // 3]]
        hole[k] = wide <= diameter and around >= _SCRAP * np.pi / 4 * wide**2
    return hole


def _in_order(F: Ints, rim: Ints) -> Ints:
    """Give the vertices of one border loop, as its half-edges run."""
    following = dict(zip(F.ravel()[rim].tolist(), F.ravel()[next_halfedge(rim)].tolist(), strict=True))
    walk = [int(F.ravel()[rim[0]])]
    while (after := following[walk[-1]]) != walk[0]:
        walk.append(after)
    return np.array(walk)


def _disc(rim: Ints, V: Floats, n: int) -> tuple[Ints, int]:
    """Triangulate a disc behind a loop: its faces, and how many vertices from n on are new.

    The loop becomes a circle, and a triangular lattice as fine as the loop fills it: so no face joins
    vertices of the loop only, as chords would that the mesh may have already.
    """
    from scipy.spatial import Delaunay

    step = np.linalg.norm(V[rim] - V[np.roll(rim, -1)], axis=1)
    turn = 2 * np.pi * (np.cumsum(step) - step) / step.sum()
    circle = np.stack([np.cos(turn), np.sin(turn)], 1)
    spacing = 2 * np.pi / len(rim)
    i, j = (x.ravel() for x in np.meshgrid(*[np.arange(-len(rim), len(rim) + 1)] * 2))
    lattice = spacing * np.stack([i + j / 2, j * np.sqrt(0.75)], 1)
    inner = lattice[(np.linalg.norm(lattice, axis=1) < 1 - 0.8 * spacing) | ((i == 0) & (j == 0))]
    faces = Delaunay(np.concatenate([circle, inner])).simplices.astype(np.int64)
    xy = np.concatenate([circle, inner])[faces]
    one, two = xy[:, 1] - xy[:, 0], xy[:, 2] - xy[:, 0]
    left = one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0] > 0
    faces[left] = faces[left][:, ::-1]  # the patch lies on the other side of the loop than the mesh
    return np.concatenate([rim, n + np.arange(len(inner))])[faces], len(inner)


def _smoothly_placed(V: Floats, F: Ints, patches: Ints, n: int) -> Floats:
    """Place the vertices from len(V) to n so that the patches go on smoothly from the mesh.

    References
    ----------
    Botsch and Kobbelt, "An Intuitive Framework for Real-Time Freeform Modeling", 2004: thin plates.
    """
    from scipy.sparse import coo_matrix, diags
    from scipy.sparse.linalg import spsolve

    touched = np.zeros(n, bool)
    touched[patches] = True
    near = F[touched[F].any(1)]
    E = edges(np.concatenate([near, patches])).E
    A = coo_matrix((np.ones(len(E)), E.T), shape=(n, n))
    A = (A + A.T).tocsr()
    degree = np.maximum(np.asarray(A.sum(1)).ravel(), 1)
    bent = (diags(np.ones(n)) - diags(1 / degree) @ A)[touched]
    new, old = bent[:, len(V) :], bent[:, : len(V)]
    placed: Floats = spsolve((new.T @ new).tocsc(), -new.T @ (old @ V)).reshape(-1, 3)
    return placed
