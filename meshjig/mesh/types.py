"""The plain data that passes between stages."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.mesh import Mesh
from meshjig.mesh.refinement import Refinement

__all__ = [
    "GAP",
    "UV_GRID",
    "Atlas",
    "Bools",
    "CutFacts",
    "CutMesh",
    "Floats",
    "Ints",
    "Knobs",
    "Mesh",
    "Outlines",
    "RegionGraph",
    "StitchFacts",
    "Stitching",
]

GAP = -1  # the label of faces that belong to no piece
UV_GRID = 2.0**-18  # mm; what repeats in the plane has coordinates that are multiples of it


@dataclass(frozen=True)
class Atlas:
    """A mesh cut into charts, each flattened to the plane in mm.

    All charts lie in one plane without touching each other. A vertex on a seam has one row in uv
    for every chart (or side of a cut) that it belongs to. A periodic chart is a ring cut open: the
    two sides of its closing line lie one period apart in the plane.
    """

    mesh: Mesh
    uv: Floats  # (k, 2), mm
    F_uv: Ints  # (m, 3), corners into uv
    chart_of_face: Ints  # (m,)
    facts: Mapping[str, Any] = field(default_factory=dict)  # the report's "charts"
    period: Floats | None = None  # (c,), mm along u after which a chart repeats; 0 where it does not

    @property
    def n_charts(self) -> int:
        """Count the charts."""
        return int(self.chart_of_face.max(initial=-1)) + 1


@dataclass(frozen=True)
class Outlines:
    """A planar graph of cuts: segments with a label on either side.

    Segments meet at shared points only. Every point has at least two segments: curves are closed,
    or end where other curves begin.
    """

    points: Floats  # (n, 2), mm
    segments: Ints  # (k, 2), into points
    left: Ints  # (k,), label on the left of a segment
    right: Ints  # (k,), label on its right
    same_point: Ints | None = None  # (n,), the first of the points that are one on a periodic chart
    same_segment: Ints | None = None  # (k,), the first of the segments that are one


@dataclass(frozen=True)
class Knobs:
    """Where the knobs are in a planar graph of cuts."""

    neck: Ints  # (k, 2), the points on either side of the neck
    head: Ints  # (k, 2), the points on either side of the head, where it is widest
    span: Ints  # (k, 2), first segment of the knob, and the one after its last
    edge: Ints | None = None  # (k,), which edge of the tiling has the knob; -1 for none


@dataclass(frozen=True)
class CutFacts:
    """What the overlay says of itself: the report's "cut"."""

    crossings: int
    zero_predicates: int  # answers that the symbolic shift gave
    ties: int  # crossings of one edge whose order was decided with exact numbers
    seam_merged: int  # vertices that cuts from both sides of a seam came to share
    respaced: int  # edges on which vertices were moved apart
    split_faces: int  # more faces, for outlines inside faces
    untangled: int  # parts of faces whose corners had to be moved
    steiner: int  # parts filled from their centre
    label_conflicts: int  # parts with an outline that says otherwise
    largest_part: int  # corners


@dataclass(frozen=True)
class CutMesh(Refinement):
    """A mesh whose faces were cut along outlines; it conforms, over seams too."""

    label: Ints  # (m,), the outlines' label
    region: Ints  # (m,), connected parts of one label, over seams too
    point_vertex: Ints  # (p,), the vertex made for a point of the outlines, or -1 where it missed the mesh
    cuts: Ints  # (c, 2), edges along the outlines, in the direction of their segment
    cut_segment: Ints  # (c,), the segment of the outlines
    cut_param: Floats  # (c, 2), where the edge starts and ends on its segment, 0 to 1
    facts: CutFacts | None = None


@dataclass(frozen=True)
class RegionGraph:
    """Regions of a cut surface and the borders between them."""

    area: Floats  # (r,), mm2
    pairs: Ints  # (b, 2), the regions on both sides, lower first; twice where they meet at seam and cut
    length: Floats  # (b,), mm
    seam: Bools  # (b,), the border is a chart border


@dataclass(frozen=True)
class StitchFacts:
    """What the report says of how regions became pieces; None for what was not done."""

    stitched: int = 0  # joins over seams
    tiny_merged: int = 0  # pieces that joined a neighbour
    tiny_left: int = 0  # pieces too small, without any neighbour
    poles: list[Any] | None = None  # how each was closed
    seam_borders: int | None = None  # borders that lie on seams
    seam_knobs: int | None = None  # those that have a knob now
    handed_over: int | None = None  # parts behind a neck that went to a neighbour
    parted: int | None = None  # those that became pieces


@dataclass(frozen=True)
class Stitching:
    """Which regions make which piece."""

    piece_of_region: Ints  # (r,)
    facts: StitchFacts = field(default_factory=StitchFacts)

    @property
    def n_pieces(self) -> int:
        """Count the pieces."""
        return int(self.piece_of_region.max(initial=-1)) + 1
