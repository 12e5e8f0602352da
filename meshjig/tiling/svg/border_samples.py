"""The borders of tiles as evenly spaced points, and how well moved copies of them fit."""

from functools import cached_property
from typing import Any

import numpy as np

from meshjig.mesh.types import Bools, Floats

__all__ = ["Border"]

_FINE = (4_000, 60_000)  # least and most points along all borders, as many as the tolerance asks for
_COARSE = 800  # most of them that are laid on moved copies
_NEAREST = 4  # points looked at, for one that runs the other way
_OPPOSITE = -0.8  # cosine between stretches that count as running opposite ways


class Border:
    """Points and directions along the outer border of closed outlines.

    Stretches along which two of the outlines lie side by side are inside and left out.

    Parameters
    ----------
    rings : list of (n, 2) float64, counterclockwise
    tolerance : float, how far apart points may lie and still fit
    """

    def __init__(self, rings: list[Floats], tolerance: float) -> None:
        self.tolerance = tolerance
        length = float(sum(_lengths(ring).sum() for ring in rings))
        n = int(np.clip(length / tolerance, *_FINE))
        drawn = [_evenly(ring, max(8, round(n * _lengths(ring).sum() / length))) for ring in rings]
        self._fine, self._fine_directions = (np.vstack(parts) for parts in zip(*drawn, strict=True))
        self._reach = tolerance + length / n
        self.points, self.directions = self._fine, self._fine_directions
        outer = np.flatnonzero(~self.fits(np.zeros(2)))
        every = max(1, -(-len(outer) // _COARSE))
        self.points, self.directions = self._fine[outer[::every]], self._fine_directions[outer[::every]]
        self.spacing = every * length / n  # between neighbouring points

    def fit(self, by: Floats) -> Floats:
        """Tell how well each point lies on the borders' copies, moved.

        Parameters
        ----------
        by : (2,) float64

        Returns
        -------
        (n,) float64
            1 on a stretch of a copy that runs the other way, falling to 0 at the tolerance.
        """
        apart, nearest = self._tree.query(self.points - by, k=_NEAREST, distance_upper_bound=self._reach)
        found = np.isfinite(apart)
        facing = self._fine_directions[np.where(found, nearest, 0)]
        opposite = np.einsum("ijk,ik->ij", facing, self.directions) < _OPPOSITE
        apart = np.where(found & opposite, apart, np.inf).min(1)
        fit: Floats = np.clip(1 - apart / self._reach, 0, 1) * np.isfinite(apart)
        return fit

    def fits(self, by: Floats) -> Bools:
        """Tell which points lie on the borders' copies, moved; (n,) bool."""
        return self.fit(by) > 0

    @cached_property
    def _tree(self) -> Any:
        from scipy.spatial import cKDTree

        return cKDTree(self._fine)


def _lengths(ring: Floats) -> Floats:
    lengths: Floats = np.linalg.norm(np.roll(ring, -1, 0) - ring, axis=1)
    return lengths


def _evenly(ring: Floats, n: int) -> tuple[Floats, Floats]:
    """Give n points along a ring and its direction there."""
    lengths = _lengths(ring)
    before = np.r_[0.0, lengths.cumsum()]
    along = (np.arange(n) + 0.5) * before[-1] / n
    k = np.clip(np.searchsorted(before, along, side="right") - 1, 0, len(ring) - 1)
    directions = (np.roll(ring, -1, 0) - ring)[k] / lengths[k, None]
    return ring[k] + directions * (along - before[k])[:, None], directions
