"""Close the holes that scanning left: a chart must go round each of them, and a tile may fall into it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.boundary_loops import border_loops
from meshjig.mesh.components import components
from meshjig.mesh.halfedges import edges
from meshjig.mesh.measure import face_areas
from meshjig.scan.manifold import is_clean

__all__ = ["Filled", "FilledHoles", "OpenBorder", "fill_holes"]

_RAGGED = 2 * np.pi  # a border may be so many diameters long, twice as long as a circle
_SAMPLE = 2000  # points of a border that its width is taken from
_SHOWN = 20  # open borders in the report
_SCRAP = 4.0  # a component is worth closing when its area is that of so many discs as wide as the hole


@dataclass(frozen=True)
class OpenBorder:
    """A border that stays open."""

    at: list[float]  # mm, its middle
    wide_mm: float  # between its farthest points
    closed_from_mm: float | None  # the least diameter with which it is closed; None where it never is


@dataclass(frozen=True)
class FilledHoles:
    """The report's ``filled_holes``."""

    up_to_mm: float
    closed: int  # holes
    area_mm2: float  # of the patches
    left: int  # open borders that stay
    open: list[OpenBorder]  # the widest of those, the widest first


class Filled(NamedTuple):
    """A mesh with its small holes closed; the vertices of the input come first."""

    V: Floats  # (n, 3), mm
    F: Ints  # (m, 3)
    facts: FilledHoles


class _Patched(NamedTuple):
    """A mesh with patches, whose inner vertices are not placed yet."""

    F: Ints  # (m, 3)
    n: int  # vertices


def fill_holes(V: Floats, F: Ints, diameter: float, spared: Bools | None = None) -> Filled:
    """Close every hole up to a diameter by a patch as fine as the mesh around it.

    The outer border of a small scrap is no hole: what would only double it is left open.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, manifold
    diameter : float, mm, between the farthest points of a hole's border
    spared : (n,) bool, optional
        Vertices of borders that are to stay open.

    Returns
    -------
    Filled
    """
    loops = sorted(border_loops(F), key=min)
    borders = _measured(V, F, loops)
    wanted = [spared is None or not bool(spared[loop].all()) for loop in loops]
    fits = [b.closed_from_mm is not None and b.closed_from_mm <= diameter for b in borders]
    holes = [loop for loop, w, f in zip(loops, wanted, fits, strict=True) if w and f]
    made, done = _patched(V, _Patched(F, len(V)), holes)
    closed = {int(loop.min()) for loop in done}
    left = [
        b for b, loop, w in zip(borders, loops, wanted, strict=True) if w and int(loop.min()) not in closed
    ]
    left = sorted(left, key=lambda b: -b.wide_mm)[:_SHOWN]
    facts = FilledHoles(float(diameter), len(done), 0.0, len(loops) - len(done), left)
    if not done:
        return Filled(V, F, facts)
    patches = made.F[len(F) :]
    W = np.concatenate([V, _smoothly_placed(V, F, patches, made.n)])
    return Filled(W, made.F, replace(facts, area_mm2=float(face_areas(W, patches).sum())))


def _measured(V: Floats, F: Ints, loops: list[Ints]) -> list[OpenBorder]:
    """Say where each border is, how wide, and what diameter would close it."""
    from scipy.spatial.distance import pdist

    n, component = components(F)
    component_of_vertex = np.zeros(len(V), np.int64)
    component_of_vertex[F] = component[:, None]
    area = np.bincount(component, face_areas(V, F), n)
    found = []
    for loop in loops:
        P = V[loop]
        wide = float(pdist(P[:: 1 + len(P) // _SAMPLE]).max(initial=0.0))
        length = float(np.linalg.norm(P - np.roll(P, -1, axis=0), axis=1).sum())
        scrap = area[component_of_vertex[loop[0]]] < _SCRAP * np.pi / 4 * wide**2
        found.append(OpenBorder(P.mean(0).tolist(), wide, None if scrap else max(wide, length / _RAGGED)))
    return found


def _patched(V: Floats, mesh: _Patched, holes: list[Ints]) -> tuple[_Patched, list[Ints]]:
    """Put a disc behind each hole; give back those whose disc leaves the mesh clean."""
    if not holes:
        return mesh, []
    F, n = [mesh.F], mesh.n
    for hole in holes:
        patch, n_new = _disc(hole, V, n)
        F.append(patch)
        n += n_new
    made = _Patched(np.concatenate(F), n)
    if is_clean(made.F, n):
        return made, holes
    if len(holes) == 1:
        return mesh, []
    middle = len(holes) // 2
    mesh, some = _patched(V, mesh, holes[:middle])
    mesh, others = _patched(V, mesh, holes[middle:])
    return mesh, some + others


def _disc(rim: Ints, V: Floats, n: int) -> tuple[Ints, int]:
    """Triangulate a disc behind a loop: its faces, and how many vertices from n on are new.

    The loop becomes a circle, and a triangular lattice as fine as the loop fills it: so no face joins
    vertices of the loop only, as chords would that the mesh may have already.
    """
    from scipy.spatial import Delaunay

    step = np.linalg.norm(V[rim] - V[np.roll(rim, -1)], axis=1)
    end = np.cumsum(step)
    turn = 2 * np.pi * (end - step) / step.sum()
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

    affected = np.zeros(n, bool)
    affected[patches] = True
    near = F[affected[F].any(1)]
    E = edges(np.concatenate([near, patches])).E
    A = coo_matrix((np.ones(len(E)), E.T), shape=(n, n))
    A = (A + A.T).tocsr()
    degree = np.maximum(np.asarray(A.sum(1)).ravel(), 1)
    bent = (diags(np.ones(n)) - diags(1 / degree) @ A)[affected]
    new, old = bent[:, len(V) :], bent[:, : len(V)]
    placed: Floats = spsolve((new.T @ new).tocsc(), -new.T @ (old @ V)).reshape(-1, 3)
    return placed
