"""Make room where new vertices were moved across cuts.

Keeping vertices apart moves them by up to a few APART_MM. Outlines closer together than that can be
tangled by it: then the vertices inside the face are spread anew, with their order kept.

References
----------
Floater, "One-to-one Piecewise Linear Mappings over Triangulations", 2003.
"""

import numpy as np
from scipy.sparse import coo_matrix, diags

from meshjig.cut.cycles import Cycles
from meshjig.cut.places import Places
from meshjig.mesh.types import Bools, Floats, Ints

__all__ = ["moved", "parts_beside", "spread"]

NEAR = 1e-9  # barycentric; nodes are not taken for closer


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
    """Put landings on tangled parts, or all in their faces, into the middle of their neighbours.

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
    freed[: places.first_landing] = False

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
    part = np.repeat(some, size)
    k = np.arange(len(part)) - np.repeat(np.cumsum(size) - size, size)
    first = parts.first[part]
    return parts.members[first + k], parts.members[first + (k + 1) % parts.size[part]], part


def _balanced(ends: Ints, at: Floats, free: Bools) -> Floats:
    """Place free nodes in the mean of their neighbours, of near ones foremost: then they move little."""
    from scipy.sparse.linalg import splu

    n = len(at)
    weight = 1 / np.maximum(np.linalg.norm(at[ends[:, 0]] - at[ends[:, 1]], axis=1), NEAR)
    one_way = coo_matrix((weight, (ends[:, 0], ends[:, 1])), shape=(n, n)).tocsr()
    links = one_way + one_way.T
    laplacian = (diags(np.asarray(links.sum(axis=1)).ravel()) - links).tocsr()[free]
    return splu(laplacian[:, free].tocsc()).solve(-(laplacian[:, ~free] @ at[~free]))
