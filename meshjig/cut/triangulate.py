"""Fill the parts of cut faces with triangles.

Keeping vertices apart moves them by up to a few APART_MM. Outlines closer together than that can be
tangled by it: then the vertices inside the face are spread again, with their order kept.

References
----------
Floater, "One-to-one Piecewise Linear Mappings over Triangulations", 2003.
"""

from typing import NamedTuple

import numpy as np
from scipy.sparse import coo_matrix, diags

from meshjig.cut.places import Places
from meshjig.mesh.arrays import next_in_loop, ragged, row_of
from meshjig.mesh.chains import Cycles
from meshjig.mesh.ears import clip_ears
from meshjig.mesh.types import Bools, Floats, Ints

__all__ = ["Filling", "fill", "moved", "parts_beside", "spread"]

SHARES = (2.0**-12, 2.0**-9, 2.0**-6, 2.0**-3, 1.0)  # of the path that tangled corners go to their goal
IDEAL = np.array([[0.0, 0.0], [1.0, 0.0], [0.5, np.sqrt(0.75)]])
NEAR = 1e-9  # barycentric; nodes are not taken for closer


class Filling(NamedTuple):
    """Triangles over the parts of cut faces."""

    T: Ints  # (t, 3), half-edges that start at the corners; from n_half_edges on, centres
    part: Ints  # (t,), the cycle each triangle fills
    centre_part: Ints  # (s,), the cycle of each centre
    centre_bary: Floats  # (s, 3), where it lies in its face
    n_untangled: int  # parts whose corners had to be moved


def fill(places: Places, parts: Cycles, frames: Floats) -> tuple[Places, Filling]:
    """Triangulate every part of every cut face.

    A part that can't be clipped has its corners inside the face moved, as few as will do; what
    fails still is fanned from its centre.

    Parameters
    ----------
    places : Places
    parts : Cycles
    frames : (t, 3, 2) float64, the flat corners of cut faces

    Returns
    -------
    places : Places, with corners moved
    filling : Filling
    """
    T, part, failed = _clipped(places, parts, frames, np.arange(len(parts.size)))
    n_untangled = len(failed)
    for all_in_face in (False, True):
        goal = spread(places, parts, failed, all_in_face=all_in_face)
        start = places
        for share in SHARES:
            if not len(failed):
                break
            again = parts_beside(places, parts, failed)
            places = moved(start, goal, share, of=places, parts=parts, some=again)
            new, new_part, failed = _clipped(places, parts, frames, again)
            kept = ~np.isin(part, again)
            T, part = np.concatenate([T[kept], new]), np.concatenate([part[kept], new_part])
    fan, fan_part, centre = _fans(places, parts, failed)
    return places, Filling(
        np.concatenate([T, fan]), np.concatenate([part, fan_part]), failed, centre, n_untangled
    )


def _clipped(places: Places, parts: Cycles, frames: Floats, some: Ints) -> tuple[Ints, Ints, Ints]:
    """Clip some parts in the shape of their face, or else of an equilateral one, where needles are none.

    Returns
    -------
    T : (t, 3) int64, half-edges
    part : (t,) int64
    failed : (f,) int64, parts
    """
    bary, row = places.bary[parts.members], places.row[parts.members]
    flat = np.einsum("hk,hkd->hd", bary, frames[row])
    T, owner, failed = clip_ears(flat, parts.first[some], parts.size[some])
    part, failed = some[owner], some[failed]
    if len(failed):
        more, owner, still = clip_ears(bary @ IDEAL, parts.first[failed], parts.size[failed], thorough=True)
        T, part = np.concatenate([T, more]), np.concatenate([part, failed[owner]])
        failed = failed[still]
    return parts.members[T], part, failed


