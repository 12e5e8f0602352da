"""The surface that is laid out in pieces: a model's without the far sides of what is cut through."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from meshjig.layout.layout import Layout
from meshjig.mesh.arrays import Ints
from meshjig.mesh.components import components, fans
from meshjig.mesh.halfedges import edges
from meshjig.mesh.measure import face_areas, sums
from meshjig.mesh.mesh import Mesh
from meshjig.options import Options
from meshjig.thin import ThroughParts, large_parts, through_parts

__all__ = ["Ground", "limit_asked", "limit_of", "surface_to_lay_out", "why_not_through"]

_BELOW = 1.0  # mm, than the limit: thinner parts are solid; between that and the limit there is a hollow
_LARGE = 0.25  # of a piece: smaller far sides are laid out with the rest, else cells would be rings
_KEPT, _CRUMB = 0.5, 0.02  # of a piece: what it must keep in one part, and what may come off


def limit_of(options: Options) -> float:
    """Give the thickness below which parts are cut through, mm; 0 for never."""
    return 0.0 if options.through == "off" or why_not_through(options) else limit_asked(options)


def limit_asked(options: Options) -> float:
    """Give the same as it was asked for, whether other options let parts be cut through or not."""
    if options.through == "off":
        return 0.0
    least = 2 * options.min_wall + options.clearance  # below it two walls can't be made
    return least if options.through == "auto" else max(options.through, least)


def why_not_through(options: Options) -> str | None:
    """Say which option keeps parts from being cut through, and which would let them be; None if none does."""
    if options.side == "out":
        return "--side out puts the walls outside of it; --side in cuts it through"
    if options.clearance == 0:
        return "--clearance 0 leaves no gap; a larger one cuts it through"
    if options.clearance_method != "solid":
        method = options.clearance_method
        return f"--clearance-method {method} lays the gap out in the plane; solid cuts it through"
    return None


@dataclass(frozen=True)
class Ground:
    """The part of a surface that is laid out in pieces: all but the far sides of thin parts."""

    surface: Mesh
    mesh: Mesh
    vertex: Ints  # (n,), the vertex of the surface that each is
    face: Ints  # (m,), the face of the surface that each is
    thin: ThroughParts | None
    limit: float  # mm
    solid: float  # mm; parts thinner than that have no hollow

    def faces_of(self, layout: Layout) -> Ints:
        """Give the face of the surface that every face of a layout's cut lies in, (k,)."""
        return self.face[layout.face_of_surface]

    def whole(self) -> Ground:
        """Lay out far sides, too, and take them away afterwards, as small ones are."""
        V, F = self.surface
        return replace(self, mesh=self.surface, vertex=np.arange(len(V)), face=np.arange(len(F)))

    def labels(self, layout: Layout) -> Ints:
        """Give the piece of every face of a layout's cut, (m,); -1 on far sides that were laid out."""
        piece = layout.piece_of_face
        return piece if self.thin is None else np.where(self.thin.far[self.faces_of(layout)], -1, piece)

    def sparing(self, layout: Layout) -> Ground:
        """Cut nothing through where a piece would lose most of its surface by it, or come apart."""
        if self.thin is None:
            return self
        surface, face, piece = self.surface, self.faces_of(layout), layout.piece_of_face
        far = self.thin.far & np.isin(np.arange(len(surface.F)), self.face)
        left = np.where(far[face], -1, piece)
        area, n = face_areas(layout.cut.V, layout.cut.F), layout.stitching.n_pieces
        whole = sums(piece, area, n)
        twin = edges(layout.cut.F).twin
        wall = np.repeat(left, 3) != left[twin // 3]
        n_parts, part = components(layout.cut.F, wall, twin)
        size = np.bincount(part, area, n_parts)
        largest = np.zeros(n)
        kept = left >= 0
        np.maximum.at(largest, left[kept], size[part[kept]])
        spoilt = largest < np.minimum(_KEPT * whole, sums(left[kept], area[kept], n) - _CRUMB * whole)
        lost = np.zeros(len(surface.F), bool)
        lost[face[far[face] & spoilt[piece]]] = True
        surface_wall = np.repeat(far, 3) != far[surface.edges.twin // 3]
        number = components(surface.F, surface_wall, surface.edges.twin)[1]
        far = self.thin.far & ~(far & np.isin(number, number[lost]))
        return replace(self, thin=self.thin._replace(far=far))


def surface_to_lay_out(surface: Mesh, options: Options) -> Ground:
    """Leave out the far sides of parts that are to be cut through.

    Parameters
    ----------
    surface : Mesh
    options : Options
    """
    limit, found = limit_of(options), None
    if limit > 0:
        outside = options.thickness if options.side == "both" else 0.0  # what the outer sheet adds
        certain = 2 * options.min_wall + options.clearance
        found = through_parts(surface, limit - outside, certain - outside)
    if found is None or found[1].far.all():  # as where walls are thicker than the model
        return Ground(
            surface, surface, np.arange(len(surface.V)), np.arange(len(surface.F)), None, limit, limit
        )
    surface, thin = found
    area = options.piece_size**2 if options.piece_size else float(surface.areas.sum()) / options.pieces
    face = np.flatnonzero(~large_parts(surface, thin.far, _LARGE * area))
    F, vertex = fans(surface.F[face])
    solid = max(limit - _BELOW, min(limit, 2 * options.thickness))
    return Ground(surface, Mesh(surface.V[vertex], F), vertex, face, thin, limit, solid)
