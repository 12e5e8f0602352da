"""Everything that outlines do to a sheet: cross it, land in it, run through it."""

from typing import NamedTuple

from meshjig.cut.broad_phase import make_cells
from meshjig.cut.edge_crossings import Crossings, cross
from meshjig.cut.face_segments import Links, follow
from meshjig.cut.point_hits import Landings, locate
from meshjig.cut.snap import Graph
from meshjig.cut.uv_mesh import Sheet

__all__ = ["Trace", "trace"]


class Trace(NamedTuple):
    """The stops of outlines on a sheet, and the links between them."""

    crossings: Crossings
    landings: Landings
    links: Links


def trace(sheet: Sheet, graph: Graph) -> Trace:
    """Follow outlines over a sheet.

    Raises
    ------
    CutError
        An outline ends inside the mesh.
    """
    a, b = graph.points[graph.segments[:, 0]], graph.points[graph.segments[:, 1]]
    cells, around = make_cells(sheet.U, sheet.S, a, b)
    crossings = cross(sheet, graph, cells, around)
    landings = locate(sheet, graph, cells)
    return Trace(crossings, landings, follow(sheet, graph, crossings, landings))
