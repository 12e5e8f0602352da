"""Some pieces of a layout cut once more."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from meshjig.cut import ComposedCut, compose_cuts
from meshjig.layout.layout import Layout
from meshjig.mesh.types import CutMesh, Ints

__all__ = ["recut"]


def recut(
    layout: Layout, chosen: Ints, kept: Ints, second: CutMesh, piece_of_label: Ints
) -> tuple[Layout, ComposedCut]:
    """Take a further cut of some faces into a layout.

    Parameters
    ----------
    layout : Layout
    chosen : (k,) int64, faces of its cut mesh
    kept : (v,) int64, their vertices
    second : CutMesh, of these faces
    piece_of_label : (l,) int64, the piece that faces of the second cut belong to by their label

    Returns
    -------
    Layout
        Its knobs are those of the layout that was given.
    ComposedCut
        How the second cut was taken in.
    """
    further = compose_cuts(layout.atlas, layout.outlines, layout.cut, chosen, kept, second)
    label = np.zeros(int(second.region.max(initial=-1)) + 1, np.int64)
    label[second.region] = second.label
    known = layout.stitching.piece_of_region[: int(layout.cut.region.max(initial=-1)) + 1]
    stitching = replace(layout.stitching, piece_of_region=np.concatenate([known, piece_of_label[label]]))
    return replace(layout, outlines=further.outlines, cut=further.cut, stitching=stitching), further
