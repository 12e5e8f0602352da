"""What the pipeline knows of a surface once it is cut into pieces."""

from dataclasses import dataclass

from meshjig.types import CutMesh, Ints, Knobs, Outlines, Stitching

__all__ = ["Layout", "Parts"]


@dataclass(frozen=True)
class Layout:
    """A surface cut into pieces at zero width."""

    outlines: Outlines
    knobs: Knobs
    cut: CutMesh
    stitching: Stitching

    @property
    def piece_of_face(self) -> Ints:
        """The piece of every face of the cut mesh, (m,) int64."""
        return self.stitching.piece_of_region[self.cut.region]


@dataclass(frozen=True)
class Parts:
    """The outer sheets of the pieces, with or without a gap between them."""

    cut: CutMesh
    piece_of_face: Ints  # (m,), negative in the gap
    discarded: float  # share of the area that the gap cut off from its piece
