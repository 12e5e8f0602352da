"""The working resolution: fewer faces where there are too many, shorter edges where too long."""

from __future__ import annotations

import numpy as np

from meshjig.errors import InputError
from meshjig.scan.manifold import is_clean
from meshjig.scan.native import import_pymeshlab
from meshjig.scan.repair import repair
from meshjig.topology import compact, edges
from meshjig.types import Floats, Ints

__all__ = ["decimate", "refine_long_edges"]

_ROUNDS = 64


def decimate(V: Floats, F: Ints, faces: int) -> tuple[Floats, Ints]:
    """Simplify a mesh to a number of faces, keeping its topology and its borders.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, manifold
    faces : int, target; topology may keep the mesh above it

    Returns
    -------
    V : (n', 3) float64
    F : (m', 3) int64, as clean as the input

    Raises
    ------
    InputError
        pymeshlab can't be imported, or fails.

    References
    ----------
    Garland and Heckbert, "Surface Simplification Using Quadric Error Metrics", 1997.
    """
    if len(F) <= faces:
        return V, F
    pymeshlab = import_pymeshlab()
    meshes = pymeshlab.MeshSet(verbose=False)
    meshes.add_mesh(pymeshlab.Mesh(V, F))
    try:
        meshes.meshing_decimation_quadric_edge_collapse(
            targetfacenum=faces,
            qualitythr=0.5,
            preserveboundary=True,
            preservenormal=True,
            preservetopology=True,
            planarquadric=True,
        )
    except pymeshlab.PyMeshLabException as error:
        raise InputError(
            f"the mesh can't be simplified to {faces} faces ({error})", hint="work on all its faces"
        ) from None
    mesh = meshes.current_mesh()
    F, kept = compact(np.asarray(mesh.face_matrix(), np.int64))
    V = np.asarray(mesh.vertex_matrix(), np.float64)[kept]
    if not is_clean(F, len(V)):
        V, F, _ = repair(V, F, cavities=True)
    return V, F


def refine_long_edges(V: Floats, F: Ints, length: float) -> tuple[Floats, Ints]:
    """Split edges at their middle until none is longer than length.

    Both faces of an edge are split with it, so the mesh conforms all the time; the surface stays the same.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64
    length : float, mm

    Returns
    -------
    V : (n', 3) float64, the given vertices first
    F : (m', 3) int64
    """
    for _ in range(_ROUNDS):
        e = edges(F)
        long = np.linalg.norm(V[e.E[:, 1]] - V[e.E[:, 0]], axis=1) > length
        if not long.any():
            break
        middle = np.full(len(e.E), -1)
        middle[long] = len(V) + np.arange(long.sum())
        V = np.concatenate([V, V[e.E[long]].mean(axis=1)])
        F = _split(V, F, middle[e.edge_of_halfedge].reshape(-1, 3))
    return V, F


def _split(V: Floats, F: Ints, middle: Ints) -> Ints:
    """Split faces into 1 to 4 by the middles of their sides, -1 where a side has none."""
    has = middle >= 0
    n_split = has.sum(axis=1)
    # turn each face so that the one split side, or the one whole side, comes first
    turn = np.where(n_split == 1, has.argmax(axis=1), np.where(n_split == 2, (~has).argmax(axis=1), 0))
    corners = (np.arange(3) + turn[:, None]) % 3
    a, b, c = np.take_along_axis(F, corners, 1).T
    ab, bc, ca = np.take_along_axis(middle, corners, 1).T
    one, two, three = (n_split == k for k in (1, 2, 3))
    # two sides split: a corner goes, and the rest, a quad, is halved by its shorter diagonal
    short = np.linalg.norm(V[a] - V[bc], axis=1) <= np.linalg.norm(V[b] - V[ca], axis=1)
    first, second = two & short, two & ~short
    parts = [
        (n_split == 0, (a, b, c)),
        (one, (a, ab, c)),
        (one, (ab, b, c)),
        (two, (c, ca, bc)),
        (first, (a, b, bc)),
        (first, (a, bc, ca)),
        (second, (a, b, ca)),
        (second, (b, bc, ca)),
        (three, (a, ab, ca)),
        (three, (ab, b, bc)),
        (three, (ca, bc, c)),
        (three, (ab, bc, ca)),
    ]
    return np.concatenate([np.stack(part, 1)[mask] for mask, part in parts])
