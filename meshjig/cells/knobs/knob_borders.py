"""Where cells meet: runs of border between the same two cells, as seen in the planes of both."""

from typing import Any, NamedTuple

import numpy as np

from meshjig.mesh.arrays import ragged, ranks, row_of
from meshjig.mesh.chains import cycles
from meshjig.mesh.halfedges import edge_keys, edges
from meshjig.mesh.types import Atlas, Bools, Floats, Ints

__all__ = ["Borders", "cell_borders", "places_along"]

_NEXT = [1, 2, 0]


class Borders(NamedTuple):
    """Runs of border between two cells, each with two sides: one in the plane of either cell.

    Sides run with their cell on the left, in the order of the loops around cells.
    """

    loops: Floats  # (p, 2), the points of all loops, each closed by its first point
    along: Floats  # (p,), mm along the loops, which lie one after the other
    span: Ints  # (e, 2), first and last point of a side
    rim: Ints  # (e,), the loop that it is in
    cell: Ints  # (e,)
    border: Ints  # (e,), the run that it is a side of
    sides: Ints  # (b, 2), the two sides of a run
    length: Floats  # (b,), mm in space
    rim_span: Ints  # (l, 2), first and last point of a loop
    rim_cell: Ints  # (l,)

    def mm(self) -> Floats:
        """Give the length of sides in the plane, (e,)."""
        return self.along[self.span[:, 1]] - self.along[self.span[:, 0]]

    def between(self, pairs: Ints) -> "Borders":
        """Give those between some pairs (k, 2) of cells, whichever comes first; loops stay whole."""
        n = int(max(self.rim_cell.max(initial=0), pairs.max(initial=0))) + 1
        wanted = np.isin(edge_keys(self.cell[self.sides], n), edge_keys(pairs, n))
        kept = np.flatnonzero(wanted[self.border])
        number = np.cumsum(wanted[self.border]) - 1
        return self._replace(
            span=self.span[kept],
            rim=self.rim[kept],
            cell=self.cell[kept],
            border=(np.cumsum(wanted) - 1)[self.border[kept]],
            sides=number[self.sides[wanted]],
            length=self.length[wanted],
        )

    def opposite(self, side: Ints) -> Ints:
        """Give the other sides of the same borders, (k,)."""
        return self.sides[self.border[side]].sum(1) - side

    def lines(self) -> Any:
        """Draw the sides, (e,) LineString."""
        return _drawn(self.loops, self.span[:, :1], self.span[:, 1:])

    def others(self) -> Any:
        """Draw the rest of each side's loop, (e,) LineString; empty where the side is the whole loop."""
        low, high = self.rim_span[self.rim].T
        first = np.stack([self.span[:, 1], low + 1], 1)
        return _drawn(self.loops, first, np.stack([high, self.span[:, 0]], 1))

    def rims(self) -> Any:
        """Draw the loops, (l,) LineString."""
        return _drawn(self.loops, self.rim_span[:, :1], self.rim_span[:, 1:])


