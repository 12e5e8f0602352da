"""What pieces that reach through thin parts are cut from, and what the report says of them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from meshjig.layout.layout import Layout
from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.booleans import arrays
from meshjig.mesh.halfedges import edges, next_halfedge
from meshjig.mesh.measure import unit
from meshjig.mesh.mesh import Mesh
from meshjig.mesh.pieces import Pieces
from meshjig.mesh.rays import RayScene
from meshjig.mesh.types import CutMesh
from meshjig.pipeline.ground import Ground
from meshjig.solid import Shell
from meshjig.solid.carve_through import Rim, Sheet, Stock
from meshjig.solid.through import between_sides, past_far_side, wall_of_model
from meshjig.thin import ThroughParts, ways_through

__all__ = ["ThroughFacts", "solid_parts", "stock_of", "strays_on", "through_facts"]

_FILLED = 0.8  # of the way to another side: what is filled below a face belongs to its piece
_PAST = 2.0  # mm, that walls through go past the rim of what is laid out: flanks are as wide as that


def stock_of(
    ground: Ground, layout: Layout, cut: CutMesh, sheets: Shell, clearance: float
) -> tuple[Floats, Stock | None]:
    """Give the walls' directions at a cut's vertices, and what pieces that reach through are cut from.

    Parameters
    ----------
    ground : Ground
    layout : Layout, of its mesh
    cut : CutMesh, its own, or that with the gap where no piece reaches through
    sheets : Shell, of its surface
    clearance : float, mm

    Returns
    -------
    D : (n, 3) float64, mm
    stock : Stock, or None where no piece reaches through
    """
    thin = ground.thin
    D = layout.carried(sheets.D[ground.vertex], cut)
    if thin is None:
        return D, None
    outside = Mesh(sheets.outer, ground.surface.F)
    ways = ways_through(outside, thin.direction, thin.owns, thin.far, ground.limit)
    to_far = -ways.depth[:, None] * ways.direction
    plugged = ways.solid(*outside) & thin.owns & (thin.depth < ground.solid)
    wall = wall_of_model(outside, sheets.D, plugged, to_far)
    deep = past_far_side(sheets.D, ways.direction, ways.length, ways.free)
    V, deep = (layout.carried(X[ground.vertex], cut) for X in (sheets.outer, deep))
    reached = (ways.under(*outside) & thin.owns)[ground.faces_of(layout)]
    piece = ground.labels(layout)
    far = np.flatnonzero(thin.far)
    behind = _pieces_behind(ground, layout, thin, far)
    filled = plugged[ground.faces_of(layout)] & ~reached
    reaches = np.zeros(layout.stitching.n_pieces, bool)
    reaches[piece[(reached | filled) & (piece >= 0)]] = True
    plug = layout.carried(to_far[ground.vertex], cut)
    shells = (
        Sheet(V, cut.F, piece, _longer(D, clearance)),
        Sheet(V, cut.F[filled], piece[filled], _FILLED * plug),
        Sheet(outside.V, outside.F[far], behind, _longer(sheets.D, clearance)),
    )
    through = Sheet(V, cut.F[reached], piece[reached], deep)
    past = layout.carried(np.where(ways.length > 0, _PAST, 0.0)[ground.vertex, None], cut)[:, 0]
    return deep, Stock(Mesh(*arrays(wall)), reaches, _rim(ground, layout, thin), shells, through, past)


def solid_parts(ground: Ground, sheets: Shell) -> Mesh | None:
    """Give all that lies between both sides of parts that are cut through; None where there are none."""
    thin = ground.thin
    if thin is None:
        return None
    outside = Mesh(sheets.outer, ground.surface.F)
    ways = ways_through(outside, thin.direction, thin.owns, thin.far, ground.limit)
    owned = ways.under(*outside) & thin.owns
    return between_sides(outside, owned, -ways.length[:, None] * ways.direction) if owned.any() else None


def _rim(ground: Ground, layout: Layout, thin: ThroughParts) -> Rim:
    """List the edges of a cut where a far side meets what is thick, with the piece behind each."""
    F, face, label = layout.cut.F, ground.faces_of(layout), ground.labels(layout)
    twin = edges(F).twin
    h = np.arange(len(twin))
    beside = ground.surface.edges.twin.reshape(-1, 3) // 3
    at = beside[face]
    outside = np.where(thin.far[at] & ~np.isin(at, ground.face), at, -1).max(axis=1)
    far = np.where(twin == h, outside[h // 3], np.where(label[twin // 3] < 0, face[twin // 3], -1))
    h = np.flatnonzero((label[h // 3] >= 0) & (far >= 0) & ~thin.owns[face[h // 3]])
    behind = _pieces_behind(ground, layout, thin, far[h])
    return Rim(F.ravel()[h], F.ravel()[next_halfedge(h)], label[h // 3], behind)


def _pieces_behind(ground: Ground, layout: Layout, thin: ThroughParts, far: Ints) -> Ints:
    """Give the piece that reaches through to each of some faces of far sides."""
    owned = np.flatnonzero(thin.owns[ground.faces_of(layout)])
    V, F = layout.cut.V, layout.cut.F[owned]
    P = ground.surface.V[ground.surface.F[far]].mean(axis=1)
    hit = RayScene(V, F).first_face(P, thin.direction[far])
    missed = np.flatnonzero(hit < 0)
    if len(missed):
        import igl

        hit[missed] = igl.point_mesh_squared_distance(P[missed], V, F)[1]
    return np.asarray(layout.piece_of_face[owned[hit]])


def _longer(D: Floats, by: float) -> Floats:
    return D + by * unit(D)


@dataclass(frozen=True)
class ThroughFacts:
    """What the report says of parts that are cut through."""

    limit_mm: float  # thinner parts are cut through; 0 for none
    area_share: float  # of the model's surface, both sides
    thinnest_mm: float | None  # of these parts
    pieces: list[str]  # names of those that reach through


def through_facts(ground: Ground, pieces: Pieces, reaches: Bools) -> ThroughFacts:
    """Tell what is cut through.

    Parameters
    ----------
    ground : Ground
    pieces : Pieces
    reaches : (p,) bool, those that reach through
    """
    names = [name for name, reaching in zip(pieces.names, reaches, strict=True) if reaching]
    thin = ground.thin
    if thin is None or not names:
        return ThroughFacts(ground.limit, 0.0, None, [])
    area = ground.surface.areas
    share = float(area[thin.owns | thin.far].sum() / area.sum())
    return ThroughFacts(ground.limit, share, float(thin.depth[thin.owns].min()), names)


def strays_on(
    layout: Layout, V: Floats, solids: Sequence[Mesh], strays: Mapping[int, Sequence[Mesh]]
) -> list[Bools]:
    """Find the faces of a cut that lie on parts which came off of their pieces, a mask for each part.

    Parameters
    ----------
    layout : Layout
    V : (n, 3) float64, mm, where the vertices of its cut are
    solids : list of Mesh, by piece number
    strays : dict of meshes, by piece number
    """
    import igl

    P, masks = V[layout.cut.F].mean(axis=1), []
    for i, parts in strays.items():
        own = np.flatnonzero(layout.piece_of_face == i)
        far = [igl.point_mesh_squared_distance(P[own], X, F)[0] for X, F in (solids[i], *parts)]
        nearest = np.argmin(far, axis=0)
        for k in range(1, len(far)):
            mask = np.zeros(len(P), bool)
            mask[own[nearest == k]] = True
            if mask.any():
                masks.append(mask)
    return masks
