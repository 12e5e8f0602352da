"""Knobs across the seams between charts, where tiles meet along a plain line."""

from __future__ import annotations

import logging
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from meshjig.cells import CellMesh, cell_atlas, knob_outlines
from meshjig.cut import ComposedCut, merge_periodic, overlay
from meshjig.layout.interlock import Interlock, interlock
from meshjig.layout.layout import Layout, cut_again
from meshjig.layout.seam_smoothing import smooth_seams
from meshjig.layout.stitch import region_graph
from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.halfedges import compact
from meshjig.mesh.measure import barycentric, face_areas, interpolate
from meshjig.mesh.types import Knobs, Mesh
from meshjig.options import Options

__all__ = ["add_seam_knobs"]

log = logging.getLogger("meshjig")

LONG = 0.3  # edges of a mean piece: shorter borders need no knob
MOSTLY = 0.5  # of a border: a border is a seam's when that much of it lies on seams
HEAD = 0.37  # edges of a mean piece: the usual width of a head on a seam
OF_NECK = 2.4  # least necks: the width of a head at which a knob may still be made smaller for want of room
SIZES = (0.5, 1.4)  # relative to the usual width, for the sake of looking like the tiles' own


def add_seam_knobs(layout: Layout, options: Options, random: float, seed: int) -> Layout:
    """Even out seams, and give pieces that meet along one a knob where there is room for it.

    The pieces on both sides are taken for cells: each is flattened by itself, knobs are laid out in
    these planes clear of the pieces' other borders and knobs, and the surface is cut once more.

    Parameters
    ----------
    layout : Layout, made of tiles
    options : Options
    random : float, 0 to 1, how unlike knobs are
    seed : int

    Returns
    -------
    Layout
        Of the same pieces. The stitching's facts tell how many borders lie on seams (seam_borders) and
        how many of those have a knob now (seam_knobs).
    """
    locks = interlock(merge_periodic(layout.cut, layout.outlines), layout.knobs, layout.piece_of_face)
    size = float(np.sqrt(face_areas(layout.cut.V, layout.cut.F).sum() / layout.stitching.n_pieces))
    pairs = _plain_over_seams(layout, locks, LONG * size)
    layout, discs = smooth_seams(layout)
    piece_of_cell, cells, chosen, kept = _as_cells(layout, discs, pairs)
    number = np.full(layout.stitching.n_pieces, -1)
    number[piece_of_cell] = np.arange(len(piece_of_cell))
    between = number[pairs]
    between = between[(between >= 0).all(1)]
    n_knobs, least_neck = 0, options.min_neck + options.clearance
    if len(between):
        atlas = cell_atlas(cells, _in_plane(layout, chosen))
        knobs = knob_outlines(
            atlas,
            size=size,
            knob_size=_like_the_others(locks, size, least_neck) * options.knob_size,
            min_neck=least_neck,
            random=random,
            seed=seed,
            between=between,
        )
        log.info("seams: %s, flattened %s", knobs.facts, atlas.facts)
        n_knobs = knobs.facts.knobs
        n_segments = len(layout.outlines.segments)
        second = overlay(atlas, knobs.outlines)
        layout, further = cut_again(layout, chosen, kept, second, piece_of_cell)
        layout = replace(layout, knobs=_with_more(layout.knobs, knobs.knobs, further, n_segments))
    facts = replace(layout.stitching.facts, seam_borders=len(pairs), seam_knobs=n_knobs)
    return replace(layout, stitching=replace(layout.stitching, facts=facts))


def _plain_over_seams(layout: Layout, locks: Interlock, least: float) -> Ints:
    """Find pairs of pieces whose border is long, though no knob is on it for a seam's sake, (k, 2).

    Where tiles have knobs, that is any border without one; where their shapes hold each other, one that
    is mostly seam.
    """
    plain = (locks.knobs_of_pair == 0) & (locks.length > least)
    if not len(layout.knobs.neck):
        n = layout.stitching.n_pieces
        graph = region_graph(replace(layout.cut, region=layout.piece_of_face))
        seam = dict(zip((graph.pairs @ [n, 1])[graph.seam].tolist(), graph.length[graph.seam], strict=True))
        on_seam = np.array([seam.get(key, 0.0) for key in (locks.pairs @ [n, 1]).tolist()])
        plain &= on_seam > MOSTLY * locks.length
    return locks.pairs[plain]


class _AsCells(NamedTuple):
    """Some pieces as cells."""

    piece: Ints  # (n,), the piece that a cell is
    cells: CellMesh
    chosen: Ints  # (m,), its faces in the cut mesh
    kept: Ints  # (v,), its vertices there


def _as_cells(layout: Layout, discs: Bools, pairs: Ints) -> _AsCells:
    """Take the pieces of some pairs for cells; those that are no discs are left out."""
    cut, piece = layout.cut, layout.piece_of_face
    wanted = np.zeros(len(discs), bool)
    wanted[pairs[discs[pairs].all(1)]] = True
    chosen = np.flatnonzero(wanted[piece])
    F, kept = compact(cut.F[chosen])
    cell = (np.cumsum(wanted) - 1)[piece[chosen]]
    mesh = Mesh(cut.V[kept], F)
    places = cut.vertex_face[kept], cut.vertex_bary[kept]
    cells = CellMesh(mesh, cut.of, cut.parent[chosen], *places, cell)
    return _AsCells(np.flatnonzero(wanted), cells, chosen, kept)


def _in_plane(layout: Layout, chosen: Ints) -> Floats:
    """Give the places in the charts of the corners of some faces of the cut mesh, (k, 3, 2), mm."""
    atlas, cut = layout.atlas, layout.cut
    parent, vertex = np.repeat(cut.parent[chosen], 3), cut.F[chosen].ravel()
    bary = barycentric(atlas.mesh.V, atlas.mesh.F, parent, cut.V[vertex])
    return interpolate(atlas.uv, atlas.F_uv, parent, bary).reshape(-1, 3, 2)


def _like_the_others(locks: Interlock, size: float, least_neck: float) -> float:
    """Give the size of knobs, relative to the usual one, at which they look like those there are.

    They are larger where they have to be for their necks.
    """
    head = float(np.median(locks.head)) if len(locks.head) else HEAD * size
    return float(np.clip(max(head, OF_NECK * least_neck) / (HEAD * size), *SIZES))


def _with_more(knobs: Knobs, more: Knobs, further: ComposedCut, n_segments: int) -> Knobs:
    """Add knobs of the second outlines to those of the first, which have that many segments."""
    edge, on_none = knobs.edge, np.full(len(more.neck), -1)
    return Knobs(
        np.concatenate([knobs.neck, further.point[more.neck]]),
        np.concatenate([knobs.head, further.point[more.head]]),
        np.concatenate([knobs.span, n_segments + np.searchsorted(further.part_of, more.span)]),
        None if edge is None else np.concatenate([edge, on_none]),
    )
