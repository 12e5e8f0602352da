"""Carry charts from a light proxy over to the full mesh."""

import numpy as np
from numpy.typing import NDArray

from meshjig.charts.dual import dual
from meshjig.charts.smooth import smooth
from meshjig.charts.tidy import tidy
from meshjig.measure import area_vectors, barycentric, face_areas, interpolate

__all__ = ["transfer_labels", "transfer_uv"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

_REACH = 0.008  # of the root of the area: a proxy's faces show as teeth along its borders


def transfer_labels(V: Floats, F: Ints, W: Floats, G: Ints, label: Ints) -> Ints:
    """Give each face of a mesh the label of the nearest face of its proxy, with borders made straight.

    Parameters
    ----------
    V, F : (n, 3) float64, mm, and (m, 3) int64, the mesh, one component
    W, G : (n', 3) float64, mm, and (m', 3) int64, the proxy
    label : (m',) int64, 0 to k - 1

    Returns
    -------
    label : (m,) int64. A label may come out empty, or as no disc: the caller checks.
    """
    import igl

    _, near, _ = igl.point_mesh_squared_distance(V[F].mean(1), W, G)
    N, M = area_vectors(V, F), area_vectors(W, G)
    same_side = np.einsum("ij,ij->i", N, M[near]) >= 0  # of a thin sheet
    known = np.where(same_side, label[near], -1) if same_side.any() else label[near]
    area = face_areas(V, F)
    return tidy(F, smooth(dual(V, F), tidy(F, known, area), _REACH), area)


def transfer_uv(V: Floats, W: Floats, G: Ints, uv: Floats) -> Floats:
    """Give points the place in the plane that their nearest point on a proxy chart has.

    Points beyond the border of the proxy chart follow the plane of its nearest face.

    Parameters
    ----------
    V : (n, 3) float64, mm
    W, G : (n', 3) float64, mm, and (m', 3) int64, the proxy's chart
    uv : (n', 2) float64, mm

    Returns
    -------
    uv : (n, 2) float64, mm. Faces may come out mirrored: see untangle.
    """
    import igl

    _, face, _ = igl.point_mesh_squared_distance(V, W, G)
    bary = np.clip(barycentric(W, G, face, V), -1.0, 2.0)
    bary[:, 0] = 1 - bary[:, 1] - bary[:, 2]
    return interpolate(uv, G, face, bary)
