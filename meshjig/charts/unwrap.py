"""Let xatlas choose the charts."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from meshjig.charts.segment.split import split
from meshjig.errors import OptionError
from meshjig.mesh.components import components, is_disc

__all__ = ["chart_options", "unwrap"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


def unwrap(V: Floats, F: Ints, seed: int = 0, options: dict[str, Any] | None = None) -> Ints:
    """Label each face with its xatlas chart.

    Only the division into charts is kept: xatlas mirrors many charts, and packs them for textures.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, manifold; xatlas is slow beyond some thousand faces
    seed : int
    options : dict, fields of xatlas.ChartOptions

    Returns
    -------
    chart_of_face : (m,) int64, 0 to k - 1; every chart is a disc

    Raises
    ------
    OptionError
        xatlas has no such option, or does not take the value.
    """
    import xatlas

    atlas = xatlas.Atlas()
    atlas.add_mesh(V.astype(np.float32), F.astype(np.uint32))
    packing = xatlas.PackOptions()
    packing.resolution = 256
    atlas.generate(chart_options=chart_options(options or {}), pack_options=packing)
    _, corners, _ = atlas[0]
    _, label = components(corners.astype(np.int64))
    return split(V, F, label, lambda faces: is_disc(F[faces]), seed)


def chart_options(given: dict[str, Any]) -> Any:
    """Make an xatlas.ChartOptions of keywords.

    Raises
    ------
    OptionError
        A name is unknown, or xatlas does not take the value.
    """
    import xatlas

    options = xatlas.ChartOptions()
    known = [name for name in dir(options) if not name.startswith("_") and name != "use_input_mesh_uvs"]
    for name, value in given.items():
        if name not in known:
            raise OptionError(
                f"xatlas-options: unknown name {name!r}", hint=f"xatlas knows {', '.join(known)}"
            )
        try:
            setattr(options, name, value)
        except TypeError:
            wanted = type(getattr(options, name)).__name__
            raise OptionError(f"xatlas-options: {name} can't be {value!r}", hint=f"give a {wanted}") from None
    return options
