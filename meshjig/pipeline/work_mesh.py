"""The surface that a puzzle is cut from: a clean scan whose edges are short beside a piece."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from meshjig.charts import MappedAtlas
from meshjig.errors import InputError
from meshjig.mesh.halfedges import border_halfedges
from meshjig.mesh.measure import face_areas
from meshjig.mesh.subdivide import refine_atlas, refine_long_edges
from meshjig.mesh.types import Mesh
from meshjig.options import Options
from meshjig.pipeline.ground import Ground
from meshjig.pipeline.preflight import piece_size, refuse_small_plate, refuse_too_small_pieces
from meshjig.pipeline.prepare import chart
from meshjig.scan import Scan

__all__ = ["work_atlas", "work_mesh"]

MUCH_FINER = 1.1  # times as many faces: more freedom for charts

_NEEDLE = 1000.0  # times as long as wide
_MOST_NEEDLES = 0.05  # of the faces; meshes that people model or scan have none
_FEW = 20_000  # faces, of which even needles do no harm


def work_mesh(mesh: Mesh, options: Options) -> tuple[Mesh, float]:
    """Split the edges of a clean scan until no piece can fall inside a single face.

    Parameters
    ----------
    mesh : Mesh
    options : Options

    Returns
    -------
    mesh : Mesh
    longest : float, mm, a quarter of a piece, which no edge exceeds

    Raises
    ------
    OptionError
        Pieces are too small for their clearance, or too large for the plate.
    InputError
        Much of the mesh is needles: what follows would take hours, and fail.
    """
    size = piece_size(mesh, options)
    refuse_too_small_pieces(size, float(mesh.areas.sum()), options)
    refuse_small_plate(size, options)
    _refuse_needles(mesh, size / 4)  # before they become too many to split at all
    surface = Mesh(*refine_long_edges(mesh.V, mesh.F, size / 4))
    _refuse_needles(surface, size / 4)
    return surface, size / 4


def work_atlas(scan: Scan, ground: Ground, longest: float, options: Options) -> MappedAtlas:
    """Chart what is laid out of a surface; before it was refined, where that makes little difference to it.

    So a few long edges don't change the charts that `info` has shown.
    """
    if ground.thin is not None or len(ground.mesh.F) > MUCH_FINER * len(scan.mesh.F):
        return chart(replace(scan, mesh=ground.mesh), options)
    return refine_atlas(chart(scan, options), longest)


def _refuse_needles(mesh: Mesh, length: float) -> None:
    """Refuse a mesh of which many faces are needles once no edge is longer than a length, mm."""
    corner = mesh.V[mesh.F]
    longest = np.sqrt(((corner - corner[:, [1, 2, 0]]) ** 2).sum(2).max(1))
    width = 2 * face_areas(mesh.V, mesh.F) / longest
    needle = np.minimum(longest, length) > _NEEDLE * width
    faces = np.ceil(longest / length)  # that each becomes, about
    share = float(faces[needle].sum() / faces.sum())
    if share <= _MOST_NEEDLES or faces.sum() < _FEW:
        return
    first = ", ".join(f"{x:.0f}" for x in corner[needle][0].mean(0))
    closed = not len(border_halfedges(mesh.F))
    raise InputError(
        f"{100 * share:.0f} % of the faces of this mesh are needles, over {_NEEDLE:g} times as long as wide "
        f"(the first around ({first}) mm), and can't be cut",
        hint="use --resurface, which makes all faces anew"
        if closed
        else "remesh it evenly in a mesh editor, such as MeshLab",
    )
