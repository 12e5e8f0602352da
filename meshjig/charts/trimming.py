"""Chart borders as trimming curves, each with its mate on the neighbouring chart."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from meshjig.mesh.halfedges import edges, next_halfedge
from meshjig.mesh.types import Atlas

__all__ = ["TrimmingCurve", "trimming_curves"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


class TrimmingCurve(NamedTuple):
    """A stretch of a chart's border along one neighbour, its chart on the left."""

    chart: int
    mate: int  # chart on the other side, chart itself at a slit, -1 on an open border
    uv: Floats  # (k, 2), mm
    mate_uv: Floats  # (k, 2), mm, the same points in the mate's plane; (0, 2) on an open border
    xyz: Floats  # (k, 3), mm, the same points in space


def trimming_curves(atlas: Atlas) -> list[TrimmingCurve]:
    """Divide the border of every chart where its neighbour changes.

    Every seam comes twice, once from either side, running opposite ways. A border without a
    change is one curve whose last point repeats its first.

    Parameters
    ----------
    atlas : Atlas

    Returns
    -------
    list of TrimmingCurve
    """
    V, F, G = atlas.mesh.V, atlas.mesh.F.ravel(), atlas.F_uv.ravel()
    twin = edges(atlas.mesh.F).twin
    h = np.arange(len(twin))
    rim = np.flatnonzero(edges(atlas.F_uv).twin == h)
    mate = np.where(twin[rim] == rim, -1, atlas.chart_of_face[twin[rim] // 3])
    following = _following(G, rim)
    # A curve goes on when both sides do: the mate must have come from where it
    # goes to now, and must not be the way back, as at the end of a slit.
    goes_on = mate == mate[following]
    mate_start, next_mate_end = G[twin[rim]], G[next_halfedge(twin[rim[following]])]
    goes_on &= (mate < 0) | ((mate_start == next_mate_end) & (twin[rim] != rim[following]))
    curves = []
    for run in _runs(following, goes_on):
        r = rim[run]
        last = next_halfedge(r[-1:])
        mate_uv = np.empty((0, 2))
        if mate[run[0]] >= 0:
            mate_uv = atlas.uv[np.append(G[next_halfedge(twin[r])], G[twin[r[-1:]]])]
        own = np.append(r, last)
        chart = int(atlas.chart_of_face[r[0] // 3])
        curves.append(TrimmingCurve(chart, int(mate[run[0]]), atlas.uv[G[own]], mate_uv, V[F[own]]))
    return curves


def _following(G: Ints, rim: Ints) -> Ints:
    """Give the index into rim of the border half-edge that each one leads to."""
    by_start = np.full(int(G.max()) + 1, -1)
    by_start[G[rim]] = np.arange(len(rim))
    return by_start[G[next_halfedge(rim)]]


def _runs(following: Ints, goes_on: NDArray[np.bool_]) -> list[Ints]:
    """Follow the border from each break to the next; then the loops that have none."""
    step, on = following.tolist(), goes_on.tolist()
    done = [False] * len(step)
    starts = following[~goes_on].tolist() + list(range(len(step)))
    runs = []
    for at in starts:
        run = []
        while not done[at]:
            done[at] = True
            run.append(at)
            if not on[at]:
                break
            at = step[at]
        if run:
            runs.append(np.array(run, np.int64))
    return runs