def cell_borders(atlas: Atlas) -> Borders:
    """Find the runs of border between two cells; open rims and a cell's borders with itself have none.

    Parameters
    ----------
    atlas : Atlas, every chart a disc
    """
    F = atlas.mesh.F
    twin = edges(F).twin
    start = atlas.F_uv.ravel()
    end = atlas.F_uv[:, _NEXT].ravel()
    joined = (start == end[twin]) & (end == start[twin]) & (twin != np.arange(len(twin)))
    h = np.flatnonzero(~joined)
    cell, beyond = atlas.chart_of_face[h // 3], atlas.chart_of_face[twin[h] // 3]
    number = np.full(len(twin), -1)
    number[h] = np.arange(len(h))
    across = np.where(cell == beyond, -1, number[twin[h]])
    at = np.full(len(atlas.uv), -1)
    at[start[h]] = np.arange(len(h))
    ahead = at[end[h]]
    both = (across >= 0) & (across[ahead] >= 0) & (beyond == beyond[ahead])
    goes_on = np.where(both, ahead[across[ahead]] == across, (across < 0) & (across[ahead] < 0))

    order, first = _loop_order(ahead, goes_on)
    place = np.empty(len(h), np.int64)
    place[order] = np.arange(len(h))
    begins = first.copy()
    begins[1:] |= ~goes_on[order[:-1]]
    across = np.where(across >= 0, place[across], -1)[order]
    tail, head = F.ravel()[h[order]], F[:, _NEXT].ravel()[h[order]]
    mm = np.linalg.norm(atlas.mesh.V[tail] - atlas.mesh.V[head], axis=1)
    return _runs(atlas.uv[start[h[order]]], cell[order], mm, across, first, begins)


def places_along(borders: Borders, mm: Floats) -> Floats:
    """Give points (k, 2) by their places (k,) along the loops."""
    return np.stack([np.interp(mm, borders.along, borders.loops[:, k]) for k in (0, 1)], 1)


def _loop_order(ahead: Ints, goes_on: Bools) -> tuple[Ints, Bools]:
    """Put half-edges, each with the next one ahead, in the order of their loops; mark the first ones.

    A loop starts where a run does.
    """
    loops, n = cycles(ahead), len(ahead)
    inside_run = np.zeros(n, bool)
    inside_run[ahead[goes_on]] = True
    begin = np.lexsort([inside_run, loops.of_member])[loops.first]
    place = np.empty(n, np.int64)
    place[loops.members] = np.arange(n)
    rank, row = ranks(loops.size), row_of(loops.size)
    turned = (rank + (place[begin] - loops.first)[row]) % loops.size[row]
    return loops.members[loops.first[row] + turned], rank == 0


def _runs(uv: Floats, cell: Ints, mm: Floats, across: Ints, first: Bools, begins: Bools) -> Borders:
    """Gather half-edges, in the order of their loops, into runs."""
    n, loop = len(uv), np.cumsum(first) - 1
    row = np.arange(n) + loop  # a loop gets its first point once more at its end
    low = row[first]
    high = np.append(low[1:], n + len(low)) - 1
    loops = np.empty((n + len(low), 2))
    loops[row], loops[high] = uv, uv[first]
    step = np.linalg.norm(np.diff(loops, axis=0), axis=1)
    step[high[:-1]] = 1.0  # so that places are unique
    along = np.concatenate([[0], np.cumsum(step)])

    begin = np.flatnonzero(begins)
    end = np.append(begin[1:], n) - 1
    two_sided = across[begin] >= 0
    side_of_run = np.cumsum(two_sided) - 1
    run = np.cumsum(begins) - 1
    length = np.add.reduceat(mm, begin)[two_sided]
    begin, end = begin[two_sided], end[two_sided]
    other = side_of_run[run[across[begin]]]
    lower, border = np.unique(np.minimum(np.arange(len(begin)), other), return_inverse=True)
    return Borders(
        loops,
        along,
        np.stack([row[begin], row[end] + 1], 1),
        loop[begin],
        cell[begin],
        border,
        np.stack([lower, other[lower]], 1),
        length[lower],
        np.stack([low, high], 1),
        cell[first],
    )


def _drawn(points: Floats, first: Ints, last: Ints) -> Any:
    """Draw one line a row through ranges of points (e, k), the ends included."""
    import shapely

    count = np.maximum(last - first + 1, 0).ravel()
    total, ids = row_of(count), ragged(first.ravel(), count)
    line = total // first.shape[1]
    enough = np.bincount(line, minlength=len(first)) >= 2
    lines = np.full(len(first), shapely.from_wkt("LINESTRING EMPTY"))
    ok = enough[line]
    if ok.any():
        lines[enough] = shapely.linestrings(points[ids[ok]], indices=(np.cumsum(enough) - 1)[line[ok]])
    return lines
