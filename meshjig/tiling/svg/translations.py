"""Find the two translations by which outlines tile the plane, from their borders alone."""

from functools import cached_property
from itertools import combinations
from typing import Any

import numpy as np

from meshjig.mesh.arrays import Bools, Floats

__all__ = ["Border", "find_translations"]

_CANDIDATES = 64
_PAIRS = 40  # pairs of candidates that are laid out in full
_FINE = (4_000, 60_000)  # least and most points along all borders, as many as the tolerance asks for
_COARSE = 800  # most of them that are laid on moved copies
_NEAREST = 4  # points looked at, for one that runs against it
_OPPOSITE = -0.8  # cosine between stretches that count as opposite
_OPPOSITE_VOTERS = -0.9  # and between those that vote


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
            1 on a stretch of a copy that runs against it, falling to 0 at the tolerance.
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


def find_translations(border: Border, nodes: Floats, area: float) -> Floats | None:
    """Move stretches of border onto those that run against them, and vote.

    Wherever two tiles meet, a stretch of one border lies on a stretch of another: the translations
    between the two are voted for by every point of them. Of the pairs of translations that span
    nearly the outlines' area, the one wins that brings most of the border onto itself.

    Parameters
    ----------
    border : Border, of all outlines
    nodes : (n, 2) float64, points of the outlines that translations move onto each other exactly
    area : float, of all outlines

    Returns
    -------
    (2, 2) float64, or None
        A vector a row, as short as can be, the second on the left of the first, the first as level as
        can be; None where no stretches fit.
    """
    from scipy.spatial import cKDTree

    tree = cKDTree(nodes)
    candidates = [_exact(border, peak, tree) for peak in _voted(border, area)]
    fits = [border.fits(by) | border.fits(-by) for by in candidates]
    pairs = []
    for a, b in combinations(range(len(candidates)), 2):
        spanned = abs(np.linalg.det(np.array([candidates[a], candidates[b]]))) / area
        if 0.75 < spanned < 1.33:
            pairs.append((float((fits[a] | fits[b]).mean() - abs(spanned - 1)), a, b))
    best, best_score = None, -np.inf
    for _, a, b in sorted(pairs, reverse=True)[:_PAIRS]:
        pair = _reduced(np.array([candidates[a], candidates[b]]))
        score = _score(border, tree, pair, area)
        if score > best_score + 1e-9:
            best, best_score = pair, score
    return best


def _voted(border: Border, area: float) -> list[Floats]:
    """The differences (2,) between points on opposite stretches that are most frequent."""
    from scipy.ndimage import maximum_filter, uniform_filter

    opposite = border.directions @ border.directions.T < _OPPOSITE_VOTERS
    i, j = np.nonzero(opposite)
    apart = border.points[j] - border.points[i]
    size = np.sqrt(area)
    apart = apart[np.linalg.norm(apart, axis=1) > 0.05 * size]
    if len(apart) == 0:
        return []
    cell = 2 * border.spacing
    low = apart.min(0) - 2.25 * cell
    at = ((apart - low) / cell).astype(np.int64)
    votes = np.zeros(at.max(0) + 3)
    np.add.at(votes, tuple(at.T), 1.0)
    votes = uniform_filter(votes, 3, mode="constant")
    window = 2 * max(1, round(0.04 * size / cell)) + 1
    peak = (votes == maximum_filter(votes, window, mode="constant")) & (votes > 0)
    where = np.argwhere(peak)
    where = where[np.argsort(-votes[tuple(where.T)], kind="stable")]
    found: list[Floats] = []
    for by in low + (where + 0.5) * cell:
        seen = np.array([*found, np.zeros(2)])
        if min(np.linalg.norm(seen - by, axis=1).min(), np.linalg.norm(seen + by, axis=1).min()) > 4 * cell:
            found.append(by)
        if len(found) == _CANDIDATES:
            break
    return found


def _exact(border: Border, rough: Floats, nodes: Any) -> Floats:
    """The translation near a rough one that fits best: one between two nodes, where there is one."""
    from scipy.spatial import cKDTree

    pairs = nodes.query_ball_tree(cKDTree(nodes.data - rough), 4 * border.spacing)
    first = np.repeat(np.arange(len(pairs)), [len(found) for found in pairs])
    second = np.concatenate([np.array(found, np.int64) for found in pairs])
    near = nodes.data[second] - nodes.data[first]
    choices = [rough]
    for grain in (border.tolerance / 10, border.tolerance):
        cell, count = np.unique(np.rint(near / grain), axis=0, return_inverse=True, return_counts=True)[1:]
        often = np.argsort(-count, kind="stable")[:6]
        choices += [near[cell.ravel() == k].mean(0) for k in often]
    return max(choices, key=lambda by: float(border.fit(by).sum()))


def _reduced(pair: Floats) -> Floats:
    """The shortest vectors of the same lattice."""
    a, b = sorted(pair, key=np.linalg.norm)
    while True:
        b = b - np.rint(a @ b / (a @ a)) * a
        if np.linalg.norm(b) >= np.linalg.norm(a) * (1 - 1e-9):
            break
        a, b = b, a
    if abs(b[0]) * np.linalg.norm(a) > abs(a[0]) * np.linalg.norm(b) * (1 + 1e-9):
        a, b = b, a
    a = a if a[0] > 0 else -a
    b = b if a[0] * b[1] - a[1] * b[0] > 0 else -b
    return np.array([a, b]) + 0.0


def _score(border: Border, nodes: Any, pair: Floats, area: float) -> float:
    """Tell how much of the border comes to lie on itself; of equals, those on which nodes meet are better."""
    around = [sign * by for by in (*pair, pair.sum(0), pair[0] - pair[1]) for sign in (1, -1)]
    covered = np.max([border.fits(by) for by in around], axis=0)
    met = [
        np.isfinite(nodes.query(nodes.data - by, distance_upper_bound=border.tolerance)[0]) for by in around
    ]
    off = abs(np.linalg.det(pair) / area - 1)
    longest = np.linalg.norm(pair, axis=1).sum() / np.sqrt(area)
    return float(covered.mean() + 0.1 * np.sum(met) / len(nodes.data) - off - 0.01 * longest)


def _lengths(ring: Floats) -> Floats:
    lengths: Floats = np.linalg.norm(np.roll(ring, -1, 0) - ring, axis=1)
    return lengths


def _evenly(ring: Floats, n: int) -> tuple[Floats, Floats]:
    """Evenly spaced points along a ring, n of them, and its direction there."""
    lengths = _lengths(ring)
    before = np.r_[0.0, lengths.cumsum()]
    along = (np.arange(n) + 0.5) * before[-1] / n
    k = np.clip(np.searchsorted(before, along, side="right") - 1, 0, len(ring) - 1)
    directions = (np.roll(ring, -1, 0) - ring)[k] / lengths[k, None]
    return ring[k] + directions * (along - before[k])[:, None], directions
