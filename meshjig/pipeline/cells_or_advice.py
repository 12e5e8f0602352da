"""The layout of cells; where a surface has none, what was found to help."""

from __future__ import annotations

from meshjig.cells import grow_cells
from meshjig.errors import CutError, OptionError
from meshjig.layout.cells import cell_layout
from meshjig.layout.layout import Layout
from meshjig.mesh.halfedges import border_halfedges
from meshjig.mesh.types import Floats, Mesh
from meshjig.options import Options
from meshjig.pipeline.ground import Ground
from meshjig.pipeline.preflight import refuse_too_small_pieces
from meshjig.runtime.progress import Stages

__all__ = ["cells_on", "cells_or_advice", "refuse_cells"]

_MORE = (2, 4, 8)  # times as many pieces, which are tried
_MOST = 400  # pieces that are tried: more take longer than a maker wants to wait for a refusal


def cells_or_advice(surface: Mesh, options: Options, stages: Stages, up: Floats | None = None) -> Layout:
    """Cut a surface into cells with knobs.

    Parameters
    ----------
    surface : Mesh
    options : Options
    stages : Stages

    Raises
    ------
    CutError
        Some cells are no discs; "ask for more pieces" is said only where as many were found to do.
    """
    try:
        return cell_layout(surface, options, stages, up)
    except CutError as error:
        with stages("advice"):
            raise refuse_cells(error, surface, options) from None


def cells_on(
    ground: Ground, options: Options, stages: Stages, up: Floats | None = None
) -> tuple[Ground, Layout]:
    """Cut a surface into cells, without the far sides of thin parts where that can be.

    Returns
    -------
    ground : Ground, with its far sides where cells would be no discs without them
    layout : Layout, of it
    """
    if ground.mesh is ground.surface:
        return ground, cells_or_advice(ground.mesh, options, stages, up)
    try:
        return ground, cell_layout(ground.mesh, options, stages, up)
    except CutError:
        ground = ground.whole()
        return ground, cells_or_advice(ground.mesh, options, stages, up)


def refuse_cells(error: CutError, surface: Mesh, options: Options) -> CutError:
    """Give the error of cells that are no discs, with what was found to help."""
    enough = _enough(surface, options)
    if enough:
        hint = f"ask for {enough} pieces, which do"
    elif not len(border_halfedges(surface.F)):
        hint = "make its surface anew with --resurface"
    else:
        hint = "more pieces do not help; smooth and remesh it in a mesh editor, such as MeshLab"
    return CutError(error.message, hint=hint, ids=error.ids)


def _enough(surface: Mesh, options: Options) -> int | None:
    """Give a number of pieces for which all cells are discs, of those that their knobs allow."""
    area = float(surface.areas.sum())
    n = max(1, round(area / options.piece_size**2)) if options.piece_size else options.pieces
    for more in (k * n for k in _MORE if k * n <= _MOST):
        try:
            refuse_too_small_pieces((area / more) ** 0.5, area, options)
            grow_cells(
                surface, more, seed=options.seed, style=options.style, crease_aware=options.crease_aware
            )
        except OptionError:
            return None
        except CutError:
            continue
        return more
    return None
