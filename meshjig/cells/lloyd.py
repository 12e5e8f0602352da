"""One pass from seeds to cells, and passes that make their areas more even."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from meshjig.cells.cell_mesh import CellFacts, Seeds, ThinLimb
from meshjig.cells.distances import smooth_distances, within
from meshjig.cells.extract import Extracted, extract
from meshjig.cells.power import balance
from meshjig.cells.repair_topology import Pair
from meshjig.cells.sample_seeds import centred
from meshjig.cells.surface import Surface
from meshjig.mesh.measure import sums
from meshjig.mesh.types import Floats, Ints

__all__ = ["Grown", "evened", "grown_again", "grown_from", "settled"]

_MANY = 0.15  # of the cells: with more pairs than that, limbs and holes are everywhere
_EVEN = 0.03  # standard deviation of areas over their mean that is well
_GAIN = 0.7  # of what is missing: the rest comes by itself
_ROUNDS = 3


class Grown(NamedTuple):
    """Cells, and the seeds to grow them from again."""

    extracted: Extracted
    seeds: Seeds

    @property
    def areas(self) -> Floats:
        """Give the areas of cells over their mean, (N,)."""
        cut = self.extracted.cut
        area = sums(cut.cell, cut.mesh.areas, self.extracted.n)
        return area / area.mean()

    @property
    def n_bad(self) -> int:
        """Count the cells that are no discs."""
        return int((~self.extracted.good).sum())

    def facts(self, s: Surface) -> CellFacts:
        """Say how many cells there are, and where limbs are thin, with the number that fits them."""
        around = np.pi * np.linalg.norm(self.seeds.poles[:, 0] - self.seeds.poles[:, 1], axis=1)
        cure = np.ceil(s.area.sum() / np.maximum(0.9 * around, 1e-9) ** 2)
        limbs = [
            ThinLimb([round(float(x), 1) for x in at], int(pieces))
            for at, pieces in zip(self.seeds.poles.mean(1), cure, strict=True)
        ]
        return CellFacts(self.extracted.n, self.extracted.n - len(self.seeds.points), limbs)


def settled(s: Surface, seeds: Ints, spacing: float) -> Ints:
    """Move seeds (N,) to the middle of power cells of equal area."""
    near = within(s.V, s.graph, seeds, spacing)
    target = s.targets(seeds, np.ones(len(seeds)))
    _, field = balance(near, s.V[seeds], s.area, target, np.zeros(len(seeds)))
    return centred(s.V, s.area, field.owner, len(seeds))


def grown_from(
    s: Surface,
    seeds: Ints,
    spacing: float,
    *,
    weights: Floats | None = None,
    pairs: list[Pair] | None = None,
    relative: Floats | None = None,
) -> Grown:
    """Grow cells from seeds.

    Parameters
    ----------
    s : Surface
    seeds : (n,) int64, vertices
    spacing : float, mm
    weights : (n,) float64, mm2, a start
    pairs : list of Pair, known from before
    relative : (N,) float64, the areas of cells relative to one another

    Returns
    -------
    Grown
    """
    n, pairs = len(seeds), pairs or []
    relative = np.ones(n) if relative is None else relative
    area = relative.copy()
    for pair in reversed(pairs):
        if pair.second >= n:  # a half that has no seed of its own
            area[pair.first] += area[pair.second]
    near = smooth_distances(s, within(s.V, s.graph, seeds, spacing), spacing)
    start = np.zeros(n) if weights is None else weights
    weights, field = balance(near, s.V[seeds], s.area, s.targets(seeds, area[:n]), start)
    extracted = extract(s, field, n, pairs, relative, spacing)
    cells = np.array([pair[:2] for pair in extracted.pairs], np.int64).reshape(-1, 2)
    poles = np.array([pair.poles for pair in extracted.pairs], np.int64).reshape(-1, 2)
    return Grown(extracted, Seeds(s.V[seeds], weights, cells, s.V[poles]))


def grown_again(s: Surface, start: Seeds, spacing: float, relative: Floats | None) -> Grown:
    """Grow the cells of an earlier result with other areas (N,)."""
    from scipy.spatial import cKDTree

    tree = cKDTree(s.V)
    seeds, poles = tree.query(start.points)[1], tree.query(start.poles.reshape(-1, 3))[1].reshape(-1, 2)
    pairs = [Pair(a, b, (p, q)) for (a, b), (p, q) in zip(start.pairs.tolist(), poles.tolist(), strict=True)]
    relative = np.ones(start.n_cells) if relative is None else relative
    return grown_from(s, seeds, spacing, weights=start.weights, pairs=pairs, relative=relative)


def evened(s: Surface, grown: Grown, spacing: float) -> Grown:
    """Grow again where cells that were joined and cut another way came out uneven."""
    best, relative = grown, np.ones(grown.extracted.n)
    for _ in range(_ROUNDS):
        few = 0 < len(grown.extracted.pairs) <= _MANY * grown.extracted.n
        if not few or grown.n_bad or best.areas.std() < _EVEN:
            break
        relative = np.append(relative, np.ones(grown.extracted.n - len(relative)))
        relative = relative * np.clip(grown.areas, 0.5, 2.0) ** -_GAIN
        grown = grown_again(s, grown.seeds, spacing, relative)
        best = min(best, grown, key=lambda g: (g.n_bad, g.extracted.n, g.areas.std()))
    return best
