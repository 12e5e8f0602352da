"""The cuts as polylines in space and in the plane."""

import numpy as np

from meshjig.mesh.arrays import connected, starts
from meshjig.mesh.chains import chains
from meshjig.mesh.types import CutMesh, Floats, Ints, Outlines

__all__ = ["cut_curves"]

SAME_MM = 1e-3  # ends of cuts at one vertex belong together when they are this close in the plane


def cut_curves(cut: CutMesh, outlines: Outlines) -> tuple[list[Floats], list[Floats]]:
    """Join the edges along outlines to curves.

    Curves end where more than two cuts meet, and where they leave their chart: the other side of a
    seam lies elsewhere in the plane.

    Parameters
    ----------
    cut : CutMesh
    outlines : Outlines, those that it was cut along

    Returns
    -------
    plane : list of (k, 2) float64, mm
    space : list of (k, 3) float64, mm
        The same curves, point by point. A closed one repeats its first point.
    """
    n = len(cut.cuts)
    if not n:
        return [], []
    a, b = (outlines.points[outlines.segments[cut.cut_segment, k]] for k in (0, 1))
    uv = np.stack([a + (b - a) * cut.cut_param[:, [k]] for k in (0, 1)], 1).reshape(-1, 2)
    vertex = cut.cuts.ravel()  # end 2 c is where cut c starts, end 2 c + 1 where it stops
    partner = _partners(vertex, uv)
    plane, space = [], []
    for ends in _walks(partner):
        ends = np.append(ends, ends[-1] ^ 1)
        plane.append(uv[ends])
        space.append(cut.V[vertex[ends]])
    return plane, space


def _partners(vertex: Ints, uv: Floats) -> Ints:
    """Give, for each end of a cut, the end that the curve goes on from; itself where it goes no further."""
    place = np.rint(uv / SAME_MM).astype(np.int64)
    order = np.lexsort((place[:, 1], place[:, 0], vertex))
    v, p = vertex[order], uv[order]
    joins = (v[1:] == v[:-1]) & (np.abs(p[1:] - p[:-1]).max(axis=1) < SAME_MM)
    run = np.cumsum(np.append(True, ~joins)) - 1
    size = np.bincount(run)
    first = starts(size)[size == 2]
    partner = np.arange(len(vertex))
    partner[order[first]], partner[order[first + 1]] = order[first + 1], order[first]
    return partner


def _walks(partner: Ints) -> list[Ints]:
    """Walk along every curve: the ends at which one comes to its cuts, one after another."""
    n = len(partner)
    end = np.arange(n)
    curve = connected(n // 2, end // 2, partner // 2)[1]
    other = end ^ 1
    order, first = chains(np.where(partner[other] == other, -1, partner[other]))
    # each curve is there in both directions, an open one from its loose ends: the first found is taken
    taken = np.unique(curve[order[first] // 2], return_index=True)[1]
    walks = np.split(order, first[1:])
    return [walks[k] for k in taken.tolist()]
