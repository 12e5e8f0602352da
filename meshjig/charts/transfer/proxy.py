"""A stand-in with few faces for a heavy mesh, on which charts are found quickly."""

import numpy as np

from meshjig.errors import ChartError
from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.components import components, fans
from meshjig.mesh.halfedges import Edges, edges
from meshjig.mesh.measure import area_vectors, sums
from meshjig.mesh.mesh import Mesh

__all__ = ["coarsen", "coarsened", "proxy_mesh"]

_HEAVY = 8  # times as many faces as wanted: from there on, decimation takes too long
_ROUGH = 0.25  # mean of 1 - cos between vertex normals over an edge; smooth shapes stay below 0.1
_REPAIRS = 6  # rounds in which stars that spoil the topology are left out
_LIGHTER = 0.8  # of the faces may be left, or it is not worth while
_STAY = 0.02  # how strongly a star holds to its mean, where its faces leave a choice


def proxy_mesh(mesh: Mesh, n_faces: int = 5000) -> Mesh:
    """Decimate one component to about n_faces, with its topology kept but for vertices that pinch.

    Noise is smoothed away before: it would count as curvature.

    Parameters
    ----------
    mesh : Mesh, manifold, one component
    n_faces : int

    Returns
    -------
    Mesh
        The mesh itself where it is small, or can't be decimated soundly.

    Raises
    ------
    ChartError
        pymeshlab can't be loaded: a system library is missing.
    """
    if len(mesh.F) <= 1.5 * n_faces:
        return mesh
    V, F = mesh = coarsened(mesh, _HEAVY * n_faces)
    try:
        import pymeshlab
    except ImportError as error:
        raise ChartError(
            f"pymeshlab can't be loaded ({error})", hint="install the system packages libgl1 and libopengl0"
        ) from None
    meshes = pymeshlab.MeshSet(verbose=False)
    meshes.add_mesh(pymeshlab.Mesh(V, F))
    if _roughness(mesh) > _ROUGH:
        meshes.apply_coord_taubin_smoothing(stepsmoothnum=10)
    meshes.meshing_decimation_quadric_edge_collapse(
        targetfacenum=n_faces,
        preserveboundary=False,  # unsaid, it would be as in the simplification before
        preservetopology=True,
        preservenormal=True,
        qualitythr=0.5,
        planarquadric=True,
    )
    decimated = meshes.current_mesh()
    G, origin = fans(np.ascontiguousarray(decimated.face_matrix(), np.int64))
    if not len(G) or edges(G).n_faces.max() > 2:
        return mesh
    return Mesh(np.ascontiguousarray(decimated.vertex_matrix()[origin]), G)


def coarsened(mesh: Mesh, n_faces: int) -> Mesh:
    """Make a mesh coarser, by four at a time, until it has n_faces at most; itself where that can't be."""
    while len(mesh.F) > n_faces and (coarser := coarsen(mesh)) is not None:
        mesh = coarser
    return mesh


def _roughness(mesh: Mesh) -> float:
    """The mean of |1 - cos| between vertex normals over an edge."""
    N, E = mesh.vertex_normals, mesh.edges.E
    return float(np.mean(1 - np.einsum("ij,ij->i", N[E[:, 0]], N[E[:, 1]])))


def coarsen(mesh: Mesh, seed: int = 0) -> Mesh | None:
    """Contract a spread set of vertices with their neighbours, in time linear in the mesh.

    Every vertex of a maximal set without neighbours takes in the neighbours that have not gone to
    another. Each star shrinks to a point near its mean, so that noise is averaged out, and near the
    planes of its faces, so that folds stay sharp. Stars that would spoil the topology are left as
    they are.

    Parameters
    ----------
    mesh : Mesh, manifold, one component
    seed : int

    Returns
    -------
    Mesh; None where the topology could not be kept, or it would have hardly fewer faces

    References
    ----------
    Luby, "A Simple Parallel Algorithm for the Maximal Independent Set Problem", 1986.
    Garland and Heckbert, "Surface Simplification Using Quadric Error Metrics", 1997.
    """
    V, F = mesh
    e, on_border = mesh.edges, mesh.is_border_vertex
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
    return Mesh(_shrunk(V, F, label, every, on_border), G)


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
