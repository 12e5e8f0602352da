"""The layout of planar tiles: from an atlas to a surface cut into pieces."""

from __future__ import annotations

import logging
from dataclasses import replace

import numpy as np

from meshjig.cut import overlay
from meshjig.layout.congruent import LEAST_DIFFERENCE, clashes
from meshjig.layout.layout import Layout
from meshjig.layout.necks.divide import divide_at_necks
from meshjig.layout.seam_knobs import add_seam_knobs
from meshjig.layout.stitch import region_graph, stitch
from meshjig.layout.tile_size import TileChoice, choose_tiles
from meshjig.mesh.arrays import Ints
from meshjig.mesh.measure import face_areas
from meshjig.mesh.types import Atlas
from meshjig.options import Options
from meshjig.runtime.progress import Stages
from meshjig.tiling import TileStyle, Unit, tile_surface
from meshjig.tiling.families.polyomino import SQUARES
from meshjig.tiling.registry import get_family

__all__ = ["tile_layout"]

log = logging.getLogger("meshjig")

WITHIN = 0.07  # of the wanted number of pieces; more off than that, the tiles are sized again
TRIES = 3
REDRAWN = 12  # times at most that knobs are drawn again to make borders unlike each other
THIN = 0.05  # of a tile's edge: what the gap leaves so thin, or half as thin as a wall, is a neck
DIFFERENT = 0.5  # how random tiles are at least when each has to be unique


def tile_layout(atlas: Atlas, options: Options, stages: Stages) -> Layout:
    """Tile, cut and stitch; again with other tiles when the number of pieces is too far off.

    Parameters
    ----------
    atlas : Atlas
    options : Options
    stages : Stages, hears of tiling, cut, stitch and seams
    """
    unit = get_family(options.tile, options.seed, _columns(atlas, options))
    wanted, angle = options.pieces, options.angle
    tried: list[Layout] = []
    chosen: list[TileChoice] = []
    for _ in range(TRIES):
        with stages("tiling"):
            choice = choose_tiles(
                atlas,
                wanted,
                options.stitch,
                _least_border(options),
                options.piece_size,
                unit=unit,
                angle=angle,
            )
        layout = _cut(atlas, unit, choice, options, stages)
        tried.append(layout)
        chosen.append(choice)
        n = layout.stitching.n_pieces
        log.info("tiles of %.2f mm give %d pieces (%d expected)", choice.size, n, choice.expected)
        if options.piece_size or abs(n - options.pieces) <= WITHIN * options.pieces:
            break
        wanted = max(1, round(wanted * options.pieces / n))
    best = int(np.argmin([abs(layout.stitching.n_pieces - options.pieces) for layout in tried]))
    if not options.unique:
        return _finished(tried[best], options, stages)
    return _without_clashes(tried[best], unit, chosen[best], options, stages)


def _cut(
    atlas: Atlas,
    unit: Unit,
    choice: TileChoice,
    options: Options,
    stages: Stages,
    turns: Ints | None = None,
) -> Layout:
    least_border = _least_border(options)
    with stages("tiling"):
        tiling = tile_surface(
            atlas,
            choice.size,
            unit=unit,
            placings=choice.placings,
            pole=options.pole,
            style=TileStyle(least_border, _random(options), options.random_style, options.seed, turns),
        )
    with stages("cut"):
        cut = overlay(atlas, tiling.outlines)
    with stages("stitch"):
        graph = region_graph(cut)
        capstones = np.unique(cut.region[np.isin(cut.label, tiling.capstones)])
        stitching = stitch(graph, options.stitch, choice.size**2, least_border, options.min_piece, capstones)
    if tiling.poles:
        stitching = replace(stitching, facts=replace(stitching.facts, poles=tiling.poles))
    return Layout(atlas, tiling.outlines, tiling.knobs, cut, stitching)


def _finished(layout: Layout, options: Options, stages: Stages, turn: int = 0) -> Layout:
    """Even out seams, give pieces that meet along them their knobs, and cut off what hangs on by little.

    Knobs on seams are drawn again at every turn.
    """
    if options.clearance_method == "domain":  # as published
        return layout
    with stages("seams"):
        layout = add_seam_knobs(layout, options, _random(options), options.seed + turn)
    if options.clearance_method != "solid":  # there the gap is a band along cuts and seams alone
        return layout
    with stages("stitch"):
        size = float(np.sqrt(face_areas(layout.cut.V, layout.cut.F).sum() / layout.stitching.n_pieces))
        narrowest = options.clearance + min(options.min_wall / 2, THIN * size)
        cut, stitching = divide_at_necks(layout.cut, layout.stitching, narrowest, options.min_piece)
        return replace(layout, cut=cut, stitching=stitching)


def _least_border(options: Options) -> float:
    """Give the length of a border, mm, over which a join would be too weak: the gap takes some of it."""
    return options.min_neck + options.clearance


def _random(options: Options) -> float:
    return max(options.random, DIFFERENT if options.unique else 0.0)


def _without_clashes(
    layout: Layout, unit: Unit, choice: TileChoice, options: Options, stages: Stages
) -> Layout:
    """Draw knobs again for as long as borders look alike."""
    turns = np.zeros(0, np.int64)
    best, fewest = layout, np.inf
    for turn in range(REDRAWN):
        layout = _finished(layout, options, stages, turn)
        with stages("unique"):
            edges, facts = clashes(layout, max(options.clearance, LEAST_DIFFERENCE))
        log.info("unique: %s", facts)
        if facts.congruent_borders < fewest:
            best, fewest = layout, facts.congruent_borders
        if not len(edges):
            break
        turns = np.concatenate([turns, np.zeros(max(0, int(edges.max()) + 1 - len(turns)), np.int64)])
        turns[edges] += 1
        layout = _cut(layout.atlas, unit, choice, options, stages, turns)
    return best


def _columns(atlas: Atlas, options: Options) -> int | None:
    """Give how many unit squares go round the largest periodic chart; None where there is none."""
    period = 0.0 if atlas.period is None else float(atlas.period.max())
    if period == 0:
        return None
    area = float(face_areas(atlas.mesh.V, atlas.mesh.F).sum())
    square = (options.piece_size or float(np.sqrt(area / options.pieces))) / np.sqrt(SQUARES)
    return max(2, round(period / square))
