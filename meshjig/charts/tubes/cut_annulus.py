"""A ring's periodic map as a chart: cut open along a line, the two sides a period apart."""

from typing import NamedTuple

import numpy as np

from meshjig.charts.distortion import is_unflipped
from meshjig.charts.flatten.untangle import untangle
from meshjig.charts.tubes.separating_loops import avoiding, left_corners
from meshjig.errors import ChartError
from meshjig.mesh.arrays import Floats, Ints, connected
from meshjig.mesh.boundary_loops import borders_by_length
from meshjig.mesh.halfedges import border_halfedges, edges
from meshjig.mesh.shortest_paths import shortest_way, symmetric

__all__ = ["Annulus", "CutAnnulus", "annulus_of", "cut_annulus", "meets_itself", "untangle_annulus"]


_UPRIGHT = 2.0  # mm that a mm along u counts for more, in the length of a closing line
_ROUNDS = 4  # of turning mirrored faces back, each with another closing line


class Annulus(NamedTuple):
    """A ring with its edges and rims, listed once."""

    F: Ints  # (m, 3)
    E: Ints  # (e, 2)
    lower: Ints  # vertices of one rim
    upper: Ints  # and of the other; which is which may change with the map
    hole: Ints  # vertices on the borders of holes


class CutAnnulus(NamedTuple):
    """A ring cut open; the first rows belong to the vertices, the rest to the line's other side."""

    uv: Floats  # (n + k, 2), mm
    corners: Ints  # (m, 3), into uv
    line: Ints  # (k,), vertices of the closing line; row n + i is that of line[i], one period farther


def annulus_of(F: Ints) -> Annulus:
    """List the edges and rims of a ring.

    Parameters
    ----------
    F : (m, 3) int64, manifold, one component that uses every vertex

    Raises
    ------
    ChartError
        It has fewer than two rims.
    """
    loops = borders_by_length(F)
    if len(loops) < 2:
        raise ChartError("a ring has no two rims", hint="use --charts auto")
    return Annulus(F, edges(F).E, loops[0], loops[1], np.concatenate([*loops[2:], np.zeros(0, np.int64)]))


def cut_annulus(annulus: Annulus, uv: Floats, period: float, around: float | None = None) -> CutAnnulus:
    """Cut a ring open along a straight line across.

    Parameters
    ----------
    annulus : Annulus
    uv : (n, 2) float64, mm; u counts up to whole periods
    period : float, mm
    around : float, the place along u near which the line is to be; None: wherever it is straightest

    Raises
    ------
    ChartError
        The map does not go around once.
    """
    line = _closing_line(annulus, uv, period, around)
    left = left_corners(annulus.F, line)
    number = np.full(len(uv), -1)
    number[line] = len(uv) + np.arange(len(line))
    corners = np.where(left, number[annulus.F], annulus.F)
    rows = _lifted(corners, np.append(uv, uv[line], axis=0), period)
    apart = rows[len(uv) :, 0] - rows[line, 0]
    if (np.rint(apart / period) != 1).any():
        raise ChartError("a ring's map does not go around it once", hint="use --charts auto")
    rows[len(uv) :] = rows[line] + [period, 0.0]
    return CutAnnulus(rows, corners, line)


def untangle_annulus(V: Floats, annulus: Annulus, uv: Floats, period: float) -> Floats:
    """Turn back the few mirrored faces of a ring's map.

    Parameters
    ----------
    V : (n, 3) float64, mm
    annulus : Annulus
    uv : (n, 2) float64, mm
    period : float, mm

    Returns
    -------
    uv : (n, 2) float64, mm. Mirrored faces may be left: the caller checks.
    """
    for k in range(_ROUNDS):
        opened = cut_annulus(annulus, uv, period, around=(0.1 + 0.3 * k) * period)
        if is_unflipped(opened.uv, opened.corners):
            break
        moved = untangle(np.append(V, V[opened.line], axis=0), opened.corners, opened.uv)[: len(V)]
        moved[opened.line] = opened.uv[opened.line]  # both sides alike; the next line is elsewhere
        uv = moved
    return uv


def meets_itself(annulus: Annulus, opened: CutAnnulus, period: float) -> bool:
    """Tell whether the rims of an opened annulus meet themselves, each other, or their copies a period on."""
    import shapely

    h = border_halfedges(annulus.F)
    rows = np.stack([X.ravel()[h] for X in (opened.corners, np.roll(opened.corners, -1, 1))], 1)
    vertices = np.stack([X.ravel()[h] for X in (annulus.F, np.roll(annulus.F, -1, 1))], 1)
    ends = opened.uv[rows]
    copies = np.concatenate([ends + np.array([k * period, 0.0]) for k in (-1, 0, 1)])
    tree = shapely.STRtree(shapely.linestrings(copies))
    a, b = tree.query(shapely.linestrings(ends), predicate="intersects")
    shared = vertices[a][:, :, None] == np.tile(vertices, (3, 1))[b][:, None, :]
    return bool((~shared.any((1, 2))).any())


def _closing_line(annulus: Annulus, uv: Floats, period: float, around: float | None) -> Ints:
    """The straightest path in the plane from the lower rim to the upper one."""
    lower, upper = sorted((annulus.lower, annulus.upper), key=lambda rim: float(uv[rim, 1].mean()))
    step = uv[annulus.E[:, 1]] - uv[annulus.E[:, 0]]
    step[:, 0] -= period * np.rint(step[:, 0] / period)
    weight = np.hypot(step[:, 0], step[:, 1]) + _UPRIGHT * np.abs(step[:, 0])
    if around is not None:
        off = np.abs((uv[annulus.E[:, 0], 0] - around + period / 2) % period - period / 2)
        weight *= 1 + 4 * off / period
    return shortest_way(avoiding(symmetric(annulus.E, weight, len(uv)), annulus.hole), lower, upper)


def _lifted(F: Ints, uv: Floats, period: float) -> Floats:
    """Add whole periods to u so that no edge of a disc is longer than half of one.

    Parts without such edges are moved as wholes: mostly two or three, so that they are walked one
    by one.
    """
    e = edges(F).E
    jump = np.rint((uv[e[:, 1], 0] - uv[e[:, 0], 0]) / period).astype(np.int64)
    smooth = e[jump == 0]
    n, part = connected(len(uv), *smooth.T)
    torn = jump != 0
    links = np.unique(np.column_stack([part[e[torn]], jump[torn]]), axis=0)
    beside: dict[int, list[tuple[int, int]]] = {}
    for a, b, k in links.tolist():
        beside.setdefault(a, []).append((b, -k))
        beside.setdefault(b, []).append((a, k))
    turns = np.zeros(n, np.int64)
    start = int(np.bincount(part, minlength=n).argmax())
    seen, todo = {start}, [start]
    while todo:
        here = todo.pop()
        for there, k in beside.get(here, []):
            if there not in seen:
                turns[there] = turns[here] + k
                seen.add(there)
                todo.append(there)
    lifted = uv.copy()
    lifted[:, 0] += period * turns[part]
    return lifted
