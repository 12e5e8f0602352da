"""What the pipeline knows of a surface once it is cut into pieces; and some pieces cut once more."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from meshjig.cells import CellMesh
from meshjig.cut import ComposedCut, compose_cuts
from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.refinement import Refinement, unrefined
from meshjig.mesh.types import Atlas, CutMesh, Knobs, Outlines, Stitching

__all__ = ["Layout", "Parts", "affected_pieces", "cut_again"]


@dataclass(frozen=True)
class Layout:
    """A surface cut into pieces at zero width."""

    atlas: Atlas
    outlines: Outlines
    knobs: Knobs
    cut: CutMesh
    stitching: Stitching
    cells: CellMesh | None = None  # where the atlas is of a refined mesh: how that lies on the surface

    @property
    def piece_of_face(self) -> Ints:
        """The piece of every face of the cut mesh, (m,) int64."""
        return self.stitching.piece_of_region[self.cut.region]

    @property
    def face_of_surface(self) -> Ints:
        """The face of the surface that every face of the cut mesh lies in, (m,) int64."""
        return self.refinement.parent[self.cut.parent]

    @property
    def refinement(self) -> Refinement:
        """How the mesh of the atlas lies on the surface."""
        return unrefined(self.atlas.mesh) if self.cells is None else self.cells

    def carried(self, X: Floats, cut: CutMesh) -> Floats:
        """Carry what belongs to vertices of the surface, (n, d), to those of a cut mesh of this atlas."""
        return cut.carry(self.refinement.carry(X))


@dataclass(frozen=True)
class Parts:
    """The outer sheets of the pieces, with or without a gap between them."""

    cut: CutMesh
    piece_of_face: Ints  # (m,), negative in the gap
    discarded: float  # share of the area that the gap cut off from its piece


def cut_again(
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


def affected_pieces(pairs: Ints, parent: Ints, piece_of_face: Ints) -> set[int]:
    """Give the pieces that hold a part of a face that crossed another before anything was cut.

    A piece cannot be cleaner than the surface it is made of: where that passes through itself, so do the
    pieces, or two of them share space.

    Parameters
    ----------
    pairs : (k, 2) int64, faces of the uncut surface that cross
    parent : (m,) int64, for each face of the cut surface, the uncut one that it is a part of
    piece_of_face : (m,) int64, of the cut surface, negative where a face belongs to no piece

    Returns
    -------
    set of int, pieces; proven for exactly these pairs: a face is touched when it is named in one of them
    """
    crossing = np.zeros(int(max(parent.max(initial=-1), pairs.max(initial=-1))) + 1, bool)
    crossing[pairs] = True
    return set(np.unique(piece_of_face[crossing[parent] & (piece_of_face >= 0)]).tolist())
