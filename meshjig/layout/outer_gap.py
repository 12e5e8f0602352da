"""The gap between pieces on the outer surface, as it was cut."""

import numpy as np

from meshjig.mesh.arrays import Floats, Ints, ranks, row_of
from meshjig.mesh.halfedges import edges, next_halfedge

__all__ = ["outer_gap"]

SPACING = 0.25  # of the clearance, between samples
MOST_SAMPLES = 40_000
REACH = 3.0  # clearances, within which a piece is a neighbour


def outer_gap(V: Floats, F: Ints, piece_of_face: Ints, clearance: float) -> dict[str, float | None]:
    """Measure the distance in space from the border of each piece to the nearest border of another.

    The border is sampled at up to 40,000 places; the distance of each is exact for the edges near it.
    Samples on the open border of the surface, or without another piece within three clearances, don't count.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, the cut mesh
    piece_of_face : (m,) int64, negative for the gap
    clearance : float, mm

    Returns
    -------
    dict with min, p1, median in mm, and within_10pct, the share of samples within 10 % of the clearance;
    all None where no two pieces are neighbours
    """
    from scipy.spatial import cKDTree

    a, b, owner = _borders(F, piece_of_face)
    if clearance <= 0 or not len(a):
        return dict.fromkeys(("min", "p1", "median", "within_10pct"))
    x, edge = _samples(V, a, b, SPACING * clearance)
    stride = 1 + len(x) // MOST_SAMPLES
    x, edge = x[::stride], edge[::stride]
    near, near_edge = _samples(V, a, b, 2 * SPACING * clearance)
    found: Ints = np.full(len(x), -1)
    distance = np.full(len(x), np.inf)
    tree = cKDTree(near)
    k = min(32, len(near))
    _, index = tree.query(x, k=k, distance_upper_bound=REACH * clearance)
    for column in np.reshape(index, (len(x), k)).T:
        real = np.flatnonzero(column < len(near))
        other = near_edge[column[real]]
        differs = owner[other] != owner[edge[real]]
        real, other = real[differs], other[differs]
        d = _to_segment(x[real], V[a[other]], V[b[other]])
        closer = d < distance[real]
        distance[real[closer]] = d[closer]
        found[real[closer]] = other[closer]
    d = distance[found >= 0]
    if not len(d):
        return dict.fromkeys(("min", "p1", "median", "within_10pct"))
    low, median = np.percentile(d, [1, 50])
    within = float((np.abs(d / clearance - 1) <= 0.1).mean())
    return {"min": float(d.min()), "p1": float(low), "median": float(median), "within_10pct": within}


def _borders(F: Ints, piece: Ints) -> tuple[Ints, Ints, Ints]:
    """Give the edges where pieces end at a gap or at each other: both ends and the piece.

    The open border of the surface is none: nothing lies across.
    """
    twin = edges(F).twin
    own, other = np.repeat(piece, 3), piece[twin // 3]
    h = np.flatnonzero((own >= 0) & (own != other))
    return F.ravel()[h], F.ravel()[next_halfedge(h)], own[h]


def _samples(V: Floats, a: Ints, b: Ints, spacing: float) -> tuple[Floats, Ints]:
    """Spread points over edges, each at the middle of its stretch; and the edge of each."""
    n = np.maximum(1, np.ceil(np.linalg.norm(V[a] - V[b], axis=1) / max(spacing, 1e-6))).astype(np.int64)
    edge = row_of(n)
    t = (ranks(n) + 0.5) / n[edge]
    return V[a[edge]] + (V[b[edge]] - V[a[edge]]) * t[:, None], edge


def _to_segment(x: Floats, a: Floats, b: Floats) -> Floats:
    along = b - a
    t = np.einsum("ij,ij->i", x - a, along) / np.maximum(np.einsum("ij,ij->i", along, along), 1e-300)
    return np.linalg.norm(x - a - along * np.clip(t, 0, 1)[:, None], axis=1)
