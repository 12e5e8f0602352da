"""The true gap between pieces, wherever their walls face each other."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from meshjig.check.soup import Soup, area_samples, smooth_regions, soup
from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.pieces import Pieces

__all__ = ["Gap", "default_reach", "gap_between", "gaps"]

_FACING = -0.8  # cosine between two walls' normals: they face each other
_SAMPLES_A_PIECE = 1500
_ENOUGH = 30  # samples on the border of two pieces, for their median to mean something


@dataclass(frozen=True)
class Gap:
    """Distances between neighbouring pieces."""

    pairs: list[tuple[int, int, float | None]]  # least distance of two neighbours, mm; None: no manifold
    samples: Floats  # (k,), mm, spread evenly over the walls
    sample_pair: Ints  # (k, 2), the pieces on both sides of a sample, lower first
    sample_face: Ints  # (k,), the face of all pieces' that a sample lies on
    at: Floats  # (k, 3), mm, where samples are

    @property
    def min(self) -> float | None:
        """The least distance between any two neighbours, mm, exact; 0 when they touch or overlap."""
        known = [distance for _, _, distance in self.pairs if distance is not None]
        return min(known) if known else None

    def facts(self, clearance: float | None) -> dict[str, float | None]:
        """Give min, p1 and median in mm, and the share of the walls within 10 % of the clearance."""
        known = len(self.samples) > 0
        within = np.abs(self.samples - clearance) <= 0.1 * clearance if known and clearance else None
        return {
            "min": self.min,
            "p1": float(np.percentile(self.samples, 1)) if known else None,
            "median": float(np.median(self.samples)) if known else None,
            "within_10pct": None if within is None else float(within.mean()),
        }

    def wide(self, limit: float) -> list[tuple[int, int]]:
        """List the neighbours that are farther apart than a limit, mm.

        Either their least distance is over it, which is exact, or the median of at least 30 samples
        between them.
        """
        n = int(self.sample_pair.max(initial=0)) + 1
        key = self.sample_pair[:, 0] * n + self.sample_pair[:, 1]
        order = np.argsort(key, kind="stable")
        found, start = np.unique(key[order], return_index=True)
        median = {
            divmod(int(k), n): float(np.median(own))
            for k, own in zip(found, np.split(self.samples[order], start[1:]), strict=False)
            if len(own) >= _ENOUGH
        }
        return [
            (i, j)
            for i, j, least in self.pairs
            if max(least or 0.0, median.get((min(i, j), max(i, j)), 0.0)) > limit
        ]


def default_reach(clearance: float | None) -> float:
    """Say how far apart two pieces may be and still be taken for neighbours, mm."""
    return 3 * clearance if clearance else 1.0


def gaps(pieces: Iterable[Any], *, neighbours: Any = None, clearance: float | None = None) -> Gap:
    """Measure the gap between neighbouring pieces.

    Two things are measured: for every pair of neighbours its least distance, by manifold3d; and over
    all the walls the distance to the nearest neighbour. A point lies on a wall when the nearest face
    of a neighbour turns towards its own, and this is so for most of the smooth region around the point:
    two sheets that face each other in a fold of the surface are no walls.

    Parameters
    ----------
    pieces : list of (V, F)
        V (n, 3) float64, mm; F (m, 3) int64, closed.
    neighbours : (k, 2) int64, optional
        Pairs of pieces that share a border. Without it: all pairs nearer than the reach.
    clearance : float, optional
        The gap that was asked for, mm. The reach is three times that, or 1 mm; at least 1 mm between
        neighbours that are named, so that a gap that came out too wide is seen.

    Returns
    -------
    Gap
    """
    return gap_between(Pieces.of(pieces, neighbours), clearance)


def gap_between(pieces: Pieces, clearance: float | None) -> Gap:
    """Measure the gap as gaps() does."""
    reach, found = default_reach(clearance), pieces.neighbours is None
    pairs = pieces.close(reach) if pieces.neighbours is None else pieces.neighbours
    reach = reach if found else max(reach, 1.0)
    bodies = pieces.bodies
    walls = _wall_distances(pieces, pairs, reach)
    bounds = walls.bounds
    measured: list[tuple[int, int, float | None]] = []
    for i, j in pairs.tolist():
        if bodies[i] is None or bodies[j] is None:
            measured.append((i, j, None))
            continue
        # a distance that was met somewhere bounds the search, and the search is what takes the time
        bound = min(bounds.get((i, j), reach), bounds.get((j, i), reach), reach) + 1e-6
        distance = float(bodies[i].min_gap(bodies[j], bound))
        if not found or distance < reach:
            measured.append((i, j, min(distance, reach)))
    return Gap(measured, *walls[:4])


class _Walls(NamedTuple):
    """The distance from points all over the walls to the nearest neighbour."""

    gap: Floats  # (k,), mm
    pair: Ints  # (k, 2), the pieces on both sides
    face: Ints  # (k,)
    at: Floats  # (k, 3), mm
    bounds: dict[tuple[int, int], float]  # the least distance met between two pieces, on walls or elsewhere


def _wall_distances(pieces: Pieces, pairs: Ints, reach: float) -> _Walls:
    s = soup(pieces)
    P, face = area_samples(s, _SAMPLES_A_PIECE * len(pieces))
    gap, opposite, facing = np.full(len(P), np.inf), np.full(len(P), -1), np.zeros(len(P), bool)
    bounds = {}
    low, high = s.V[s.F].min(1), s.V[s.F].max(1)
    box_low, box_high = pieces.boxes
    of_piece = np.searchsorted(face, s.start)
    both = np.concatenate([pairs, pairs[:, ::-1]])
    for i in np.unique(both):
        others = both[both[:, 0] == i, 1]
        own = np.arange(of_piece[i], of_piece[i + 1])
        own = own[_inside_any(P[own], box_low[others] - reach, box_high[others] + reach)]
        across = np.concatenate([np.arange(s.start[j], s.start[j + 1]) for j in others])
        across = across[((low[across] <= box_high[i] + reach) & (high[across] >= box_low[i] - reach)).all(1)]
        if not len(own) or not len(across):
            continue
        nearest, distance, gap[own] = _nearest(s, P[own], across)
        opposite[own] = s.piece[nearest]
        turned = np.einsum("ij,ij->i", s.N[nearest], s.N[face[own]]) <= _FACING
        facing[own] = turned & (distance < reach)
        for j in others:
            bounds[int(i), int(j)] = float(distance.min(where=opposite[own] == j, initial=np.inf))
    wall = facing & _of_walls(smooth_regions(s)[face], facing)
    ends = np.stack([s.piece[face[wall]], opposite[wall]], 1)
    return _Walls(gap[wall], np.sort(ends, axis=1), face[wall], P[wall], bounds)


def _of_walls(region: Ints, facing: Bools) -> Bools:
    """Tell which samples lie in a region of which at least half faces a neighbour, (k,) bool."""
    share = np.bincount(region, facing) / np.maximum(np.bincount(region), 1)
    return (share >= 0.5)[region]


def _nearest(s: Soup, P: Floats, faces: Ints) -> tuple[Ints, Floats, Floats]:
    """Give the nearest of some faces to points, the distance, and that distance but 0 behind the face."""
    import igl

    squared, at, foot = igl.point_mesh_squared_distance(P, s.V, np.ascontiguousarray(s.F[faces]))
    nearest, distance = faces[at], np.sqrt(squared)
    behind = np.einsum("ij,ij->i", s.N[nearest], P - foot) < 0
    return nearest, distance, np.where(behind, 0.0, distance)


def _inside_any(P: Floats, low: Floats, high: Floats) -> Bools:
    """Tell which points lie in one of the boxes, (n,) bool."""
    inside = np.zeros(len(P), bool)
    for a, b in zip(low, high, strict=True):
        inside |= (np.clip(P, a, b) == P).all(1)
    return inside
