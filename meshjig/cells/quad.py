"""Seeds at the vertices of a quad mesh: cells with four sides, the classic look."""

import os
from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np

from meshjig.cells.surface import Surface
from meshjig.errors import OptionError
from meshjig.mesh.types import Floats, Ints

__all__ = ["four_sided"]

_TRIES = 4
_CLOSE = 0.01  # of the number wanted


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
