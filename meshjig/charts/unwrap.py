"""Let xatlas choose the charts."""

import numpy as np
from numpy.typing import NDArray

from meshjig.charts.split import split
from meshjig.topology import components, is_disc

__all__ = ["unwrap"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


def unwrap(V: Floats, F: Ints, seed: int = 0) -> Ints:
    """Label each face with its xatlas chart.

    Only the division into charts is kept: xatlas mirrors many charts, and packs them for textures.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, manifold; xatlas is slow beyond some thousand faces
    seed : int

    Returns
    -------
    chart_of_face : (m,) int64, 0 to k - 1; every chart is a disc
    """
    import xatlas

    atlas = xatlas.Atlas()
    atlas.add_mesh(V.astype(np.float32), F.astype(np.uint32))
    packing = xatlas.PackOptions()
    packing.resolution = 256
    atlas.generate(pack_options=packing)
    _, corners, _ = atlas[0]
    _, label = components(corners.astype(np.int64))
    return split(V, F, label, lambda faces: is_disc(F[faces]), seed)
