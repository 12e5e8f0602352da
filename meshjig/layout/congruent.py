"""Which borders and pieces could be taken for one another, and which knobs to draw again for it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from meshjig.cut import merge_periodic
from meshjig.layout.layout import Layout
from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.chains import follow
from meshjig.mesh.halfedges import edge_keys, edges, next_halfedge
from meshjig.mesh.types import CutMesh, Knobs

__all__ = [
    "LEAST_DIFFERENCE",
    "Border",
    "UniqueFacts",
    "borders",
    "clashes",
    "congruent_borders",
    "interchangeable",
]

_POINTS = 24  # on each curve; the knob of a border has several of them
_BATCH = 20_000  # pairs of curves compared at once
LEAST_DIFFERENCE = 0.1  # mm by which borders must differ where no clearance is asked for


class Border(NamedTuple):
    """A stretch of a piece's rim along one neighbour, the piece on its left."""

    piece: int
    neighbour: int  # -1 along an open border
    halfedges: Ints  # (k,), of the cut mesh, in order


def borders(cut: CutMesh, piece_of_face: Ints) -> list[list[Border]]:
    """Divide the rim of every piece where its neighbour changes.

    Parameters
    ----------
    cut : CutMesh, cut at zero width
    piece_of_face : (m,) int64

    Returns
    -------
    list, a list for every piece of its borders in order; those of a piece with several rims one rim
    after another
    """
    corner, n = cut.F.ravel(), len(cut.V)
    twin = edges(cut.F).twin
    h = np.arange(len(twin))
    piece = np.repeat(piece_of_face, 3)
    beyond = np.where(twin == h, -1, piece[twin])
    rim = np.flatnonzero(piece != beyond)
    start, end = (piece[rim] * n + corner[k] for k in (rim, next_halfedge(rim)))
    order = np.argsort(start, kind="stable")
    following = order[np.searchsorted(start[order], end, side="right") - 1]
    found: list[list[Border]] = [[] for _ in range(int(piece_of_face.max(initial=-1)) + 1)]
    seen: set[int] = set()
    after = following.tolist()
    for row in (follow(after, first, seen) for first in range(len(after)) if first not in seen):
        loop = rim[row]  # that of a pinched rim may end in a loop met before
        across = beyond[loop]
        change = np.flatnonzero(across != np.roll(across, 1))
        loop = np.roll(loop, -int(change[0])) if len(change) else loop
        change = change - change[0] if len(change) else np.zeros(1, np.int64)
        mine = found[int(piece[loop[0]])]
        for run in np.split(loop, change[1:]):
            mine.append(Border(int(piece[run[0]]), int(beyond[run[0]]), run))
    return found


def congruent_borders(
    cut: CutMesh, of_piece: list[list[Border]], tolerance: float
) -> list[tuple[Border, Border]]:
    """List pairs of borders between pieces of which one could stand in the other's place.

    Parameters
    ----------
    cut : CutMesh
    of_piece : as `borders` gives them
    tolerance : float, mm; how far curves may stay apart everywhere after a rigid motion

    Returns
    -------
    list of pairs; each border comes once, from the side of its lower piece
    """
    whole = [b for bs in of_piece for b in bs if b.neighbour > b.piece]
    curves = np.array([_curve(cut, [b])[0] for b in whole]).reshape(-1, _POINTS, 3)
    turned = curves[:, ::-1]
    length = np.array([_length(curve) for curve in curves])
    i, j = _near(length, tolerance * _POINTS / 8)
    alike = _meet(curves[i], curves[j], tolerance) | _meet(curves[i], turned[j], tolerance)
    return [(whole[a], whole[b]) for a, b in zip(i[alike].tolist(), j[alike].tolist(), strict=True)]


