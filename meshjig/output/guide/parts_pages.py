"""The pages that say what there is: all pieces in outline, plate by plate."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import NamedTuple

import numpy as np

from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.boundary_loops import closed_loops
from meshjig.mesh.halfedges import border_halfedges, edge_keys, next_halfedge
from meshjig.mesh.measure import unit
from meshjig.output.guide.pages import BOTTOM, LEFT, RIGHT, TOP, Document, Page, text_width
from meshjig.output.guide.proxy import JoinedPieces
from meshjig.output.plates.pack import convex_ring, least_rectangle

__all__ = ["PieceOutline", "outlines", "parts_pages"]


_A_PAGE = 130  # pieces, that should do with one page
_SCALES = (1.0, 0.75, 0.6, 0.5, 0.45, 0.4, 0.38, 0.36, 0.33, 0.3, 0.25, 0.2, 0.15, 0.1)
_GAP, _CAPTION, _HEADING = 2.6, 4.0, 7.5  # mm
_SMALL = 6.0  # points
_FIRST = TOP + 4.0  # below the words on how large things are drawn

_FINE = 0.006  # of a piece's extent; drawn no finer


class _Spot(NamedTuple):
    """A piece or a heading on a page."""

    page: int
    x: float
    y: float
    piece: int  # counted from 0; -1 for a heading
    words: str


def parts_pages(shapes: Sequence[PieceOutline], plates: Sequence[int | None]) -> list[Page]:
    """Lay out the outlines of all pieces.

    Parameters
    ----------
    shapes : sequence of PieceOutline
    plates : sequence of int or None
        The plate that holds each piece; None where that is not known.

    Returns
    -------
    list of callables, each draws a page
    """
    wanted = -(-len(shapes) // _A_PAGE)
    spots: list[_Spot] = []
    scale = 1.0
    for scale in _SCALES:
        spots = _flow(shapes, plates, scale)
        if spots[-1].page < wanted:
            break
    n = spots[-1].page + 1
    return [partial(_draw, shapes, scale, [spot for spot in spots if spot.page == page]) for page in range(n)]


def _flow(shapes: Sequence[PieceOutline], plates: Sequence[int | None], scale: float) -> list[_Spot]:
    """Put pieces into columns of one width, row by row, under a heading for each plate."""
    sizes = np.array([shape.size for shape in shapes]) * scale
    least = text_width(f"{len(shapes)}", 8, strong=True) + text_width("100 × 100", _SMALL) + 1.5
    a_row = max(int((RIGHT - LEFT + _GAP) // (max(sizes[:, 0].max(), least) + _GAP)), 1)
    width = (RIGHT - LEFT + _GAP) / a_row
    spots: list[_Spot] = []
    page, y = 0, _FIRST
    for plate in sorted(set(plates), key=lambda plate: (plate is None, plate)):
        mine = [i for i, other in enumerate(plates) if other == plate]
        for k in range(0, len(mine), a_row):
            row = mine[k : k + a_row]
            heading = _HEADING if k == 0 else 0.0
            height = float(sizes[row, 1].max()) + _CAPTION
            if y + heading + height > BOTTOM and y > _FIRST:
                page, y = page + 1, _FIRST
            if k == 0:
                spots.append(_Spot(page, LEFT, y + 5, -1, _heading(plate, mine)))
            y += heading + height
            spots += [_Spot(page, LEFT + j * width, y, i, "") for j, i in enumerate(row)]
            y += _GAP
    return spots


def _heading(plate: int | None, mine: list[int]) -> str:
    count = f"{len(mine)} piece{'' if len(mine) == 1 else 's'}"
    return count if plate is None else f"Plate {plate}: {count}"


def _draw(shapes: Sequence[PieceOutline], scale: float, spots: Sequence[_Spot], document: Document) -> None:
    document.text(
        LEFT,
        TOP,
        f"Seen from outside, {_said(scale)}; below each, its number, and its length and width in mm.",
        8,
        grey=0.35,
    )
    for spot in spots:
        if spot.piece < 0:
            document.text(spot.x, spot.y, spot.words, 10, strong=True)
            continue
        shape = shapes[spot.piece]
        floor = spot.y - _CAPTION
        document.shape(shape.ring * (scale, -scale) + (spot.x, floor))
        number = str(spot.piece + 1)
        document.text(spot.x, spot.y - 1.2, number, 8, strong=True)
        size = " × ".join(f"{side:.0f}" for side in shape.size)
        document.text(
            spot.x + text_width(number, 8, strong=True) + 1.5, spot.y - 1.2, size, _SMALL, grey=0.35
        )


def _said(scale: float) -> str:
    return "in true size" if scale == 1 else f"at {100 * scale:.0f} % of true size"


class PieceOutline(NamedTuple):
    """What a piece looks like from outside."""

    ring: Floats  # (k, 2), mm, y up, from (0, 0) on, no higher than wide
    size: Floats  # (2,), width and height, mm


def outlines(joined: JoinedPieces) -> list[PieceOutline]:
    """Draw around every piece.

    Parameters
    ----------
    joined : JoinedPieces

    Returns
    -------
    list of PieceOutline
        The longest of the curves along which a piece turns away from the eye.
    """
    import shapely

    V, F, piece_of_vertex, outer, outward, _ = joined
    rings: list[Floats | None] = [None] * len(outward)
    for loop in _rims(F[outer], len(V)):
        piece = int(piece_of_vertex[loop[0]])
        ring, longest = V[loop] @ _plane(outward[piece]).T, rings[piece]
        if longest is None or _area(ring) > _area(longest):
            rings[piece] = ring
    made = []
    for piece, found in enumerate(rings):
        ring = V[piece_of_vertex == piece] @ _plane(outward[piece]).T if found is None else found
        fine = _FINE * float(np.ptp(ring, axis=0).max())
        made.append(_lying(shapely.get_coordinates(shapely.simplify(shapely.linearrings(ring), fine))[:-1]))
    return made


def _rims(F: Ints, n: int) -> list[Ints]:
    """List the borders of faces (m, 3) into n vertices as closed curves of vertices."""
    h = border_halfedges(F)
    ends = np.stack([F.ravel()[h], F.ravel()[next_halfedge(h)]], 1)
    start, end = ends[np.argsort(edge_keys(ends, n))].T
    return [start[loop] for loop in closed_loops(start, end) if len(loop) > 2]


def _area(ring: Floats) -> float:
    x, y = ring.T
    return abs(float(x @ np.roll(y, -1) - y @ np.roll(x, -1))) / 2


def _plane(outward: Floats) -> Floats:
    """The picture plane of an eye that looks against a direction: rows right and up, (2, 3)."""
    n = unit(outward)
    right = unit(np.cross(np.eye(3)[np.abs(n).argmin()], n))
    return np.stack([right, np.cross(n, right)])


def _lying(ring: Floats) -> PieceOutline:
    if _area(ring) == 0:
        return PieceOutline(ring, np.ptp(ring, axis=0))
    turn = least_rectangle(convex_ring(ring))
    cos, sin = np.cos(turn), np.sin(turn)
    ring = ring @ np.array([[cos, sin], [-sin, cos]])
    ring = ring - ring.min(axis=0)
    return PieceOutline(ring, ring.max(axis=0))
