"""How far the border between two pieces reaches back behind itself: what holds them together."""

import numpy as np

from meshjig.layout.congruent import borders
from meshjig.mesh.halfedges import next_halfedge
from meshjig.mesh.measure import area_vectors, unit
from meshjig.mesh.types import CutMesh, Floats, Ints

__all__ = ["undercuts"]

DIRECTIONS = 72  # in which two pieces are pulled apart
_TURN = 2 * np.pi * np.arange(DIRECTIONS) / DIRECTIONS


def undercuts(cut: CutMesh, piece_of_face: Ints, pairs: Ints) -> Floats:
    """Measure how far neighbours overlap behind each other, whichever way they are pulled apart.

    Pulled in a direction along the surface, a piece comes off when no part of the border stands in the way of
    another. The border is laid in the plane across its mean normal; in the direction in which the least
    stands in the way, that is the undercut.

    Parameters
    ----------
    cut : CutMesh, cut at zero width
    piece_of_face : (m,) int64
    pairs : (b, 2) int64, neighbouring pieces, lower first

    Returns
    -------
    (b,) float64, mm; 0 where the pieces come apart in some direction
    """
    N, corner = area_vectors(cut.V, cut.F), cut.F.ravel()
    row = {(a, b): k for k, (a, b) in enumerate(pairs.tolist())}
    stretches: list[list[Ints]] = [[] for _ in row]
    for rim in borders(cut, piece_of_face):
        for border in rim:
            if (border.piece, border.neighbour) in row:
                stretches[row[border.piece, border.neighbour]].append(border.halfedges)
    least = np.zeros(len(pairs))
    for k, own in enumerate(stretches):
        if own:
            plane = _across(unit(N[np.concatenate(own) // 3].sum(0)))
            curves = [np.append(corner[h], corner[next_halfedge(h[-1:])]) for h in own]
            least[k] = np.max([_behind(cut.V[_twice_around(c)] @ plane) for c in curves], axis=0).min()
    return least


def _twice_around(curve: Ints) -> Ints:
    """Repeat a closed curve, which holds wherever it is taken to begin."""
    return np.concatenate([curve, curve[1:]]) if curve[0] == curve[-1] else curve


def _across(normal: Floats) -> Floats:
    """Give two unit vectors as columns, (3, 2), that span the plane across a normal, seen from its tip."""
    a = unit(np.cross(normal, np.eye(3)[np.abs(normal).argmin()]))
    return np.stack([a, np.cross(normal, a)], 1)


def _behind(curve: Floats) -> Floats:
    """Tell how far a curve (n, 2) runs back, at most, across each of the directions; mm."""
    along = curve @ np.stack([np.cos(_TURN), np.sin(_TURN)])
    back: Floats = (np.maximum.accumulate(along, axis=0) - along).max(0)
    return back
