"""Cuts along the edges of a mesh: opened, and followed as trimming curves."""

from typing import NamedTuple

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints, connected
from meshjig.mesh.chains import runs
from meshjig.mesh.halfedges import Edges, edges, next_halfedge
from meshjig.mesh.types import Atlas

__all__ = ["TrimmingCurve", "cut_faces", "cut_open", "trimming_curves"]


def cut_open(F: Ints, e: Edges, cut: Bools) -> tuple[Ints, Ints]:
    """Give every vertex on a cut one copy for each side of the cut.

    Parameters
    ----------
    F : (m, 3) int64, manifold, oriented
    e : Edges, of F
    cut : (e,) bool

    Returns
    -------
    corners : (m, 3) int64, into the copies; faces are joined over uncut edges only
    origin : (n,) int64, the vertex of every copy
    """
    corners = cut_faces(F, e, cut, np.arange(len(F)))
    origin = np.empty(int(corners.max(initial=-1)) + 1, np.int64)
    origin[corners] = F
    return corners, origin


def cut_faces(F: Ints, e: Edges, cut: Bools, faces: Ints) -> Ints:
    """Cut open some of the faces only.

    Parameters
    ----------
    F : (m, 3) int64, manifold, oriented; a vertex inside has one fan of faces
    e : Edges, of F
    cut : (e,) bool; all edges where the faces meet others are cut
    faces : (k,) int64

    Returns
    -------
    corners : (k, 3) int64, numbers of copies, 0 to n - 1; faces are connected over uncut edges
    """
    vertex, corner = F[faces].ravel(), (3 * faces[:, None] + np.arange(3)).ravel()
    whole = np.zeros(int(e.E.max(initial=-1)) + 1, bool)  # vertices that stay one
    whole[vertex] = True
    whole[e.E[cut].ravel()] = False
    begins = np.bincount(vertex[e.twin[corner] == corner], minlength=len(whole))
    whole &= begins <= 1  # where borders touch each other, several fans meet
    copy = (np.cumsum(whole) - 1)[vertex]
    split = np.flatnonzero(~whole[vertex])
    h = 3 * faces[split // 3] + split % 3
    number = np.empty(len(e.twin), np.int64)
    number[h] = np.arange(len(h))
    rows = np.flatnonzero((e.twin[h] != h) & ~cut[e.edge_of_halfedge[h]])
    cols = number[next_halfedge(e.twin[h[rows]])]
    _, part = connected(len(h), rows, cols)
    copy[split] = whole.sum() + part
    return _as_they_come(copy).reshape(-1, 3)


def _as_they_come(number: Ints) -> Ints:
    """Number things (k,) again in the order in which they first come: neighbours stay near in memory."""
    first, place = np.empty(int(number.max(initial=-1)) + 1, np.int64), np.arange(len(number))
    first[number[::-1]] = place[::-1]
    first = first[number]
    return (np.cumsum(first == place) - 1)[first]


class TrimmingCurve(NamedTuple):
    """A stretch of a chart's border along one neighbour, its chart on the left."""

    chart: int
    mate: int  # chart on the other side, chart itself at a slit, -1 on an open border
    uv: Floats  # (k, 2), mm
    mate_uv: Floats  # (k, 2), mm, the same points in the mate's plane; (0, 2) on an open border
    xyz: Floats  # (k, 3), mm, the same points in space


def trimming_curves(atlas: Atlas) -> list[TrimmingCurve]:
    """Divide the border of every chart where its neighbour changes.

    Every seam comes twice, once from either side, running in opposite directions. A border without a
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
    # goes to now, and must not be the same stretch back, as at the end of a slit.
    goes_on = mate == mate[following]
    mate_start, next_mate_end = G[twin[rim]], G[next_halfedge(twin[rim[following]])]
    goes_on &= (mate < 0) | ((mate_start == next_mate_end) & (twin[rim] != rim[following]))
    curves = []
    for run in runs(following, goes_on):
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
    """The index into rim of the border half-edge that each one leads to."""
    by_start = np.full(int(G.max()) + 1, -1)
    by_start[G[rim]] = np.arange(len(rim))
    return by_start[G[next_halfedge(rim)]]
