"""Flatten the bands of a tube on its proxy, and transfer them to the mesh."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from meshjig.charts.chart import Chart, uncut_chart
from meshjig.charts.distortion import border_is_simple, is_unflipped, usable_share
from meshjig.charts.flatten.flatten import flatten
from meshjig.charts.flatten.untangle import separate_border, untangle
from meshjig.charts.segment.segment import segment
from meshjig.charts.segment.split import flatten_or_split
from meshjig.charts.transfer.transfer_labels import transfer_labels, transfer_uv
from meshjig.charts.tubes.cut_annulus import annulus_of, cut_annulus, meets_itself, untangle_annulus
from meshjig.charts.tubes.ring import flatten_ring, ring_stretch
from meshjig.charts.tubes.tube_decomposition import Kind
from meshjig.errors import ChartError
from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.components import is_disc
from meshjig.mesh.halfedges import compact
from meshjig.mesh.measure import face_areas, singular_values
from meshjig.mesh.mesh import Mesh
from meshjig.mesh.types import UV_GRID

__all__ = ["FlatBand", "flat_band", "transfer_band"]


_PERIOD_STEP = 2.0**-8  # mm


class FlatBand(NamedTuple):
    """A band of the proxy, flattened: a ring as one chart, an end as one or more."""

    faces: Ints  # (k,), of the proxy
    parts: list[tuple[Ints, Floats]]  # rows of faces, and uv of the vertices that compact() keeps
    left: Bools | None  # (k, 3), of a ring
    period: float  # mm, of a ring
    share: float  # of the area within FLAT_LIMITS; 0 where a chart is not sound


def flat_band(W: Floats, G: Ints, faces: Ints, left: Bools, kind: Kind, seed: int) -> FlatBand:
    """Flatten one band.

    Parameters
    ----------
    W, G : (n, 3) float64, mm, and (m, 3) int64, the proxy
    faces : (k,) int64
    left : (m, 3) bool, corners on the left of a line along the tube
    kind : str
    seed : int
    """
    H, kept = compact(G[faces])
    X = W[kept]
    every = np.arange(len(faces))
    if kind == "ring":
        ring = flatten_ring(X, H, left[faces])
        share = usable_share(face_areas(X, H), ring_stretch(X, H, left[faces], ring))
        if not _is_sound(H, ring.uv, ring.period):
            share = 0.0
        return FlatBand(faces, [(every, ring.uv)], left[faces], ring.period, share)
    label = segment(X, H, seed=seed) if kind == "rest" else np.zeros(len(faces), np.int64)
    parts, good = [], 0.0
    for k in range(int(label.max()) + 1):
        rows = np.flatnonzero(label == k)
        D, own = compact(H[rows])
        uv = _flattened(X[own], D)
        if uv is None:
            return FlatBand(faces, [], None, 0.0, 0.0)
        parts.append((rows, uv))
        area = face_areas(X[own], D)
        good += usable_share(area, singular_values(X[own], D, uv)) * area.sum()
    return FlatBand(faces, parts, None, 0.0, good / max(float(face_areas(X, H).sum()), 1e-300))


def transfer_band(mesh: Mesh, faces: Ints, proxy: Mesh, flat: FlatBand, seed: int) -> list[Chart]:
    """Make charts of the mesh from a band of its proxy.

    Parameters
    ----------
    mesh : Mesh
    faces : (k,) int64, the band on the mesh
    proxy : Mesh, the mesh itself where it is small
    flat : FlatBand
    seed : int

    Raises
    ------
    ChartError
        A ring comes out folded, or meets itself.
    """
    if flat.left is not None:
        return [_transferred_ring(mesh, faces, proxy, flat)]
    F = mesh.F
    of_face = np.zeros(len(faces), np.int64)
    if len(flat.parts) > 1:
        of_proxy = np.empty(len(flat.faces), np.int64)
        for k, (rows, _) in enumerate(flat.parts):
            of_proxy[rows] = k
        parts = _submesh(mesh, faces), _submesh(proxy, flat.faces)
        of_face = of_proxy if proxy is mesh else transfer_labels(*parts, of_proxy)
    charts = []
    for k, (rows, uv) in enumerate(flat.parts):
        own = faces[of_face == k]
        if not len(own):
            continue
        found = uv if proxy is mesh else _transferred_disc(mesh, own, proxy, flat.faces[rows], uv)
        some = [(own, found)] if found is not None else flatten_or_split(mesh.V, F, own, "slim", seed)
        charts += [uncut_chart(F, chart, places) for chart, places in some]
    return charts


def _flattened(X: Floats, H: Ints) -> Floats | None:
    """Flatten a disc; None where it is none, folds or overlaps itself."""
    if not is_disc(H):
        return None
    try:
        uv = flatten(X, H)
    except ChartError:
        return None
    return uv if border_is_simple(uv, H) else None


def _is_sound(H: Ints, uv: Floats, period: float) -> bool:
    try:
        annulus = annulus_of(H)
        opened = cut_annulus(annulus, uv, period)
    except ChartError:
        return False
    return is_unflipped(opened.uv, opened.corners) and not meets_itself(annulus, opened, period)


def _submesh(mesh: Mesh, faces: Ints) -> Mesh:
    F, kept = compact(mesh.F[faces])
    return Mesh(mesh.V[kept], F)


def _transferred_disc(mesh: Mesh, faces: Ints, proxy: Mesh, there: Ints, uv: Floats) -> Floats | None:
    """Give faces of the mesh the map of those of its proxy; None where that makes no sound chart."""
    V, F = _submesh(mesh, faces)
    if not is_disc(F):
        return None
    W, G = _submesh(proxy, there)
    uv = separate_border(V, F, untangle(V, F, transfer_uv(V, W, G, uv)))
    return uv if is_unflipped(uv, F) and border_is_simple(uv, F) else None


def _transferred_ring(mesh: Mesh, faces: Ints, proxy: Mesh, flat: FlatBand) -> Chart:
    X, H = _submesh(mesh, faces)
    annulus, uv, period = annulus_of(H), flat.parts[0][1], flat.period
    if proxy is not mesh:
        W, D = _submesh(proxy, flat.faces)
        opened = cut_annulus(annulus_of(D), uv, period)
        Y = np.append(W, W[opened.line], axis=0)
        uv = untangle_annulus(X, annulus, transfer_uv(X, Y, opened.corners, opened.uv), period)
    exact = max(1.0, np.rint(period / _PERIOD_STEP)) * _PERIOD_STEP
    opened = cut_annulus(annulus, np.rint(uv * [exact / period, 1.0] / UV_GRID) * UV_GRID, exact)
    if not is_unflipped(opened.uv, opened.corners) or meets_itself(annulus, opened, exact):
        x, y, z = X.mean(0)
        raise ChartError(
            f"a ring around ({x:.0f}, {y:.0f}, {z:.0f}) mm folds or overlaps itself when it is laid flat",
            hint="use --charts auto",
        )
    return Chart(faces, opened.uv, opened.corners, float(exact))
