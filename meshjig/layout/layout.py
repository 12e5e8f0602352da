"""What the pipeline knows of a surface once it is cut into pieces."""

from dataclasses import dataclass

from meshjig.cells import CellMesh
from meshjig.mesh.refinement import Refinement, unrefined
from meshjig.mesh.types import Atlas, CutMesh, Floats, Ints, Knobs, Outlines, Stitching

__all__ = ["Layout", "Parts"]


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