def _fans(places: Places, parts: Cycles, some: Ints) -> tuple[Ints, Ints, Floats]:
    """Join the sides of parts to their centres; also give where those lie."""
    size = parts.size[some]
    which = row_of(size)
    here, after, part = _sides(parts, some)
    total = np.stack([np.bincount(which, places.bary[here, j], len(some)) for j in range(3)], 1)
    fan = np.stack([here, after, len(places.vertex) + which], 1)
    return fan, part, total / np.maximum(size, 1)[:, None]


def parts_beside(places: Places, parts: Cycles, some: Ints) -> Ints:
    """List all parts of the faces that the given parts belong to."""
    row = places.row[parts.members[parts.first]]
    return np.flatnonzero(np.isin(row, row[some]))


def moved(start: Places, goal: Floats, share: float, *, of: Places, parts: Cycles, some: Ints) -> Places:
    """Move the corners of some parts a share of the way from start to their goal."""
    here, _, _ = _sides(parts, some)
    bary = of.bary.copy()
    bary[here] = start.bary[here] + share * (goal[here] - start.bary[here])
    return of._replace(bary=bary)


def spread(places: Places, parts: Cycles, tangled: Ints, *, all_in_face: bool) -> Floats:
    """Put hits on tangled parts, or all in their faces, into the middle of their neighbours.

    Joined to a centre, each part becomes a fan of triangles; when every free corner lies in the mean
    of its neighbours, no triangle is turned over. That holds for certain when all in the face are
    free, and mostly when a few are.

    Parameters
    ----------
    places : Places
    parts : Cycles
    tangled : (t,) int64, parts
    all_in_face : bool

    Returns
    -------
    bary : (h, 3) float64, for the starts of all half-edges
    """
    if not len(tangled):
        return places.bary
    around = parts_beside(places, parts, tangled)
    here, after, part = _sides(parts, around)
    v, w = places.vertex[here], places.vertex[after]
    centre = places.n_vertices + part
    freed = np.zeros(places.n_vertices, bool)
    freed[v if all_in_face else v[np.isin(part, tangled)]] = True
    freed[: places.first_hit] = False

    ends = np.stack([np.concatenate([v, centre]), np.concatenate([w, v])], 1)
    nodes, ends = np.unique(ends, return_inverse=True)
    ends = ends.reshape(-1, 2)
    corner, middle = ends[: len(v), 0], ends[len(v) :, 0]
    at = np.zeros((len(nodes), 3))
    at[corner] = places.bary[here]
    for k in range(3):
        at[:, k] += np.bincount(middle, places.bary[here, k], len(nodes))
    at /= np.maximum(np.bincount(middle, minlength=len(nodes)), 1)[:, None]
    free = np.append(freed, np.ones(len(parts.size), bool))[nodes]
    at[free] = _balanced(ends, at, free)
    bary = places.bary.copy()
    free_here = freed[v]
    bary[here[free_here]] = at[corner[free_here]]
    return bary


def _sides(parts: Cycles, some: Ints) -> tuple[Ints, Ints, Ints]:
    """List the half-edges of parts, those that follow them, and their part."""
    size = parts.size[some]
    here = parts.members[ragged(parts.first[some], size)]
    return here, here[next_in_loop(size)], np.repeat(some, size)


def _balanced(ends: Ints, at: Floats, free: Bools) -> Floats:
    """Place free nodes in the mean of their neighbours, of near ones foremost: then they move little."""
    from scipy.sparse.linalg import splu

    n = len(at)
    weight = 1 / np.maximum(np.linalg.norm(at[ends[:, 0]] - at[ends[:, 1]], axis=1), NEAR)
    one_way = coo_matrix((weight, (ends[:, 0], ends[:, 1])), shape=(n, n)).tocsr()
    both_ways = one_way + one_way.T
    laplacian = (diags(np.asarray(both_ways.sum(axis=1)).ravel()) - both_ways).tocsr()[free]
    return splu(laplacian[:, free].tocsc()).solve(-(laplacian[:, ~free] @ at[~free]))
