"""Power cells: which seed each vertex belongs to, with weights that give every cell its area."""

from typing import Any, NamedTuple

import numpy as np

from meshjig.mesh.measure import sums
from meshjig.mesh.types import Floats, Ints

__all__ = ["PowerField", "balance"]

_STEP = 0.35  # of the squared spacing: the largest change of a weight at once
_ROUNDS = 12
_CLOSE = 0.004  # standard deviation of area over target at which it is well


class PowerField(NamedTuple):
    """For every vertex the seeds near it, and squared distance less weight for each of them."""

    seed: Ints  # (n, k), -1 where there are fewer
    value: Floats  # (n, k), mm2; infinite there

    def at(self, vertex: Ints, seed: Ints) -> Floats:
        """Look up the values (m,) of seeds (m,) at vertices (m,); infinite where a seed is far."""
        hit = self.seed[vertex] == seed[:, None]
        value = self.value[vertex, hit.argmax(1)]
        return np.where(hit.any(1), value, np.inf)

    @property
    def owner(self) -> Ints:
        """Give the seed of least value at every vertex, (n,)."""
        return np.take_along_axis(self.seed, self.value.argmin(1)[:, None], 1)[:, 0]


def balance(
    near: tuple[Ints, Floats],
    points: Floats,
    area: Floats,
    target: Floats,
    weights: Floats,
) -> tuple[Floats, PowerField]:
    """Find weights that give the power cells of seeds the areas asked for.

    Newton's method: along the border of two cells, area moves from one to the other in proportion to
    the difference of their weights. A vertex near a border counts for both cells in part, so that areas
    change smoothly.

    Parameters
    ----------
    near : the seeds near each vertex, (n, k), and their distances, mm
    points : (N, 3) float64, mm, the seeds
    area : (n,) float64, mm2, of each vertex
    target : (N,) float64, mm2
    weights : (N,) float64, mm2, the start

    Returns
    -------
    weights : (N,) float64, mm2
    field : PowerField

    References
    ----------
    Aurenhammer, Hoffmann and Aronov, "Minkowski-Type Theorems and Least-Squares Clustering", 1998.
    """
    seed, distance = near
    squared = distance**2
    size = float(target.mean())
    best, best_spread, step, share = weights, np.inf, np.zeros(len(target)), 1.0
    for _ in range(_ROUNDS):
        found, slope = _areas(seed, squared - np.append(weights, 0.0)[seed], points, area, size)
        spread = float((found / target - 1).std())
        if spread < best_spread:
            best, best_spread, share = weights, spread, min(1.0, 2 * share)
            step = _solve(slope, target - found)
        else:
            share /= 4
        if best_spread < _CLOSE:
            break
        weights = best + np.clip(share * step, -_STEP * size, _STEP * size)
        weights = weights - weights.mean()
    return best, PowerField(seed, squared - np.append(best, 0.0)[seed])


def _areas(seed: Ints, value: Floats, points: Floats, area: Floats, size: float) -> tuple[Floats, Any]:
    """Give the area of every cell, and how areas change with weights."""
    from scipy.sparse import coo_matrix, diags

    n, rows = len(points), np.arange(len(seed))
    first = value.argmin(1)
    least = value[rows, first]
    rest = value.copy()
    rest[rows, first] = np.inf
    second = rest.argmin(1)
    gap = rest[rows, second] - least  # infinite where there is only one
    a, b = seed[rows, first], seed[rows, second]
    radius = np.sqrt(area / np.pi)
    apart = np.maximum(np.linalg.norm(points[a] - points[b], axis=1), 0.5 * np.sqrt(size))
    fade = 4 * apart * radius  # the gap over which a vertex goes over from one cell to the other, twice
    share = np.clip(0.5 + gap / fade, 0.5, 1.0)
    total = sums(a, area * share, n)
    edge = np.flatnonzero((share < 1.0) & (b >= 0))
    a, b = a[edge], b[edge]
    total += sums(b, (area * (1 - share))[edge], n)
    W = coo_matrix(((area / fade)[edge], (a, b)), shape=(n, n)).tocsr()
    W = W + W.T
    return total, (diags(np.asarray(W.sum(1)).ravel()) - W).tocsc()


def _solve(slope: Any, missing: Floats) -> Floats:
    from scipy.sparse import identity
    from scipy.sparse.linalg import splu

    held = slope + 0.01 * identity(len(missing), format="csc")  # weights have no zero of their own
    step: Floats = splu(held).solve(missing)
    return np.where(np.isfinite(step), step, 0.0)
