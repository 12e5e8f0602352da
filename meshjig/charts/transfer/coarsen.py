"""Make a heavy mesh four times lighter at a stroke: stars of vertices shrink to one."""

import numpy as np
from numpy.typing import NDArray

from meshjig.mesh.components import components, fans
from meshjig.mesh.halfedges import Edges, edges
from meshjig.mesh.measure import area_vectors, sums

__all__ = ["coarsen"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]

_REPAIRS = 6
_LIGHTER = 0.8  # of the faces may be left, or it is not worth while
_STAY = 0.02  # how strongly a star holds to its mean, where its faces leave a choice


def coarsen(V: Floats, F: Ints, seed: int = 0, e: Edges | None = None) -> tuple[Floats, Ints] | None:
    """Contract a spread set of vertices with their neighbours, in time linear in the mesh.

    Every vertex of a maximal set without neighbours takes in the neighbours that have not gone to
    another. Each star shrinks to a point near its mean, so that noise is averaged out, and near the
    planes of its faces, so that folds stay sharp. Stars that would spoil the topology are left as
    they are.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, manifold, one component that uses every vertex
    seed : int
    e : Edges, of F, where the caller has them

    Returns
    -------
    V : (n', 3) float64, mm, and F : (m', 3) int64; None where the topology could not
        be kept, or the mesh got hardly lighter

    References
    ----------
    Luby, "A Simple Parallel Algorithm for the Maximal Independent Set Problem", 1986.
    Garland and Heckbert, "Surface Simplification Using Quadric Error Metrics", 1997.
    """
    e = edges(F) if e is None else e
    on_border = np.zeros(len(V), bool)
    on_border[e.E[e.n_faces == 1].ravel()] = True
    rank = np.random.default_rng(seed).permutation(len(V)) + len(V) * on_border
    centre = _stars(e.E, rank, on_border)
    goal = len(V) - len(e.E) + len(F)
    for n in range(_REPAIRS):
        number, label = np.unique(centre, return_inverse=True)
        G = every = label[F]
        G = G[(G[:, 0] != G[:, 1]) & (G[:, 1] != G[:, 2]) & (G[:, 2] != G[:, 0])]
        left = edges(G)
        spoilt = _spoilt(G, len(number), left)
        if not spoilt.any():
            break
        if n:  # the spoiler may be a neighbour
            spoilt[every[spoilt[every].any(1)]] = True
        loose = spoilt[label]
        centre[loose] = np.flatnonzero(loose)
    else:
        return None
    if len(G) > _LIGHTER * len(F) or len(number) - len(left.E) + len(G) != goal:
        return None
    if components(G, twin=left.twin)[0] != 1:
        return None
    return _shrunk(V, F, label, every, on_border), G


def _shrunk(V: Floats, F: Ints, label: Ints, star: Ints, on_border: Bools) -> Floats:
    """Place every star where it is near the planes of its faces and not far from its mean, (n', 3).

    Of the stars, those of all corners are given as well, (m, 3).
    """
    n = int(label.max()) + 1
    N = area_vectors(V, F)
    area = np.maximum(np.linalg.norm(N, axis=1), 1e-300)
    share = _gathered(F, area, len(V)) + 1e-9 * area.mean()
    share *= np.where(on_border, 1e6, 1.0)  # a border stays where it is
    mean = (
        np.stack([np.bincount(label, share * x, n) for x in V.T], 1) / np.bincount(label, share, n)[:, None]
    )
    upper = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)]
    height = np.einsum("ij,ij->i", N, V[F[:, 0]]) / area
    N = np.ascontiguousarray(N.T)
    Q = np.empty((n, 3, 3))
    for i, j in upper:
        Q[:, i, j] = Q[:, j, i] = _gathered(star, N[i] * N[j] / area, n)
    total = np.stack([_gathered(star, N[i] * height, n) for i in range(3)], 1)
    pull = total - np.einsum("kij,kj->ki", Q, mean)
    size = np.trace(Q, axis1=1, axis2=2)
    Q += (_STAY * np.maximum(size, 1e-9 * size.mean() + 1e-300))[:, None, None] * np.eye(3)
    open_stars = np.bincount(label, on_border, n) > 0
    moved: Floats = mean + np.where(open_stars[:, None], 0.0, np.linalg.solve(Q, pull[..., None])[..., 0])
    return moved


def _gathered(corners: Ints, values: Floats, n: int) -> Floats:
    """Add up values of faces (m,) where their corners (m, 3) are, one of n places; (n,)."""
    return sums(corners.ravel(), np.repeat(values, 3), n)


def _stars(E: Ints, rank: Ints, on_border: Bools) -> Ints:
    """Give each vertex the centre of its star: the highest rank wins, round by round."""
    n = len(rank)
    centre = np.full(n, -1)
    a, b = np.append(E[:, 0], E[:, 1]), np.append(E[:, 1], E[:, 0])
    live = np.arange(len(a))
    while True:
        best = np.full(n, -1)
        np.maximum.at(best, a[live], rank[b[live]])
        won = (centre < 0) & (rank > best)
        if not won.any():
            return centre
        centre[won] = np.flatnonzero(won)
        taken = live[won[b[live]] & (centre[a[live]] < 0) & (on_border[b[live]] | ~on_border[a[live]])]
        centre[a[taken]] = b[taken]
        live = live[(centre[a[live]] < 0) & (centre[b[live]] < 0)]


def _spoilt(G: Ints, n: int, e: Edges) -> Bools:
    """Mark vertices at which faces don't make a surface: too many at an edge, or more than one fan."""
    _, origin = fans(G, e.twin)
    bad = np.bincount(origin, minlength=n) != 1
    bad[e.E[e.n_faces > 2].ravel()] = True
    return bad
