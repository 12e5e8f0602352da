"""What the pipeline knows of a surface once it is cut into pieces."""

from dataclasses import dataclass

from meshjig.cells import CellMesh
from meshjig.mesh.measure import interpolate
from meshjig.mesh.types import Atlas, CutMesh, Floats, Ints, Knobs, Mesh, Outlines, Stitching

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
        return self.cut.parent if self.cells is None else self.cells.parent[self.cut.parent]

    def carried(self, X: Floats, surface: Mesh, cut: CutMesh) -> Floats:
        """Carry what belongs to vertices of the surface, (n, d), to those of a cut mesh of this atlas."""
        if self.cells is not None:
            X = interpolate(X, surface.F, self.cells.vertex_face, self.cells.vertex_bary)
        return interpolate(X, self.atlas.mesh.F, cut.vertex_face, cut.vertex_bary)


@dataclass(frozen=True)
class Parts:
    """The outer sheets of the pieces, with or without a gap between them."""

    cut: CutMesh
    piece_of_face: Ints  # (m,), negative in the gap
    discarded: float  # share of the area that the gap cut off from its piece
