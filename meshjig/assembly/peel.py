"""Order and ways: the whole puzzle is taken apart, each piece where walls have to lean least."""

from __future__ import annotations

import heapq
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from meshjig.assembly.borders import BorderEdges
from meshjig.assembly.sight import Sight
from meshjig.assembly.tilt import DIRECTIONS
from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.measure import area_vectors, sums, unit
from meshjig.mesh.mesh import Mesh

__all__ = ["Ban", "Plan", "peel"]

CALM = 22.0  # degrees; below it the highest piece comes off first
_WHOLE = 25.0  # degrees that a piece is put off by whose leaving would break the rest into islands
_AROUND = np.cos(np.radians(9))  # of a direction that failed: the others near it are banned, too
_STEEP, _REFUSED = 85.0, 90.0  # degrees off a piece's mean normal, and what they cost besides
_NEVER = 999.0  # degrees, of a direction that is blocked

Ban = tuple[int, Floats, frozenset[int]]  # a piece, its way, and the pieces that it met there


@dataclass(frozen=True)
class Plan:
    """In which order pieces are put in, and which way they go out."""

    rank: Ints  # (p,), 0 for the first
    way: Floats  # (p, 3), unit, out
    tilt: Floats  # (p,), degrees that its walls lean by at most; 999 where no way is free

    def later(self, side: Ints) -> Ints:
        """Give of two pieces (k, 2) each the one that is put in later, as a column, 0 or 1."""
        rank = self.rank[side]
        return np.asarray(rank[:, 1] > rank[:, 0], np.int64)


def peel(
    surface: Mesh, piece: Ints, b: BorderEdges, need: Floats, up: Floats, bans: Sequence[Ban] = ()
) -> Plan:
    """Take a puzzle apart, always what needs the least tilt, and give the order in which it is put together.

    Greedy is exact here: no order has a smaller largest tilt, since what is left only gets fewer.

    Parameters
    ----------
    surface : Mesh, the outer sheet
    piece : (m,) int64; faces below 0 belong to none
    b : BorderEdges
    need : (2, p, d) float64, degrees, as of `needed_tilt`
    up : (3,) float64, unit; where tilt is little, the puzzle grows this way
    bans : ways that failed
    """
    return _Peeling(surface, piece, b, need, up, bans).plan()


class _Peeling:
    def __init__(
        self, surface: Mesh, piece: Ints, b: BorderEdges, need: Floats, up: Floats, bans: Sequence[Ban]
    ) -> None:
        V, F = surface
        n = int(piece.max(initial=-1)) + 1
        kept = piece >= 0
        A, label = area_vectors(V, F[kept]) / 2, piece[kept]
        area = np.linalg.norm(A, axis=1)
        mean = unit(np.stack([sums(label, x, n) for x in A.T], 1))
        self.height = sums(label, (V[F[kept]].mean(axis=1) @ up) * area, n) / np.maximum(
            sums(label, area, n), 1e-300
        )
        self.off = np.degrees(np.arccos(np.clip(mean @ DIRECTIONS.T, -1, 1)))
        self.need, self.left, self.n = need, np.ones(n, bool), n
        self.beside: list[list[tuple[int, int, int]]] = [[] for _ in range(n)]
        for i, (p, q) in enumerate(b.pairs.tolist()):
            self.beside[p].append((q, 0, i))
            self.beside[q].append((p, 1, i))
        self.sight = Sight(V, F, piece, n)
        self.blocked: list[dict[int, frozenset[int]]] = [{} for _ in range(n)]
        for k, way, met in bans:
            for d in np.flatnonzero(way @ DIRECTIONS.T > _AROUND).tolist():
                self.blocked[k][d] = self.blocked[k].get(d, frozenset()) | met

    def best(self, k: int) -> tuple[float, int]:
        """Give the least tilt that piece k needs, and the direction."""
        off = self.off[k]
        cost = 0.05 * off + np.where(off > _STEEP, _REFUSED, 0)
        for q, side, i in self.beside[k]:
            if self.left[q]:
                cost = np.maximum(cost, self.need[side, i])
        cost = cost + 0.02 * off
        for d, met in self.blocked[k].items():
            if any(self.left[q] for q in met):
                cost[d] = _NEVER
        d = int(cost.argmin())
        return float(cost[d]), d

    def breaks(self, k: int) -> bool:
        """Tell whether what is left would come apart without piece k."""
        around = [q for q, _, _ in self.beside[k] if self.left[q]]
        if len(around) < 2:
            return False
        seen, todo, wanted = {around[0], k}, [around[0]], set(around[1:])
        while todo and wanted:
            for q, _, _ in self.beside[todo.pop()]:
                if self.left[q] and q not in seen:
                    seen.add(q)
                    wanted.discard(q)
                    todo.append(q)
        return bool(wanted)

    def plan(self) -> Plan:
        n, best = self.n, [self.best(k) for k in range(self.n)]
        rank, way, tilt = np.zeros(n, np.int64), np.zeros((n, 3)), np.zeros(n)

        def turn(k: int) -> tuple[float, float, int]:
            return max(CALM, best[k][0]), -float(self.height[k]), k

        heap = [turn(k) for k in range(n)]
        heapq.heapify(heap)
        put_off: list[tuple[float, tuple[float, float, int]]] = []
        count = n

        def again(k: int) -> None:
            new = self.best(k)
            if new != best[k]:
                best[k] = new
                heapq.heappush(heap, turn(k))

        while heap or put_off:
            let = None
            if put_off and (not heap or heap[0][0] > min(put_off)[0]):
                put_off.sort()
                x = let = put_off.pop(0)[1]
            else:
                x = heapq.heappop(heap)
            k = x[2]
            if not self.left[k] or x != turn(k):
                continue
            cost, d = best[k]
            if cost < _NEVER:
                met = self.sight.blockers(k, DIRECTIONS[d], self.left)
                if met:
                    self.blocked[k][d] = self.blocked[k].get(d, frozenset()) | met
                    again(k)
                    continue
            if let is None and self.breaks(k):
                put_off.append((x[0] + _WHOLE, x))
                continue
            for _, later in put_off:
                heapq.heappush(heap, later)
            put_off, self.left[k], count = [], False, count - 1
            rank[k], way[k], tilt[k] = count, DIRECTIONS[d], cost
            for q, _, _ in self.beside[k]:
                if self.left[q]:
                    again(q)
            for q in np.flatnonzero(self.left).tolist():
                if any(k in met for met in self.blocked[q].values()):
                    again(q)
        return Plan(rank, way, tilt)
