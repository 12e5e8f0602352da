"""The gap between pieces, as a band of closed curves in the plane."""

from typing import Any, Literal

import numpy as np

from meshjig.cut.border_curves import PlaneCurves, SeamEdges, along_seams, cut_borders, seam_borders
from meshjig.mesh.arrays import next_in_loop, ranks, row_of
from meshjig.mesh.measure import area_vectors, unit
from meshjig.mesh.metric import face_metric
from meshjig.mesh.types import GAP, Atlas, CutMesh, Floats, Ints, Outlines

__all__ = ["gap_outlines"]

WIDTH_STEP = 0.03  # stretches whose half widths lie within this factor share one buffer
STRAIGHT = 0.01  # of the clearance, that a border may be off when it is drawn with fewer points
SIMPLE = {"stretch": 0.02, "domain": 0.05}  # of the clearance, that the band's rim may be off
STEP = {"stretch": 1 / 6, "domain": 1 / 3}  # of the clearance, between discs beyond a seam
DISC = 5  # the same, of a disc beyond a seam
WIDEST = 1.7  # times the half clearance, on either side of a crease
ARC = {"stretch": 5, "domain": 2}  # corners of a quarter circle


def gap_outlines(
    atlas: Atlas,
    cut: CutMesh,
    outlines: Outlines,
    piece_of_face: Ints,
    clearance: float,
    method: Literal["stretch", "domain"] = "stretch",
) -> Outlines:
    """Outline a band of constant width around every border between two pieces.

    With ``stretch`` the width in the plane makes up for the stretch of the chart, so that the gap on
    the surface is the clearance. With ``domain`` the width in the plane is the clearance itself.
    Along a crease the band is wider, since the gap is measured straight from piece to piece.
    A band that runs over a seam where a piece goes on is carried to the chart on the other side.

    Parameters
    ----------
    atlas : Atlas
    cut : CutMesh, the atlas' mesh cut along the outlines at zero width
    outlines : Outlines
    piece_of_face : (m,) int64, for the faces of cut
    clearance : float, mm, the whole gap
    method : "stretch" or "domain"

    Returns
    -------
    Outlines, closed curves; GAP inside the band, 0 outside

    References
    ----------
    Elber and Kim, "Synthesis of 3D Jigsaw Puzzles over Freeform 2-Manifolds", section 3.1.2, for the
    offset in the domain.
    """
    import shapely

    curves = cut_borders(cut, outlines, piece_of_face)
    seams = seam_borders(atlas, cut, piece_of_face)
    curve_width = _widths(atlas, curves.start, curves.end, curves.parent, clearance, method)
    seam_width = _widths(atlas, seams.start, seams.end, seams.parent, clearance, method)
    if method == "stretch":
        seam_width *= _around_crease(atlas, seams)
    seam_curves, row = along_seams(seams)
    shapes = np.concatenate(
        [
            _buffered(curves, curve_width, clearance, ARC[method]),
            _buffered(seam_curves, seam_width[row], clearance, ARC[method]),
            _carried_over(curves, seams, seam_width, clearance, STEP[method]),
        ]
    )
    return _as_outlines(_simple(shapely.union_all(shapes), SIMPLE[method] * clearance), clearance)


def _widths(atlas: Atlas, start: Floats, end: Floats, parent: Ints, clearance: float, method: str) -> Floats:
    if method == "domain":
        return np.full(len(start), clearance / 2)
    width = _half_width(face_metric(atlas, parent), end - start, clearance)
    return np.clip(width, clearance / 6, 1.5 * clearance)


def _half_width(metric: Floats, tangent: Floats, clearance: float) -> Floats:
    """Give the distance in the plane that is half a clearance on the surface, across a curve.

    Parameters
    ----------
    metric : (k, 3) float64, see `face_metric`
    tangent : (k, 2) float64, the curve's direction in the plane
    clearance : float, mm

    Returns
    -------
    (k,) float64, mm in the plane: (c / 2) |J t| / det J for a unit tangent t
    """
    t = tangent / np.maximum(np.linalg.norm(tangent, axis=1), 1e-300)[:, None]
    along = metric[:, 0] * t[:, 0] ** 2 + 2 * metric[:, 1] * t[:, 0] * t[:, 1] + metric[:, 2] * t[:, 1] ** 2
    det = np.sqrt(np.maximum(metric[:, 0] * metric[:, 2] - metric[:, 1] ** 2, 1e-12))
    return clearance / 2 * np.sqrt(np.maximum(along, 1e-12)) / det


def _around_crease(atlas: Atlas, seams: SeamEdges) -> Floats:
    """Give the factor that keeps the straight gap when both sides of a seam turn away from each other."""
    mesh = atlas.mesh
    normal = unit(area_vectors(mesh.V, mesh.F[seams.parent]))
    cos = np.einsum("ij,ij->i", normal, normal[seams.mate])
    return 1 / np.sqrt(np.clip((1 + cos) / 2, WIDEST**-2, 1))


