"""Directions that walls are ruled along, so that every piece can go out along its way."""

from __future__ import annotations

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import dijkstra

from meshjig.assembly.borders import BorderEdges
from meshjig.assembly.peel import Plan
from meshjig.assembly.shell_rays import ShellRays
from meshjig.mesh.arrays import Bools, Floats, Ints, ranks
from meshjig.mesh.measure import unit

__all__ = ["wall_angles", "wall_directions"]

_STEEPEST = np.tan(np.radians(55))  # of a wall's lean, also where the plan asks for more
_BLEND = 3.0  # mm of border over which a wall turns from one direction to another
_ROUNDS = 30
_EXACT = 30  # rounds at the end, of allowed directions only
_SHORTER = 14  # times that its lean is made less where it does not
_UPRIGHT = 0.05  # tangent of a lean that is none
_LEAST_UP = 0.15  # cosine between way and normal below which no lean helps


class _Demands:
    """What each edge demands of the walls at its ends: not to lean over the way out of the later piece.

    A wall's direction is -n + u with u across the surface's normal n. With the way out w and the conormal
    m out of the later piece, the wall's outward normal is at right angles or more to w when
    (w . n) (u . m) <= -(w . m).
    """

    def __init__(self, b: BorderEdges, plan: Plan) -> None:
        later = plan.later(b.side)
        self.way = plan.way[b.side[np.arange(len(later)), later]]
        self.out = np.where(later == 0, 1, -1)[:, None] * b.conormal
        up = np.einsum("ij,ij->i", self.way, b.normal)
        over = np.einsum("ij,ij->i", self.way, self.out)
        self.hopeless = (up < _LEAST_UP) & (over > 0)
        self.most = np.where(up < _LEAST_UP, np.inf, -over / np.maximum(up, _LEAST_UP))
        self.most = np.maximum(self.most, -_STEEPEST)

    def met(self, u: Floats, at: Ints, edge: Ints) -> Floats:
        """Move directions at some vertices, one edge of each, to where it allows them."""
        over = np.einsum("ij,ij->i", u[at], self.out[edge]) - self.most[edge]
        u[at] -= np.maximum(over, 0)[:, None] * self.out[edge]
        return u


def wall_directions(
    b: BorderEdges, plan: Plan, V: Floats, D: Floats, upright: Bools, rays: ShellRays
) -> tuple[Ints, Floats]:
    """Find a direction for the wall at every vertex where pieces meet, one for all walls that meet there.

    On a knob's curve walls are ruled along the way out of the later piece; elsewhere they stay near the
    normal, as far as that way lets them. At a junction the demands of all its borders can be met at once,
    since no two pieces are each later than the other.

    Parameters
    ----------
    b : BorderEdges
    plan : Plan
    V : (n, 3) float64, mm, the outer sheet
    D : (n, 3) float64, mm, from the outer to the inner sheet
    upright : (n,) bool, vertices where walls must not lean
    rays : ShellRays

    Returns
    -------
    vertex : (k,) int64
    wall : (k, 3) float64, mm, from the outer to the inner sheet where both are level
    """
    vertex, local = np.unique(np.concatenate([b.tail, b.head]), return_inverse=True)
    tail, head = local.reshape(2, -1)
    normal = -unit(D[vertex])
    demands = _Demands(b, plan)
    n, e = len(vertex), np.arange(len(tail))
    ends, of = np.concatenate([tail, head]), np.concatenate([e, e])
    degree = np.bincount(ends, minlength=n)
    turns = _turns(ends, of, degree)

    def across(u: Floats) -> Floats:
        return u - np.einsum("ij,ij->i", u, normal)[:, None] * normal

    def allowed(u: Floats, rounds: int) -> Floats:
        for _ in range(rounds):
            for at, edge in turns:
                u = across(demands.met(u, at, edge))
            u *= np.minimum(1, _STEEPEST / np.maximum(np.linalg.norm(u, axis=1), 1e-300))[:, None]
        return u

    # along the way out, where both edges are a knob's
    stays = upright[vertex]
    facing = np.maximum(np.einsum("ij,ij->i", demands.way, b.normal), _LEAST_UP)
    along = across_mean(ends, -(demands.way / facing[:, None])[of], n)
    on_knob = (np.bincount(ends, b.knob[of], n) == degree) & (degree == 2)
    u = np.where(on_knob[:, None], across(along), 0.0)
    u = np.where(stays[:, None], 0.0, allowed(u, _EXACT))
    fixed = on_knob | (degree != 2) | stays
    u = _blended(u, fixed, tail, head, b.length)
    for _ in range(_ROUNDS):
        mean = across_mean(np.concatenate([tail, head]), u[np.concatenate([head, tail])], n)
        u = np.where(stays[:, None], 0.0, allowed(across(np.where(fixed[:, None], u, mean)), 1))
    u = np.where(stays[:, None], 0.0, allowed(u, _EXACT))
    u = _within_reach(u, normal, V[vertex] + D[vertex] / 2, D[vertex], np.stack([tail, head]), rays)
    leans = ~stays
    u, normal, vertex = u[leans], normal[leans], vertex[leans]
    return vertex, np.linalg.norm(D[vertex], axis=1)[:, None] * (u - normal)


