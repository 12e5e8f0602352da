"""Knobs on the borders of cells: where they are, how large, and into which cell."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from meshjig.cells.knobs.knob_borders import Borders, cell_borders
from meshjig.cells.knobs.knob_choice import Choices, choose
from meshjig.cells.knobs.knob_cost import PLAIN, conflicts, costs, tilt_cost
from meshjig.cells.knobs.knob_curves import KnobCurves, knob_loops
from meshjig.cells.knobs.knob_places import LARGEST, Candidates, KnobSpec, Obstacles, candidates, cut_clean
from meshjig.cells.knobs.knob_shapes import SLIM, STOUT, WAVE, KnobShapes, knob_shapes
from meshjig.cells.knobs.surface_grid import Lift, surface_grid
from meshjig.mesh.measure import sums
from meshjig.mesh.types import Atlas, Bools, Floats, Ints, Knobs, Outlines

__all__ = ["KnobFacts", "KnobLayout", "WaysOut", "knob_outlines"]

_CLEAR = 0.07  # distance from borders and between knobs, in units of size
_GROUND = 0.05  # step of the grid of normals, in units of size
_SPACING = 0.6  # mm between points of a large knob
_COARSEST, _FINEST = 12, 40  # points on a quarter of a curve
_LENGTH = 7.6  # of a curve, in half widths of its head
_KEPT = {SLIM: (4, 3, 2), STOUT: (3, 2, 1), WAVE: (1, 0, 0)}  # candidates a side, by kind and rank
_LEAST_HEAD = 1.35  # necks
_CHANGED = 2.0  # cost of a knob on the other side than before
_TRIES = 5
_SHORT = 0.3  # in units of size, a border that need not have a knob


class WaysOut(NamedTuple):
    """In which order cells are put in, and the way that each goes out."""

    rank: Ints  # (n,), 0 for the first
    way: Floats  # (n, 3), unit

    def of_later(self, one: Ints, other: Ints) -> Floats:
        """Give the way of that of two cells (c,) each which is put in later, (c, 3)."""
        return self.way[np.where(self.rank[one] > self.rank[other], one, other)]


@dataclass(frozen=True)
class KnobFacts:
    """How many borders got what, for the report."""

    borders: int
    knobs: int
    stout_knobs: int  # with thick necks, for the sake of min_neck
    waves: int
    plain: int
    long_without_knob: int  # borders longer than 0.3 of size
    too_thin: int  # borders without a knob for which one with a thinner neck would fit


@dataclass(frozen=True)
class KnobLayout:
    """Knobs and waves as cuts through the planes of cells; labels are cells."""

    outlines: Outlines
    knobs: Knobs
    pairs: Ints  # (b, 2), the cells on either side of each border; two cells may share several
    length: Floats  # (b,), mm in space
    knob_of_border: Ints  # (b,), -1 where there is none
    moved: Ints  # (k, 2), the cell that gives up area to a knob or wave, and the one that gets it
    moved_mm2: Floats  # (k,)
    facts: KnobFacts


def knob_outlines(
    atlas: Atlas,
    *,
    size: float,
    knob_size: float = 1.0,
    min_neck: float = 0.0,
    random: float = 0.0,
    crease_aware: bool = False,
    seed: int = 0,
    like: KnobLayout | None = None,
    between: Ints | None = None,
    ways: WaysOut | None = None,
) -> KnobLayout:
    """Put a knob on every border between two cells where one fits.

    Every knob is drawn in the plane of the cell that it enters, as a closed loop that crosses the
    cell's border at its two feet only; its inside belongs to the cell next door. Sides are chosen so
    that areas come out even. Where a knob's neck would be too thin, the border gets a wave.

    Parameters
    ----------
    atlas : Atlas
        Each chart is a cell, a disc that is not mirrored in the plane; cells lie at least 4 mm apart.
    size : float, mm, edge of a square as large as a cell
    knob_size : float, relative to the usual, a head 0.37 of size wide
    min_neck : float, mm, in space
    random : float, 0 to 1, how unlike knobs are: their lean, height, side and size
    crease_aware : bool, rather have small knobs than such as wrap around creases
    seed : int
    like : KnobLayout, optional
        Of nearly the same cells: knobs shall enter the same ones again, so that cells which were made
        larger or smaller for their knobs' sake keep them.
    between : (k, 2) int64, optional
        Pairs of cells: no borders but theirs get a knob; all others count as what knobs keep clear of.
    ways : WaysOut, optional
        The order of cells, and the way that each goes out: knobs are where the surface faces that of the
        later cell.

    Returns
    -------
    KnobLayout

    Notes
    -----
    Whether knobs are clear of each other and of other borders is judged by discs that cover them.
    """
    rng = np.random.default_rng(seed)
    borders = cell_borders(atlas)
    if between is not None:
        borders = borders.between(between)
    spec = KnobSpec(size, knob_size, random)
    obstacles = _obstacles(atlas, borders, spec, min_neck, rng)
    found = candidates(obstacles, spec, rng)
    cost = costs(found, obstacles.grid, obstacles.shapes, spec, crease_aware, rng)
    if ways is not None:
        side = found.curves.side
        cost += tilt_cost(
            found.curves,
            obstacles.grid,
            obstacles.shapes,
            ways.of_later(borders.cell[side], borders.cell[borders.opposite(side)]),
        )
    if like is not None:
        cost += _CHANGED * ~_as_before(borders, found.curves, like)
    best = _best_of_each_side(found, cost, obstacles.shapes)
    found, cost = found.take(best), cost[best]
    cell_area = sums(atlas.chart_of_face, atlas.mesh.areas, atlas.n_charts)
    made, area = _chosen(obstacles, Lift(atlas), found.curves, cost, cell_area, rng)

    outlines, knobs = knob_loops(borders, obstacles.shapes, made)
    kind = obstacles.shapes.kind[made.shape]
    knob_of_border = np.full(len(borders.sides), -1)
    knob_of_border[borders.border[made.side[kind != WAVE]]] = np.arange(len(knobs.neck))
    without = knob_of_border < 0
    facts = KnobFacts(
        borders=len(borders.sides),
        knobs=len(knobs.neck),
        stout_knobs=int((kind == STOUT).sum()),
        waves=int((kind == WAVE).sum()),
        plain=len(borders.sides) - len(kind),
        long_without_knob=int((without & (borders.length > _SHORT * size)).sum()),
        too_thin=_too_thin(obstacles, spec, without, rng) if min_neck > 0 else 0,
    )
    moved = np.stack([borders.cell[made.side], borders.cell[borders.opposite(made.side)]], 1)
    return KnobLayout(
        outlines, knobs, borders.cell[borders.sides], borders.length, knob_of_border, moved, area, facts
    )


def _obstacles(
    atlas: Atlas, borders: Borders, spec: KnobSpec, min_neck: float, rng: np.random.Generator
) -> Obstacles:
    points = np.ceil(LARGEST * spec.s * spec.size * _LENGTH / _SPACING / 4)
    return Obstacles(
        borders,
        borders.lines(),
        borders.others(),
        borders.rims(),
        surface_grid(atlas, _GROUND * spec.s),
        knob_shapes(rng, spec.random, int(np.clip(points, _COARSEST, _FINEST))),
        max(_CLEAR * spec.s, min_neck / 2),
        min_neck,
    )


def _as_before(borders: Borders, c: KnobCurves, like: KnobLayout) -> Bools:
    """Tell which curves enter the same cell from the same cell as some of another layout."""
    n = max(int(borders.cell.max(initial=0)), int(like.pairs.max(initial=0))) + 1
    gives, takes = borders.cell[c.side], borders.cell[borders.opposite(c.side)]
    return np.isin(gives * n + takes, like.moved @ np.array([n, 1]))


def _best_of_each_side(found: Candidates, cost: Floats, shapes: KnobShapes) -> Ints:
    """Give the cheapest candidates of each side, of every kind and rank."""
    most = np.array([_KEPT[kind] for kind in (SLIM, STOUT, WAVE)])
    sort = shapes.kind[found.curves.shape] * most.shape[1] + found.rank
    group = found.curves.side * most.size + sort
    order = np.lexsort([cost, group])
    nth = np.arange(len(order)) - np.searchsorted(group[order], group[order])
    return np.sort(order[nth < most.ravel()[sort[order]]])


def _chosen(
    obstacles: Obstacles, lift: Lift, c: KnobCurves, cost: Floats, cell_area: Floats, rng: np.random.Generator
) -> tuple[KnobCurves, Floats]:
    """Choose a curve for each border that has one; give also the area that each moves, mm2."""
    b, n = obstacles.borders, len(obstacles.borders.sides)
    scale = obstacles.grid.scale(c.drawn(obstacles.shapes.discs[c.shape][..., :2]))[:, 1:].mean(1)
    area = obstacles.shapes.area[c.shape] * (c.radius * scale) ** 2
    plain = np.zeros(n)
    choices = Choices(
        np.concatenate([b.border[c.side], np.arange(n)]),
        np.concatenate([cost, plain + PLAIN]),
        b.cell[np.concatenate([c.side, b.sides[:, 0]])],
        b.cell[np.concatenate([b.opposite(c.side), b.sides[:, 1]])],
        np.concatenate([area, plain]),
    )
    near = conflicts(obstacles, c)
    picked = choose(choices, near, cell_area, n, rng)
    for _ in range(_TRIES):
        made = picked[picked < len(area)]
        curves = c.take(made)
        good = cut_clean(obstacles, curves) & _holds(obstacles, lift, curves)
        if good.all():
            break
        choices.cost[made[~good]] = np.inf
        picked = choose(choices, near, cell_area, n, rng, picked)
    return curves.take(good), area[made[good]]


def _holds(obstacles: Obstacles, lift: Lift, c: KnobCurves) -> Bools:
    """Tell which curves are waves, or have thick enough necks and yet wider heads, in space."""
    points = c.drawn(obstacles.shapes.points[c.shape])
    neck, head = (
        lift.widths(points[:, list(pair)]) for pair in (obstacles.shapes.neck, obstacles.shapes.head)
    )
    wave = obstacles.shapes.kind[c.shape] == WAVE
    return wave | ((neck >= obstacles.least_neck) & (head >= _LEAST_HEAD * neck))


def _too_thin(obstacles: Obstacles, spec: KnobSpec, without: Bools, rng: np.random.Generator) -> int:
    """Count the borders of some that could have a knob if its neck might be thinner."""
    freely = candidates(
        obstacles._replace(least_neck=0.0), spec, rng, without[obstacles.borders.border]
    ).curves
    knobs = freely.side[obstacles.shapes.kind[freely.shape] != WAVE]
    possible = np.zeros(len(without), bool)
    possible[obstacles.borders.border[knobs]] = True
    return int((without & possible).sum())