def interchangeable(cut: CutMesh, of_piece: list[list[Border]], tolerance: float) -> list[tuple[int, int]]:
    """List pairs of pieces of which each fits where the other belongs.

    Their whole rims come together by a rigid motion, corner on corner. Pieces with several rims are
    taken to be unlike all others.

    Parameters
    ----------
    cut, of_piece, tolerance : see `congruent_borders`

    Returns
    -------
    list of (piece, piece), lower first
    """
    rims: dict[int, list[tuple[int, Floats]]] = {}
    for piece, bs in enumerate(of_piece):
        if bs:
            rims.setdefault(len(bs), []).append((piece, _curve(cut, bs)))
    pairs = []
    for n, group in rims.items():
        names, curves = [name for name, _ in group], np.array([curve for _, curve in group])
        length = np.array([[_length(side) for side in curve] for curve in curves])
        i, j = _near(length.sum(1), n * tolerance * _POINTS / 8)
        alike = np.zeros(len(i), bool)
        for turn in range(n):
            sides = np.roll(curves, turn, axis=1)
            close = np.abs(length[i] - np.roll(length, turn, axis=1)[j]).max(1) < tolerance * _POINTS / 8
            k = np.flatnonzero(close & ~alike)
            points = (len(k), n * _POINTS, 3)
            alike[k] = _meet(curves[i[k]].reshape(points), sides[j[k]].reshape(points), tolerance)
        pairs += [(names[a], names[b]) for a, b in zip(i[alike].tolist(), j[alike].tolist(), strict=True)]
    return sorted(pairs)


def _curve(cut: CutMesh, run: list[Border]) -> Floats:
    """Spread points evenly along each border, (borders, _POINTS, 3)."""
    corner = cut.F.ravel()
    sides = []
    for border in run:
        h = border.halfedges
        points = cut.V[np.append(corner[h], corner[next_halfedge(h[-1:])])]
        arc = np.append(0.0, np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1)))
        at = np.linspace(0, arc[-1], _POINTS)
        sides.append(np.stack([np.interp(at, arc, points[:, k]) for k in range(3)], 1))
    return np.array(sides)


def _length(curve: Floats) -> float:
    return float(np.linalg.norm(np.diff(curve, axis=0), axis=1).sum())


def _near(value: Floats, within: float) -> tuple[Ints, Ints]:
    """List pairs i < j of nearly equal values."""
    i, j = np.nonzero(np.triu(np.abs(value[:, None] - value) <= within, 1))
    return i, j


def _meet(a: Floats, b: Floats, tolerance: float) -> np.ndarray:
    """Tell which curves of a (k, n, 3) come within the tolerance of those of b by a rigid motion.

    References
    ----------
    Kabsch, "A solution for the best rotation to relate two sets of vectors", 1976.
    """
    met = np.zeros(len(a), bool)
    for start in range(0, len(a), _BATCH):
        part = slice(start, start + _BATCH)
        x = a[part] - a[part].mean(1, keepdims=True)
        y = b[part] - b[part].mean(1, keepdims=True)
        U, _, Wt = np.linalg.svd(np.einsum("kni,knj->kij", x, y))
        U[..., -1] *= np.sign(np.linalg.det(U @ Wt))[:, None]  # a rotation, never a mirror
        met[part] = np.linalg.norm(x @ (U @ Wt) - y, axis=2).max(1) <= tolerance
    return met


@dataclass(frozen=True)
class UniqueFacts:
    """What the report says of what could be taken for one another."""

    congruent_borders: int  # pairs
    interchangeable_pieces: int  # pairs


def clashes(layout: Layout, tolerance: float) -> tuple[Ints, UniqueFacts]:
    """Find borders that look alike.

    Parameters
    ----------
    layout : Layout
    tolerance : float, mm

    Returns
    -------
    edges : (k,) int64, as Knobs.edge counts them: drawn again, their borders would be unlike the rest
    facts : UniqueFacts
    """
    cut = merge_periodic(layout.cut, layout.outlines)
    rims = borders(cut, layout.piece_of_face)
    alike = congruent_borders(cut, rims, tolerance)
    swaps = interchangeable(cut, rims, tolerance)
    facts = UniqueFacts(len(alike), len(swaps))
    found = _edges_on([b for _, b in alike], cut, layout.knobs)
    return found, facts


def _edges_on(of: list[Border], cut: CutMesh, knobs: Knobs) -> Ints:
    """List the edges of the tiling whose knobs lie on some borders."""
    if not of or knobs.edge is None or not len(knobs.edge):
        return np.zeros(0, np.int64)
    n, corner = len(cut.V), cut.F.ravel()
    h = np.concatenate([border.halfedges for border in of])
    on_border = np.isin(
        edge_keys(cut.cuts, n), edge_keys(np.stack([corner[h], corner[next_halfedge(h)]], 1), n)
    )
    segment = np.zeros(max(int(cut.cut_segment.max(initial=0)), int(knobs.span.max())) + 2, np.int64)
    segment[cut.cut_segment[on_border]] = 1
    before = np.concatenate([[0], np.cumsum(segment)])
    found = np.unique(knobs.edge[before[knobs.span[:, 1]] > before[knobs.span[:, 0]]])
    return found[found >= 0]
