"""One flattened chart, before it has a place in the plane of the atlas."""

from dataclasses import dataclass

from meshjig.mesh.halfedges import compact
from meshjig.mesh.types import Floats, Ints

__all__ = ["Chart", "Charting", "plain"]


@dataclass(frozen=True)
class Chart:
    """Faces of a mesh and where their corners lie in a plane of their own.

    Corners of one vertex lie apart where the chart is cut inside.
    """

    faces: Ints  # (k,), of the mesh
    uv: Floats  # (n, 2), mm
    corners: Ints  # (k, 3), into uv
    period: float = 0.0  # mm along u after which the chart repeats; 0 where it does not


@dataclass(frozen=True)
class Charting:
    """Charts that cover a mesh, and how they came about."""

    charts: list[Chart]
    method: str
    leaf: Ints | None = None  # (m,), the chart that a face was in before charts were glued
    note: str = ""  # why another method was not used


def plain(F: Ints, faces: Ints, uv: Floats) -> Chart:
    """Make a chart without cuts inside.

    Parameters
    ----------
    F : (m, 3) int64, the mesh
    faces : (k,) int64
    uv : (n, 2) float64, of the vertices that compact(F[faces]) keeps
    """
    return Chart(faces, uv, compact(F[faces])[0])
