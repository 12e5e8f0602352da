"""The working resolution: fewer faces where there are too many."""

from __future__ import annotations

import numpy as np

from meshjig.errors import InputError
from meshjig.mesh.halfedges import compact
from meshjig.mesh.types import Floats, Ints
from meshjig.scan.manifold import is_clean
from meshjig.scan.native import import_pymeshlab
from meshjig.scan.repair import repair

__all__ = ["decimate"]


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
