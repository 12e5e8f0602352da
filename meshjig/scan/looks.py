"""What groups of faces show, put together for all."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from meshjig.mesh.arrays import Ints
from meshjig.scan.join import join
from meshjig.scan.source import Look, Source

__all__ = ["together"]


def together(groups: Sequence[tuple[Ints, Look]]) -> Look:
    """Give the look of a mesh whose faces are in groups that each show something of their own.

    Parameters
    ----------
    groups : sequence of (faces (k,) int64, Look), with each face of the mesh in one of them

    Returns
    -------
    Look
        As `join` makes it of several meshes: pictures side by side in one.
    """
    order = np.concatenate([faces for faces, _ in groups]) if groups else np.zeros(0, np.int64)
    no_vertices = np.zeros((0, 3))
    look = join([Source(no_vertices, np.zeros((len(f), 3), np.int64), shown) for f, shown in groups]).look
    place = np.empty(len(order), np.int64)
    place[order] = np.arange(len(order))
    return Look(
        None if look.rgb is None else look.rgb[place],
        None if look.uv is None else look.uv[place],
        look.picture,
    )
