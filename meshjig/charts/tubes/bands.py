"""Flatten the bands of a tube on its proxy, and carry them over to the mesh."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from meshjig.charts.chart import Chart, plain
from meshjig.charts.distortion_limits import fair_share
from meshjig.charts.flatten.flatten import border_is_simple, flatten, is_unflipped
from meshjig.charts.flatten.separate_border import part
from meshjig.charts.flatten.untangle import untangle
from meshjig.charts.segment.flatten_or_split import rescue
from meshjig.charts.segment.segment import segment
from meshjig.charts.transfer.transfer_labels import transfer_labels, transfer_uv
from meshjig.charts.tubes.cut_annulus import meets_itself, ring_net, settle, unroll
from meshjig.charts.tubes.ring import flatten_ring, ring_stretch
from meshjig.charts.tubes.tube_decomposition import Kind
from meshjig.errors import ChartError
from meshjig.mesh.components import is_disc
from meshjig.mesh.halfedges import compact
from meshjig.mesh.measure import face_areas, singular_values

__all__ = ["FlatBand", "carried", "flat_band"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]

_UV_STEP, _PERIOD_STEP = 2.0**-18, 2.0**-8  # mm


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
        share = fair_share(face_areas(X, H), ring_stretch(X, H, left[faces], ring))
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
        good += fair_share(area, singular_values(X[own], D, uv)) * area.sum()
    return FlatBand(faces, parts, None, 0.0, good / max(float(face_areas(X, H).sum()), 1e-300))


def carried(V: Floats, F: Ints, faces: Ints, W: Floats, G: Ints, flat: FlatBand, seed: int) -> list[Chart]:
    """Make charts of the mesh from a band of its proxy.

    Parameters
    ----------
    V, F : (n, 3) float64, mm, and (m, 3) int64, the mesh
    faces : (k,) int64, the band on the mesh
    W, G : (n', 3) float64, mm, and (m', 3) int64, the proxy; the mesh itself where it is small
    flat : FlatBand
    seed : int

    Raises
    ------
    ChartError
        A ring comes out folded, or meets itself.
    """
    if flat.left is not None:
        return [_carried_ring(V, F, faces, W, G, flat)]
    H, kept = compact(F[faces])
    of_face = np.zeros(len(faces), np.int64)
    if len(flat.parts) > 1:
        of_light = np.empty(len(flat.faces), np.int64)
        for k, (rows, _) in enumerate(flat.parts):
            of_light[rows] = k
        D, light = compact(G[flat.faces])
        of_face = of_light if G is F else transfer_labels(V[kept], H, W[light], D, of_light)
    charts = []
    for k, (rows, uv) in enumerate(flat.parts):
        own = faces[of_face == k]
        if not len(own):
            continue
        found = uv if G is F else _carried_disc(V, F[own], W, G[flat.faces[rows]], uv)
        some = [(own, found)] if found is not None else rescue(V, F, own, "slim", seed)
        charts += [plain(F, chart, places) for chart, places in some]
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
        net = ring_net(H)
        strip = unroll(net, uv, period)
    except ChartError:
        return False
    return is_unflipped(strip.uv, strip.corners) and not meets_itself(net, strip, period)


def _carried_disc(V: Floats, F: Ints, W: Floats, G: Ints, uv: Floats) -> Floats | None:
    """Give a chart of the mesh the map of its proxy; None where that makes no sound chart."""
    if not is_disc(F):
        return None
    (F, kept), (G, light) = compact(F), compact(G)
    V, W = V[kept], W[light]
    uv = part(V, F, untangle(V, F, transfer_uv(V, W, G, uv)))
    return uv if is_unflipped(uv, F) and border_is_simple(uv, F) else None


def _carried_ring(V: Floats, F: Ints, faces: Ints, W: Floats, G: Ints, flat: FlatBand) -> Chart:
    H, kept = compact(F[faces])
    net, X, uv, period = ring_net(H), V[kept], flat.parts[0][1], flat.period
    if G is not F:
        D, light = compact(G[flat.faces])
        strip = unroll(ring_net(D), uv, period)
        Y = np.append(W[light], W[light][strip.line], axis=0)
        uv = settle(X, net, transfer_uv(X, Y, strip.corners, strip.uv), period)
    exact = max(1.0, np.rint(period / _PERIOD_STEP)) * _PERIOD_STEP
    strip = unroll(net, np.rint(uv * [exact / period, 1.0] / _UV_STEP) * _UV_STEP, exact)
    if not is_unflipped(strip.uv, strip.corners) or meets_itself(net, strip, exact):
        x, y, z = X.mean(0)
        raise ChartError(
            f"a ring around ({x:.0f}, {y:.0f}, {z:.0f}) mm folds or overlaps itself when it is laid flat",
            hint="use --charts auto",
        )
    return Chart(faces, strip.uv, strip.corners, float(exact))