def wall_angles(b: BorderEdges, vertex: Ints, wall: Floats, n: int) -> Floats:
    """Give the angle between wall and sheet along every edge, (e,), degrees; 90 where the wall is upright.

    Parameters
    ----------
    b : BorderEdges
    vertex : (k,) int64, where walls lean
    wall : (k, 3) float64, mm
    n : int, how many vertices there are
    """
    way = np.zeros((n, 3))
    way[vertex] = unit(wall)
    along = way[b.tail] + way[b.head]
    across = np.abs(np.einsum("ij,ij->i", along, b.conormal))
    down = -np.einsum("ij,ij->i", along, b.normal)
    return np.asarray(np.where(along.any(axis=1), np.degrees(np.arctan2(down, across)), 90.0))


def _within_reach(
    u: Floats, normal: Floats, middle: Floats, D: Floats, ends: Ints, rays: ShellRays
) -> Floats:
    """Let walls lean less where they would run along the shell instead of through it, as on sharp ridges."""
    (tail, head), half = ends, np.linalg.norm(D, axis=1)[:, None] / 2
    between = (middle[tail] + middle[head]) / 2
    rim = np.bincount(np.concatenate([tail, head]), minlength=len(u)) == 1  # there rays may pass by

    def leaning(at: Ints) -> Ints:
        return at[np.linalg.norm(u[at], axis=1) > _UPRIGHT]

    todo, edge = leaning(np.flatnonzero(~rim)), np.flatnonzero(~rim[tail] & ~rim[head])
    for _ in range(_SHORTER):
        way = half * (u - normal)
        edge = edge[np.isin(tail[edge], todo) | np.isin(head[edge], todo)]
        along = edge[~rays.leads_through(between[edge], (way[tail[edge]] + way[head[edge]]) / 2)]
        bad = np.union1d(
            todo[~rays.leads_through(middle[todo], way[todo])],
            leaning(np.concatenate([tail[along], head[along]])),
        )
        if not len(bad):
            break
        less = np.ones(len(u))
        less[bad] = 0.8
        marked = less < 1
        for one, other in ((tail, head), (head, tail)):
            beside = one[marked[other]]
            less[beside] = np.minimum(less[beside], 0.9)
        u = less[:, None] * u
        todo = leaning(np.flatnonzero((less < 1) & ~rim))
    return u


def across_mean(at: Ints, values: Floats, n: int) -> Floats:
    """Give the mean of values by place, (n, 3)."""
    count = np.maximum(np.bincount(at, minlength=n), 1)
    return np.stack([np.bincount(at, x, n) / count for x in values.T], 1)


def _turns(ends: Ints, of: Ints, degree: Ints) -> list[tuple[Ints, Ints]]:
    """Part the edges at vertices into turns, so that each has a vertex once."""
    order = np.argsort(ends, kind="stable")
    rank = ranks(degree)
    return [(ends[order][rank == k], of[order][rank == k]) for k in range(int(degree.max(initial=0)))]


def _blended(u: Floats, fixed: Bools, tail: Ints, head: Ints, length: Floats) -> Floats:
    """Let directions fade from knobs and junctions into the border between them."""
    n, sources = len(u), np.flatnonzero(fixed)
    if not len(sources):
        return u
    graph = coo_matrix((np.maximum(length, 1e-9), (tail, head)), shape=(n, n)).tocsr()
    far, _, source = dijkstra(
        graph, directed=False, indices=sources, min_only=True, return_predecessors=True, limit=_BLEND
    )
    near = (far < _BLEND) & ~fixed
    share = (1 - far[near] / _BLEND)[:, None]
    blended = u.copy()
    blended[near] = share * u[source[near]] + (1 - share) * u[near]
    return blended
