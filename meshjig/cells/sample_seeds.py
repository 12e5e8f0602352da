"""Seeds for cells: spread over a surface evenly, or at the vertices of a quad mesh."""

import os
from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np

from meshjig.cells.distances import nearest
from meshjig.cells.surface import Surface
from meshjig.errors import OptionError
from meshjig.mesh.arrays import starts
from meshjig.mesh.measure import sums
from meshjig.mesh.types import Bools, Floats, Ints

__all__ = ["centred", "four_sided", "sample_seeds"]

_ROUNDS = 8
_TURN = 0.5  # spacings: how far apart surfaces that face opposite ways count as being, halved
_TRIES = 4
_CLOSE = 0.01  # of the number wanted


def sample_seeds(s: Surface, n: int, seed: int) -> Ints:
    """Spread n seeds evenly over a surface, each component its share.

    Parameters
    ----------
    s : Surface
    n : int; there may be more where components are many
    seed : int

    Returns
    -------
    (N,) int64, vertices, all different

    References
    ----------
    Lloyd, "Least Squares Quantization in PCM", 1982.
    """
    count = _shares(s.component_area, s.closed, n)
    seeds = _scattered(s, count, np.random.default_rng(seed))
    for _ in range(_ROUNDS):
        seeds = np.unique(centred(s.V, s.area, nearest(s.graph, seeds), len(seeds)))
    return seeds


def centred(X: Floats, area: Floats, part: Ints, n: int) -> Ints:
    """Give the vertex of each part that is nearest to its centre of area.

    Parameters
    ----------
    X : (v, d) float64
    area : (v,) float64
    part : (v,) int64, 0 to n - 1; every part has a vertex; -1 for vertices of none
    n : int

    Returns
    -------
    (n,) int64
    """
    inside = np.flatnonzero(part >= 0)
    X, area, part = X[inside], area[inside], part[inside]
    total = sums(part, area, n)
    centre = np.stack([sums(part, area * x, n) for x in X.T], 1) / total[:, None]
    off = ((X - centre[part]) ** 2).sum(1)
    order = np.lexsort((off, part))
    found: Ints = inside[order[np.searchsorted(part[order], np.arange(n))]]
    return found


def _shares(area: Floats, closed: Bools, n: int) -> Ints:
    """Share n cells among components by area.

    Parameters
    ----------
    area : (c,) float64, mm2
    closed : (c,) bool; a closed component needs two cells at least, since no cell may be closed
    n : int

    Returns
    -------
    (c,) int64, at least 1 each; they sum to n where that leaves room for all
    """
    count = np.where(closed, 2, 1)
    while count.sum() < n:  # the method of Webster: whoever has the fewest for its area comes next
        count[(area / (count + 0.5)).argmax()] += 1
    return count


def _scattered(s: Surface, count: Ints, rng: np.random.Generator) -> Ints:
    """Choose vertices so that every component of a surface has as many as its area deserves.

    The vertices of a component are halved by area again and again, across the direction in which they
    reach farthest; those that face opposite ways count as apart.

    Parameters
    ----------
    s : Surface
    count : (c,) int64, vertices to choose from each component
    rng : numpy.random.Generator

    Returns
    -------
    (count.sum(),) int64, all different
    """
    spacing = np.sqrt(s.area.sum() / count.sum())
    axes = np.linalg.qr(rng.normal(size=(3, 3)))[0]
    X = np.concatenate([s.V @ axes, _TURN * spacing * s.mesh.vertex_normals @ axes], 1)
    part, left = s.component.copy(), count.copy()
    while left.max() > 1:
        part, left = _halved(X, s.area, part, left)
    return np.unique(centred(X, s.area, part, len(left)))


def _halved(X: Floats, area: Floats, part: Ints, left: Ints) -> tuple[Ints, Ints]:
    """Split every part that wants more than one vertex into two by area."""
    n = len(left)
    total = sums(part, area, n)
    mean = np.stack([sums(part, area * x, n) for x in X.T], 1) / total[:, None]
    width = np.stack([sums(part, area * (x - mean[part, k]) ** 2, n) for k, x in enumerate(X.T)], 1)
    along = X[np.arange(len(X)), width.argmax(1)[part]]
    order = np.lexsort((along, part))
    run = np.cumsum(area[order])
    before = np.empty(len(X))
    before[order] = run - area[order] / 2
    start = starts(total)
    first = left // 2
    cut = left > 1
    high = cut[part] & (before - start[part] > (total * first / left)[part])
    number = np.where(cut, n + np.cumsum(cut) - 1, 0)
    return np.where(high, number[part], part), np.append(np.where(cut, first, left), (left - first)[cut])


def four_sided(s: Surface, n: int) -> Ints:
    """Choose about n vertices that lie on a grid, as far as the surface lets them.

    Components that the grid leaves out have none.

    Parameters
    ----------
    s : Surface
    n : int

    Returns
    -------
    (k,) int64, vertices, all different

    Raises
    ------
    OptionError
        pynanoinstantmeshes is not installed, or finds no grid.

    References
    ----------
    Jakob et al., "Instant Field-Aligned Meshes", 2015.
    """
    from scipy.spatial import cKDTree

    try:
        from pynanoinstantmeshes import remesh  # type: ignore[import-untyped,import-not-found,unused-ignore]
    except ImportError:
        raise OptionError(
            "style: quad needs the package pynanoinstantmeshes", hint="install it, or use cvt"
        ) from None
    V, F = s.V.astype(np.float32), s.F.astype(np.uint32)
    best, ask = np.zeros((0, 3)), n
    for _ in range(_TRIES):
        with _silence():
            W, Q = remesh(V, F, max(ask, 4), deterministic=True, align_to_boundaries=True)
        corners = _corners(np.asarray(W, np.float64), np.asarray(Q, np.int64), n)
        if abs(len(corners) - n) < abs(len(best) - n):
            best = corners
        if not len(corners) or abs(len(best) - n) <= _CLOSE * n:
            break
        ask = round(ask * n / len(corners))
    if not len(best):
        raise OptionError("style: the surface has no quad mesh of that many faces", hint="use cvt")
    found: Ints = np.unique(cKDTree(s.V).query(best)[1])
    return found


def _corners(W: Floats, Q: Ints, n: int) -> Floats:
    """Undo the subdivision that made the quads: take corners or middles, whichever are nearer to n."""
    corners, middles = np.unique(Q[:, 1]), np.unique(Q[:, 3])
    if len(np.intersect1d(corners, middles)):  # not numbered as expected
        return W
    return W[min(corners, middles, key=lambda found: abs(len(found) - n))]


@contextmanager
def _silence() -> Iterator[None]:
    """Keep what native code writes off the terminal."""
    kept, nowhere = os.dup(1), os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    try:
        yield
    finally:
        os.dup2(kept, 1)
        os.close(kept)
        os.close(nowhere)
