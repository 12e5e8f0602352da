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
from meshjig.types import Floats, Ints

__all__ = ["parts_beside", "untangled"]


def parts_beside(places: Places, parts: Cycles, some: Ints) -> Ints:
    """List all parts of the faces that the given parts belong to."""
    row = places.row[parts.members[parts.first]]
    return np.flatnonzero(np.isin(row, row[some]))


def untangled(places: Places, parts: Cycles, tangled: Ints, *, all_in_face: bool) -> Places:
    """Put landings on tangled parts, or all in their faces, into the middle of their neighbours.

    With a centre in each part, the parts are a triangulation of the face, and its mean-value
    embedding turns no triangle over as long as all landings are free.

    Parameters
    ----------
    tangled : (t,) int64, parts
    """
    around = parts_beside(places, parts, tangled)
    here, after, part = _sides(parts, around)
    v, w = places.vertex[here], places.vertex[after]
    centre = places.n_vertices + part
    freed = np.zeros(places.n_vertices, bool)
    freed[v if all_in_face else v[np.isin(part, tangled)]] = True
    freed[: places.first_landing] = False

    rows = np.concatenate([v, w, centre, v])
    cols = np.concatenate([w, v, v, centre])
    nodes, position = np.unique(rows, return_inverse=True)
    free = np.append(freed, np.ones(len(parts.size), bool))[nodes]
    at = np.zeros((len(nodes), 3))
    at[np.searchsorted(nodes, v)] = places.bary[here]
    at[free] = _balanced(position, np.searchsorted(nodes, cols), at, free)
    bary = places.bary.copy()
    moved = here[freed[v]]
    bary[moved] = at[np.searchsorted(nodes, places.vertex[moved])]
    return places._replace(bary=bary)


def _sides(parts: Cycles, some: Ints) -> tuple[Ints, Ints, Ints]:
    """List the half-edges of parts, those that follow them, and their part."""
    size = parts.size[some]
    part = np.repeat(some, size)
    k = np.arange(len(part)) - np.repeat(np.cumsum(size) - size, size)
    first = parts.first[part]
    return parts.members[first + k], parts.members[first + (k + 1) % parts.size[part]], part


def _balanced(rows: Ints, cols: Ints, at: Floats, free: Ints) -> Floats:
    """Place free nodes in the mean of their neighbours."""
    from scipy.sparse.linalg import splu

    n = len(at)
    links = coo_matrix((np.ones(len(rows)), (rows, cols)), shape=(n, n)).tocsr()
    laplacian = (diags(np.asarray(links.sum(axis=1)).ravel()) - links).tocsc()
    inner = laplacian[free]
    return splu(inner[:, free].tocsc()).solve(-inner[:, ~free] @ at[~free])
