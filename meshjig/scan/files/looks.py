"""What groups of faces show, put together for all."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from meshjig.mesh.arrays import Ints
from meshjig.scan.files.join import join
from meshjig.scan.files.surface import Surface
from meshjig.scan.source import Look, Source

__all__ = ["corner_colours", "together"]


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
    return look.of(place)


def corner_colours(
    made: Surface, of_polygons: NDArray[np.uint8] | None, of_vertices: NDArray[np.uint8] | None
) -> NDArray[np.uint8] | None:
    """Give the colours of corners of triangles, (m, 3, 3): those of polygons before those of vertices.

    One colour of all polygons gives way to several of vertices: programs fill in white for what they lack.

    Parameters
    ----------
    made : Surface
    of_polygons : (p, 3) uint8, or None
    of_vertices : (n, 3) uint8, or None
    """
    if of_polygons is not None and (of_vertices is None or not _is_one(of_polygons) or _is_one(of_vertices)):
        return np.repeat(of_polygons[made.polygon][:, None], 3, axis=1)
    return None if of_vertices is None else of_vertices[made.F]


def _is_one(colours: NDArray[np.uint8]) -> bool:
    return bool((colours == colours[:1]).all())
