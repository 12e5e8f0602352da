"""How well neighbouring pieces hold each other: knobs, necks, heads and undercuts, measured in space."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from meshjig.layout.congruent import borders
from meshjig.mesh.arrays import Bools, Floats, Ints, ranks, row_of
from meshjig.mesh.halfedges import edge_keys, edges, next_halfedge
from meshjig.mesh.measure import area_vectors, sums, unit
from meshjig.mesh.types import CutMesh, Knobs

__all__ = ["Interlock", "interlock", "undercuts"]

TOUCH = 3.0  # clearances; borders up to that length count as corners
SHORT = 30.0  # clearances; longer borders don't lie between others all along
DIRECTIONS = 72  # in which two pieces are pulled apart
_TURN = 2 * np.pi * np.arange(DIRECTIONS) / DIRECTIONS


@dataclass(frozen=True)
class Interlock:
    """The borders between pieces and the knobs on them."""

    pairs: Ints  # (b, 2), neighbouring pieces, lower first
    length: Floats  # (b,), mm of border between them
    knobs_of_pair: Ints  # (b,), whole knobs on that border
    knob_pair: Ints  # (k,), the pair that a whole knob joins, as a row of pairs
    head: Floats  # (k,), width of a whole knob's head, mm
    neck: Floats  # (k,), width of its neck, mm

    border: Floats  # (e, 2, 3), mm, the straight parts of all borders
    pair_of_border: Ints  # (e,), the pair that each divides, as a row of pairs
    cut: CutMesh
    piece_of_face: Ints  # (m,)

    @cached_property
    def undercut(self) -> Floats:
        """Give by how much two neighbours hold on to each other whichever way they are pulled, (b,), mm."""
        return undercuts(self.cut, self.piece_of_face, self.pairs)

    def locked(self, clearance: float) -> Bools:
        """Tell which pairs interlock, (b,): by a whole knob, or by an undercut that outdoes the gap."""
        return (self.knobs_of_pair > 0) | (self.undercut > clearance)

    def interlocked_borders(self, clearance: float) -> float | None:
        """Share of the borders that interlock."""
        return float(self.locked(clearance).mean()) if len(self.pairs) else None

    def interlocked_length(self, clearance: float) -> float | None:
        """Share of the length of all borders that belongs to borders that interlock."""
        total = float(self.length.sum())
        return float(self.length[self.locked(clearance)].sum()) / total if total > 0 else None

    def faces_other(self, clearance: float, min_wall: float = 0.0) -> Bools:
        """Tell which pairs face each other over a gap, (b,); others share no more than a corner.

        A border of a few clearances is swallowed by the gaps of the pieces at its ends. One that lies
        between two others all along is so by the gaps of those, or else what they leave of the pieces there
        is no wall that the process can make.
        """
        facing = self.length > TOUCH * clearance
        short = np.flatnonzero(facing & (self.length < SHORT * clearance))
        if not len(short):
            return facing
        points, of_pair = _points_along(self.border, self.pair_of_border, clearance / 4)
        reach = max(TOUCH * clearance, min_wall) / 2
        for k in short.tolist():
            own = points[of_pair == k]
            near = (points >= own.min(0) - reach).all(1) & (points <= own.max(0) + reach).all(1)
            others = points[near & (of_pair != k)]
            apart = np.linalg.norm(own[:, None] - others, axis=2).min(1, initial=np.inf)
            facing[k] = apart.max() > reach
        return facing

    def thin_necked(self, least: float) -> list[int]:
        """List the pieces with a knob, their own or the other's in them, whose neck is narrower, mm."""
        return np.unique(self.pairs[self.knob_pair[self.neck < least]]).tolist()


