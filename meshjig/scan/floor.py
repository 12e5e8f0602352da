"""Cut the floor off a model, and close the cut with a plane."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from meshjig.errors import InputError
from meshjig.mesh.arrays import Bools, Floats, Ints, connected
from meshjig.mesh.boundary_loops import closed_loops
from meshjig.mesh.components import components
from meshjig.mesh.halfedges import border_halfedges, next_halfedge
from meshjig.mesh.measure import signed_area
from meshjig.scan.plane_cut import cut_level
from meshjig.scan.preparation import Floor

__all__ = ["AXES", "FloorCut", "FloorFacts", "cut_floor", "height_above"]

AXES = "xyz"
_SHARE = 0.03  # of the model's height: where it is cut when nothing else is asked
_ROUNDS = 30  # until the cut and the size, which depends on what is left, agree


@dataclass(frozen=True)
class FloorFacts:
    """The report's ``floor``."""

    axis: str  # x, y or z: along which it was cut
    above_lowest_mm: float
    closed: int  # loops of the cut that a plane closes
    left_open: int  # and that stay open


class FloorCut(NamedTuple):
    """A mesh without its floor."""

    V: Floats  # (n, 3)
    F: Ints  # (m, 3)
    closed: int
    left_open: int


def height_above(V: Floats, floor: Floor, axis: int, scale: float, size: float | None) -> tuple[float, float]:
    """Say where a model is to be cut.

    Parameters
    ----------
    V : (n, 3) float64, in the units of the source
    floor : Floor
    axis : int
    scale : float, mm of a unit, where no size is given
    size : float, mm, the largest extent of what is left; None where scale holds

    Returns
    -------
    height : float, above the lowest point, in the units of V
    mm : float, the same in mm

    Raises
    ------
    InputError
        Nothing would be left.
    """
    low = float(V[:, axis].min())
    total = float(np.ptp(V[:, axis]))
    if floor.height is None:
        height = _SHARE * total
        rest = V[V[:, axis] > low + height]
        return height, height * (scale if size is None else size / _extent(rest, axis, low + height))
    for _ in range(_ROUNDS):
        height = floor.height / scale
        rest = V[V[:, axis] > low + height]
        if not len(rest):
            raise InputError(
                f"nothing of the model is higher than {floor.height:g} mm along {AXES[axis]}: "
                f"it is {total * scale:.4g} mm high",
                hint="cut off less, or choose another axis with --up",
            )
        if size is None:
            break
        scale = size / _extent(rest, axis, low + height)
    return height, floor.height


def _extent(V: Floats, axis: int, height: float) -> float:
    """The largest extent of points above a plane, down to it."""
    extent = np.ptp(V, axis=0)
    extent[axis] = V[:, axis].max() - height
    return float(extent.max())


def cut_floor(V: Floats, F: Ints, axis: int, height: float, *, stays_open: bool = False) -> FloorCut:
    """Cut off what is below a level, and close the cut where the model was closed there.

    Parameters
    ----------
    V : (n, 3) float64
    F : (m, 3) int64, manifold, closed components oriented outward
    axis : int, 0, 1 or 2
    height : float, in the units of V
    stays_open : bool, whether the cut is not closed

    Returns
    -------
    FloorCut
    """
    V, F, on_plane = cut_level(V, F, axis, height)
    h = border_halfedges(F)
    start, end = F.ravel()[h], F.ravel()[next_halfedge(h)]
    cut = on_plane[start] & on_plane[end]
    start, end, component = start[cut], end[cut], components(F)[1][h[cut] // 3]
    whole, n_paths = _in_loops(start, end, len(V))
    start, end, component = start[whole], end[whole], component[whole]
    edges_of_loop = closed_loops(start, end)
    if stays_open or not edges_of_loop:
        return FloorCut(V, F, 0, len(edges_of_loop) + n_paths)
    loops = [start[loop] for loop in edges_of_loop]
    of = np.array([component[loop[0]] for loop in edges_of_loop])
    flat = V[:, [(axis + 1) % 3, (axis + 2) % 3]]
    lids = _lids(flat, loops, of)
    return FloorCut(V, np.concatenate([F, *lids]), len(loops), n_paths)


def _in_loops(start: Ints, end: Ints, n: int) -> tuple[Bools, int]:
    """Tell which edges are in closed loops, and count the paths that end somewhere."""
    n_parts, part = connected(n, start, end)
    balance = np.bincount(start, minlength=n) - np.bincount(end, minlength=n)
    open_ = np.zeros(n_parts, bool)
    open_[part[balance != 0]] = True
    return ~open_[part[start]], int((balance > 0).sum())


def _lids(flat: Floats, loops: list[Ints], component: Ints) -> list[Ints]:
    """Triangulate the inside of loops, counterclockwise around it where a component faces outward."""
    import manifold3d

    area = np.array([signed_area(flat[loop]) for loop in loops])
    total = np.bincount(component, area)
    group = component if (total[component] > 0).all() else np.zeros_like(component)
    lids = []
    for one in np.unique(group):
        own = [loops[k] for k in np.flatnonzero(group == one)]
        inward = area[group == one].sum() < 0
        own = [loop[::-1] for loop in own] if inward else own
        triangles = np.asarray(manifold3d.triangulate([flat[loop] for loop in own]), np.int64).reshape(-1, 3)
        faces = np.concatenate(own)[triangles]
        lids.append(faces if inward else faces[:, ::-1])
    return lids
