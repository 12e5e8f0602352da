"""What tells a sharp edge, which tapers to nothing, from a skin: where its two sides lead."""

from __future__ import annotations

import numpy as np

from meshjig.check.soup import Soup
from meshjig.mesh.arrays import Bools, Floats, Ints

__all__ = ["at_edges"]

_FEATHER = np.cos(np.radians(30.0))  # cosine of the angle of an edge; narrower ones are thin walls
_ALONG = (0.25, 0.5, 0.75, 1.0)  # of the way to the edge, where the sides are looked for
_OFF = 0.1  # of the ray, that a side may be off its plane there


def at_edges(s: Soup, start: Floats, end: Floats, faces: Ints) -> Bools:
    """Tell which rays through pieces, straight in, go through the wedge at a sharp edge.

    The planes of the two faces meet at more than 30 degrees, and the piece's surface follows both of them to
    the line where they meet. So a ray that is thinner than the least wall lies within twice that of an edge.
    A skin is none, however short: its sides lead nowhere, or its planes hardly meet.

    Parameters
    ----------
    s : Soup
    start, end : (k, 3) float64, mm
    faces : (k, 2) int64, where they start, and where they end

    Returns
    -------
    (k,) bool
    """
    import igl

    n, other = s.N[faces[:, 0]], s.N[faces[:, 1]]
    cosine = -np.einsum("ij,ij->i", n, other)
    found = np.asarray(cosine < _FEATHER)
    way = np.linalg.norm(end - start, axis=1)
    toward = other + cosine[:, None] * n  # in the first plane, as long as the sine
    sine = np.linalg.norm(toward, axis=1)
    found &= sine > 0
    edge = start + (way * cosine / np.maximum(sine, 1e-9) ** 2)[:, None] * toward
    for piece in np.unique(s.piece[faces[found, 0]]):
        F = s.F[s.start[piece] : s.start[piece + 1]]
        for side in (start, end):
            for along in _ALONG:
                at = np.flatnonzero(found & (s.piece[faces[:, 0]] == piece))
                P = side[at] + along * (edge[at] - side[at])
                found[at] = igl.point_mesh_squared_distance(P, s.V, F)[0] <= (_OFF * way[at]) ** 2
    return found