def _buffered(curves: PlaneCurves, width: Floats, clearance: float, arc: int) -> np.ndarray:
    """Buffer runs of stretches that follow each other and have nearly the same width."""
    import shapely

    length = np.linalg.norm(curves.end - curves.start, axis=1)
    run = np.cumsum(~curves.follows) - 1
    step = np.rint(np.log(_smooth(width, length, run) * 2 / clearance) / WIDTH_STEP)
    new = ~curves.follows
    new[1:] |= step[1:] != step[:-1]
    first = np.flatnonzero(new)
    if not len(first):
        return np.zeros(0, object)
    group = np.cumsum(new) - 1
    last = np.append(first[1:], len(new)) - 1
    points = np.vstack([curves.start, curves.end[last]])
    line = np.concatenate([group, np.arange(len(first))])
    order = np.argsort(line, kind="stable")
    lines = shapely.linestrings(points[order], indices=line[order])
    half = clearance / 2 * np.exp(step[first] * WIDTH_STEP)
    lines = shapely.simplify(lines, STRAIGHT * clearance, preserve_topology=False)
    return shapely.buffer(lines, half, quad_segs=arc)


def _simple(band: Any, tolerance: float) -> Any:
    """Draw a band with fewer points; the quick way hardly ever makes rims cross, and then it won't do."""
    import shapely

    quick = shapely.simplify(band, tolerance, preserve_topology=False)
    return quick if shapely.is_valid(quick) else shapely.simplify(band, tolerance)


def _smooth(width: Floats, length: Floats, run: Ints) -> Floats:
    """Average the width along each run over about half a millimetre, so that noise cancels out."""
    cell = run * 1_000_000 + np.floor(np.cumsum(length) / 0.5).astype(np.int64)
    _, where = np.unique(cell, return_inverse=True)
    weight = np.maximum(length, 1e-9)
    mean = np.bincount(where, weight * width) / np.bincount(where, weight)
    return mean[where]


def _carried_over(
    curves: PlaneCurves, seams: SeamEdges, width: Floats, clearance: float, step: float
) -> np.ndarray:
    """Give discs beyond inner seams where a border on this side is nearer than half the clearance."""
    import shapely
    from scipy.spatial import cKDTree

    inner = np.flatnonzero(~seams.active)
    if not len(inner) or not len(curves.start):
        return np.zeros(0, object)
    step = clearance * step
    row, t = _samples(seams.end[inner] - seams.start[inner], step)
    row = inner[row]
    seam_uv = seams.start[row] + (seams.end[row] - seams.start[row]) * t[:, None]
    reach = 1.5 * clearance + float(np.linalg.norm(seams.end[inner] - seams.start[inner], axis=1).max()) / 2
    apart, _ = cKDTree((seams.start[inner] + seams.end[inner]) / 2).query((curves.start + curves.end) / 2)
    beside = apart <= reach + np.linalg.norm(curves.end - curves.start, axis=1) / 2
    if not beside.any():
        return np.zeros(0, object)
    start, end = curves.start[beside], curves.end[beside]
    stretch, s = _samples(end - start, step)
    curve_uv = start[stretch] + (end[stretch] - start[stretch]) * s[:, None]
    ratio = clearance / 2 / width[row]  # mm on the surface for a mm in the plane
    distance, _ = cKDTree(curve_uv).query(seam_uv, distance_upper_bound=1.5 * clearance)
    left = clearance / 2 - distance * ratio
    near = left > 0.02 * clearance
    row, t = row[near], t[near]
    mate = seams.mate[row]
    beyond = seams.end[mate] + (seams.start[mate] - seams.end[mate]) * t[:, None]
    return shapely.buffer(shapely.points(beyond), left[near] * width[mate] * 2 / clearance, quad_segs=DISC)


def _samples(direction: Floats, step: float) -> tuple[Ints, Floats]:
    """Spread samples over segments: the segment of each, and its place from 0 to 1."""
    n = np.ceil(np.linalg.norm(direction, axis=1) / step).astype(np.int64) + 1
    row = row_of(n)
    return row, ranks(n) / np.maximum(n[row] - 1, 1)


def _as_outlines(band: Any, clearance: float) -> Outlines:
    """Give the band's border, band to the left, without islands too small to be a piece."""
    import shapely

    rings = shapely.get_rings(shapely.orient_polygons(shapely.get_parts(band)))
    rings = rings[shapely.area(shapely.polygons(rings)) > clearance**2]
    points, ring = shapely.get_coordinates(rings, return_index=True)
    repeats_first = np.append(ring[1:] != ring[:-1], True)[: len(ring)]
    points, ring = points[~repeats_first], ring[~repeats_first]
    following = next_in_loop(np.bincount(ring, minlength=len(rings)))
    segments = np.stack([np.arange(len(points)), following], 1)
    return Outlines(points, segments, np.full(len(points), GAP), np.zeros(len(points), np.int64))