def interlock(cut: CutMesh, knobs: Knobs, piece_of_face: Ints) -> Interlock:
    """Find the borders between pieces, and the knobs that are whole.

    A knob is whole when its curve lies on the surface from one side of the neck to the other, with
    the same two pieces on its sides all along. Head and neck are straight distances in space between
    points of the cut.

    Parameters
    ----------
    cut : CutMesh, cut at zero width
    knobs : Knobs
    piece_of_face : (m,) int64
    """
    n = len(cut.V)
    e = edges(cut.F)
    h = np.flatnonzero(e.twin > np.arange(len(e.twin)))
    sides = np.sort(np.stack([piece_of_face[h // 3], piece_of_face[e.twin[h] // 3]], 1), axis=1)
    border = sides[:, 0] != sides[:, 1]
    ends, sides = e.E[e.edge_of_halfedge[h[border]]], sides[border]
    n_pieces = np.int64(piece_of_face.max(initial=0)) + 1
    keys, pair_of_edge = np.unique(sides[:, 0] * n_pieces + sides[:, 1], return_inverse=True)
    length = sums(pair_of_edge, np.linalg.norm(cut.V[ends[:, 0]] - cut.V[ends[:, 1]], axis=1), len(keys))

    pair_of_cut = _lookup(edge_keys(ends, n), pair_of_edge, edge_keys(cut.cuts, n))
    whole, knob_pair = _whole_knobs(cut, knobs, pair_of_cut)
    head, neck = (_width(cut, points[whole]) for points in (knobs.head, knobs.neck))
    pairs = np.stack([keys // n_pieces, keys % n_pieces], 1)
    return Interlock(
        pairs,
        length,
        np.bincount(knob_pair, minlength=len(keys)),
        knob_pair,
        head,
        neck,
        cut.V[ends],
        pair_of_edge,
        cut,
        piece_of_face,
    )


def _points_along(parts: Floats, of: Ints, spacing: float) -> tuple[Floats, Ints]:
    """Give points (k, 3) along straight parts (e, 2, 3), ends included, and what they belong to, (k,)."""
    n = np.ceil(np.linalg.norm(parts[:, 1] - parts[:, 0], axis=1) / spacing).astype(np.int64) + 1
    row = row_of(n)
    t = ranks(n) / np.maximum(n[row] - 1, 1)
    return parts[row, 0] + t[:, None] * (parts[row, 1] - parts[row, 0]), of[row]


def _lookup(keys: Ints, values: Ints, wanted: Ints) -> Ints:
    """Give the value of every wanted key, -1 where there is none."""
    if not len(keys):
        return np.full(len(wanted), -1)
    order = np.argsort(keys)
    at = order[np.minimum(np.searchsorted(keys[order], wanted), len(keys) - 1)]
    return np.where(keys[at] == wanted, values[at], -1)


def _whole_knobs(cut: CutMesh, knobs: Knobs, pair_of_cut: Ints) -> tuple[Bools, Ints]:
    """Tell which knobs are whole, (k,) bool, and which pair each of those joins."""
    n_segments = max(int(cut.cut_segment.max(initial=-1)), int(knobs.span.max(initial=0))) + 1
    covered = np.bincount(cut.cut_segment, cut.cut_param[:, 1] - cut.cut_param[:, 0], n_segments)
    lowest = np.full(n_segments, np.iinfo(np.int64).max)
    highest = np.full(n_segments, -1)
    np.minimum.at(lowest, cut.cut_segment, pair_of_cut)
    np.maximum.at(highest, cut.cut_segment, pair_of_cut)
    good = (covered > 1 - 1e-6) & (lowest == highest) & (lowest >= 0)
    bad_before = np.concatenate([[0], np.cumsum(~good)])
    changes = np.concatenate([[0, 0], np.cumsum(lowest[1:] != lowest[:-1])])
    first, after = knobs.span[:, 0], knobs.span[:, 1]
    whole = (bad_before[after] == bad_before[first]) & (changes[after] == changes[first + 1])
    whole &= (cut.point_vertex[knobs.head] >= 0).all(1) & (cut.point_vertex[knobs.neck] >= 0).all(1)
    return whole, lowest[first[whole]]


def _width(cut: CutMesh, points: Ints) -> Floats:
    x = cut.V[cut.point_vertex[points]]
    return np.linalg.norm(x[:, 0] - x[:, 1], axis=1)


def undercuts(cut: CutMesh, piece_of_face: Ints, pairs: Ints) -> Floats:
    """Measure how far neighbours overlap behind each other, whichever way they are pulled apart.

    Pulled in a direction along the surface, a piece comes off when no part of the border stands in the way of
    another. The border is laid in the plane across its mean normal; in the direction in which the least
    stands in the way, that is the undercut.

    Parameters
    ----------
    cut : CutMesh, cut at zero width
    piece_of_face : (m,) int64
    pairs : (b, 2) int64, neighbouring pieces, lower first

    Returns
    -------
    (b,) float64, mm; 0 where the pieces come apart in some direction
    """
    N, corner = area_vectors(cut.V, cut.F), cut.F.ravel()
    row = {(a, b): k for k, (a, b) in enumerate(pairs.tolist())}
    stretches: list[list[Ints]] = [[] for _ in row]
    for rim in borders(cut, piece_of_face):
        for border in rim:
            if (border.piece, border.neighbour) in row:
                stretches[row[border.piece, border.neighbour]].append(border.halfedges)
    least = np.zeros(len(pairs))
    for k, own in enumerate(stretches):
        if own:
            plane = _across(unit(N[np.concatenate(own) // 3].sum(0)))
            curves = [np.append(corner[h], corner[next_halfedge(h[-1:])]) for h in own]
            least[k] = np.max([_behind(cut.V[_twice_around(c)] @ plane) for c in curves], axis=0).min()
    return least


def _twice_around(curve: Ints) -> Ints:
    """Repeat a closed curve, which holds wherever it is taken to begin."""
    return np.concatenate([curve, curve[1:]]) if curve[0] == curve[-1] else curve


def _across(normal: Floats) -> Floats:
    """Give two unit vectors as columns, (3, 2), that span the plane across a normal, seen from its tip."""
    a = unit(np.cross(normal, np.eye(3)[np.abs(normal).argmin()]))
    return np.stack([a, np.cross(normal, a)], 1)


def _behind(curve: Floats) -> Floats:
    """Tell how far a curve (n, 2) runs back, at most, across each of the directions; mm."""
    along = curve @ np.stack([np.cos(_TURN), np.sin(_TURN)])
    back: Floats = (np.maximum.accumulate(along, axis=0) - along).max(0)
    return back
