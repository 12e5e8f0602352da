"""A light stand-in for a heavy mesh, on which charts are found quickly."""

import numpy as np
from numpy.typing import NDArray

from meshjig.charts.transfer.coarsen import coarsen
from meshjig.errors import ChartError
from meshjig.mesh.components import fans
from meshjig.mesh.halfedges import Edges, edges
from meshjig.mesh.measure import vertex_normals

__all__ = ["coarsened", "proxy"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

_HEAVY = 8  # times as many faces as wanted: from there on, decimation takes too long
_ROUGH = 0.25  # mean of 1 - cos between vertex normals over an edge; smooth shapes stay below 0.1


def proxy(V: Floats, F: Ints, n_faces: int = 5000, e: Edges | None = None) -> tuple[Floats, Ints]:
    """Decimate one component to about n_faces, with its topology kept but for vertices that pinch.

    Noise is smoothed away before: it would count as curvature.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, manifold, one component
    n_faces : int
    e : Edges, of F, where the caller has them

    Returns
    -------
    V : (n', 3) float64, mm
    F : (m', 3) int64. The mesh itself where it is small, or can't be decimated soundly.

    Raises
    ------
    ChartError
        pymeshlab can't be loaded: a system library is missing.
    """
    if len(F) <= 1.5 * n_faces:
        return V, F
    V, F = coarsened(V, F, _HEAVY * n_faces, e)
    try:
        import pymeshlab
    except ImportError as error:
        raise ChartError(
            f"pymeshlab can't be loaded ({error})", hint="install the system packages libgl1 and libopengl0"
        ) from None
    meshes = pymeshlab.MeshSet(verbose=False)
    meshes.add_mesh(pymeshlab.Mesh(V, F))
    if _roughness(V, F) > _ROUGH:
        meshes.apply_coord_taubin_smoothing(stepsmoothnum=10)
    meshes.meshing_decimation_quadric_edge_collapse(
        targetfacenum=n_faces,
        preserveboundary=False,  # unsaid, it would be as in the simplification before
        preservetopology=True,
        preservenormal=True,
        qualitythr=0.5,
        planarquadric=True,
    )
    mesh = meshes.current_mesh()
    G, origin = fans(np.ascontiguousarray(mesh.face_matrix(), np.int64))
    if not len(G) or edges(G).n_faces.max() > 2:
        return V, F
    return np.ascontiguousarray(mesh.vertex_matrix()[origin]), G


def coarsened(V: Floats, F: Ints, n_faces: int, e: Edges | None = None) -> tuple[Floats, Ints]:
    """Make a mesh coarser, by four at a time, until it has n_faces at most; itself where that can't be.

    Its edges may be given where the caller has them.
    """
    while len(F) > n_faces and (light := coarsen(V, F, e=e)) is not None:
        (V, F), e = light, None
    return V, F


def _roughness(V: Floats, F: Ints) -> float:
    """Give the mean of |1 - cos| between vertex normals over an edge."""
    N, E = vertex_normals(V, F), edges(F).E
    return float(np.mean(1 - np.einsum("ij,ij->i", N[E[:, 0]], N[E[:, 1]])))
