"""Charts that go around: rings for vases, bottles and limbs, and caps for their closed ends."""

import numpy as np

from meshjig.charts.chart import Chart
from meshjig.charts.transfer.proxy import proxy_mesh
from meshjig.charts.tubes.bands import FlatBand, flat_band, transfer_band
from meshjig.charts.tubes.harmonic_function import (
    Ends,
    Girths,
    girths,
    harmonic_function,
    transferred_ends,
    two_ends,
)
from meshjig.charts.tubes.separating_loops import across, divided
from meshjig.charts.tubes.tube_decomposition import Band, decompose_tube
from meshjig.errors import ChartError
from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.boundary_loops import borders_by_length
from meshjig.mesh.measure import barycentric, face_areas, interpolate
from meshjig.mesh.mesh import Mesh
from meshjig.mesh.shortest_paths import distances, edge_graph

__all__ = ["is_tubular", "periodic"]

_SLICES_FORESEEN = 60
_PLACES = 4  # places at which a face counts
_BLUR = np.array([0.25, 0.5, 0.25])
_MOST_FORESEEN = 6  # charts
_IN_RINGS = 0.6  # of the area, at least
_ROUND = (0.9, 1.1)  # girth over that of a circle of the same mean radius: neither branched nor bent
_MOSTLY = 0.85  # of the area has to be round
_LONG = 0.7  # girths from end to end, at least
_PROXY = 12_000  # faces
_LEAST_SHARE = 0.97  # of the area that has to be within FLAT_LIMITS
_LEAST_OF_ONE = 0.9  # of the area of one chart
_LEAST_RINGS = 0.2  # of the area that has to be in rings
_ROUNDS = 10  # of dividing the tube again without bands that stretch too much
_MOST = 12  # charts that a tube may take


def is_tubular(mesh: Mesh) -> bool:
    """Tell whether a component looks like a vase, a tube or a limb.

    Distances along edges stand in for the harmonic height, and the area between them for girths.

    Parameters
    ----------
    mesh : Mesh, y upward, manifold, one component

    Returns
    -------
    bool. `periodic` may still refuse, or cut the surface into more charts than foreseen.
    """
    try:
        ends = two_ends(mesh)
    except ChartError:
        return False
    area = mesh.areas.sum()
    slices, radius = _sliced(mesh, ends)
    if slices.along[-1] < _LONG * slices.area.sum() / slices.along[-1]:
        return False
    bands = decompose_tube(slices, ends.tips, [])
    if not bands or len(bands) > _MOST_FORESEEN or any(band.kind == "rest" for band in bands):
        return False
    if _in_rings(slices, bands) < _IN_RINGS * area:
        return False
    roundness = slices.girth / (2 * np.pi * radius)
    round_ones = (_ROUND[0] <= roundness) & (roundness <= _ROUND[1])
    return float(slices.area[round_ones].sum()) >= _MOSTLY * float(area)


def _in_rings(slices: Girths, bands: list[Band]) -> float:
    return sum(float(slices.area[b.start : b.stop].sum()) for b in bands if b.kind == "ring")


def _sliced(mesh: Mesh, ends: Ends) -> tuple[Girths, Floats]:
    """Slice a tube by the distance from its first end; also give each slice's mean radius, (k,), mm."""
    V, F = mesh
    distance = distances(edge_graph(V, F), ends.first)[F]
    level = np.linspace(0, distance.max() * (1 + 1e-9), _SLICES_FORESEEN + 1)
    # faces of a regular mesh lie in rows: counted whole, they would fill some slices and leave others empty
    low, high = distance.min(1), distance.max(1)
    spread = low + (high - low) * (np.arange(_PLACES)[:, None] + 0.5) / _PLACES
    where = np.searchsorted(level, spread, side="right").ravel() - 1
    part = np.tile(mesh.areas / _PLACES, _PLACES)
    total = np.convolve(np.bincount(where, part, _SLICES_FORESEEN), _BLUR, "same") + 1e-300
    middle = V[F].mean(1)
    weight = np.maximum(np.bincount(where, part, _SLICES_FORESEEN), 1e-300)
    centre = [np.bincount(where, part * np.tile(x, _PLACES), _SLICES_FORESEEN) / weight for x in middle.T]
    off = np.tile(middle, (_PLACES, 1)) - np.stack(centre, 1)[where]
    moment = np.bincount(where, part * np.linalg.norm(off, axis=1), _SLICES_FORESEEN)
    radius = np.convolve(moment, _BLUR, "same") / total
    girth = np.maximum(total / np.diff(level), 1e-9)
    return Girths(level, total, girth), np.maximum(radius, 1e-9)


def periodic(mesh: Mesh, seed: int = 0) -> list[Chart]:
    """Cover a tube-like component with rings that are charts going around, and caps.

    Rings are as few as the stretch limits allow: one takes girths that differ by up to half.
    Neighbouring charts meet in short loops around the tube. A closed end that is no dome is cut
    into charts like any other surface.

    Parameters
    ----------
    mesh : Mesh, y upward, manifold, one component
    seed : int

    Returns
    -------
    list of Chart
        From the lower end to the upper. A ring's uv is in steps of 2^-18 mm and its period in steps
        of 2^-8 mm, so that places a period apart differ by it exactly; v grows from end to end.
        No face is mirrored, and no ring meets its copies a period away.

    Raises
    ------
    ChartError
        The component has handles or more than two open ends, or is no tube.
    """
    W, G = proxy = proxy_mesh(mesh, _PROXY)
    ends = two_ends(proxy)
    height = harmonic_function(W, G, ends)
    slices = girths(W, G, height)
    along = np.interp(height, slices.level, slices.along)
    cuts, flats = _planned(W, G, ends, slices, along, seed)
    V, F = mesh
    if proxy is mesh:
        parts = [flat.faces for flat in flats]
    else:
        ends = transferred_ends(V, F, W, ends)
        label = divided(V, F, ends, across(V, F, ends), _at_nearest(V, W, G, along), cuts)
        parts = [np.flatnonzero(label == k) for k in range(len(flats))]
    charts = [transfer_band(mesh, part, proxy, flat, seed) for part, flat in zip(parts, flats, strict=True)]
    return [chart for some in charts for chart in some]


def _planned(
    W: Floats, G: Ints, ends: Ends, slices: Girths, along: Floats, seed: int
) -> tuple[Floats, list[FlatBand]]:
    """Choose bands until all of them flatten within limits; give the cuts between, and the bands."""
    left = across(W, G, ends)
    area = face_areas(W, G)
    refused: list[Band] = []
    for _ in range(_ROUNDS):
        bands = decompose_tube(slices, ends.tips, refused)
        if len(bands) > _MOST or _in_rings(slices, bands) < _LEAST_RINGS * area.sum():
            break
        cuts = slices.along[[band.start for band in bands[1:]]]
        try:
            label = divided(W, G, ends, left, along, cuts)
        except ChartError:  # loops that touch: a ring too short for this mesh
            rings = [band for band in bands if band.kind == "ring"]
            refused.append(min(rings, key=lambda band: float(slices.run[band.start : band.stop].sum())))
            continue
        faces = [np.flatnonzero(label == k) for k in range(len(bands))]
        _refuse_holes_in_caps(W, G, faces, bands)
        flats = [flat_band(W, G, f, left, band.kind, seed) for f, band in zip(faces, bands, strict=True)]
        bad = _bad(bands, flats, area)
        if not bad:
            return cuts, flats
        refused += bad
    raise _no_tube(W, along, slices, refused)


def _bad(bands: list[Band], flats: list[FlatBand], area: Floats) -> list[Band]:
    """List the bands that stretch too much: each for itself, or the worst where all do together."""
    bad = [band for band, flat in zip(bands, flats, strict=True) if flat.share < _LEAST_OF_ONE]
    lost = [(1 - flat.share) * area[flat.faces].sum() for flat in flats]
    if not bad and sum(lost) > (1 - _LEAST_SHARE) * area.sum():
        bad = [bands[int(np.argmax(lost))]]
    return bad


def _refuse_holes_in_caps(W: Floats, G: Ints, faces: list[Ints], bands: list[Band]) -> None:
    for some, band in zip(faces, bands, strict=True):
        loops = borders_by_length(G[some]) if band.kind == "cap" else []
        if len(loops) > 1:
            x, y, z = W[loops[-1]].mean(0)
            raise ChartError(
                f"the closed end has a hole near ({x:.0f}, {y:.0f}, {z:.0f}) mm",
                hint="close it with --fill-holes, or use --charts auto",
            )


def _no_tube(W: Floats, along: Floats, slices: Girths, refused: list[Band]) -> ChartError:
    """Say where the first ring that was tried stretched too much."""
    rings = [band for band in refused if band.kind == "ring"]
    if not rings:
        return ChartError("the surface has no part that is a tube", hint="use --charts auto")
    middle = slices.along[(rings[0].start + rings[0].stop) // 2]
    x, y, z = W[np.abs(along - middle).argmin()]
    return ChartError(
        f"the surface bulges or branches near ({x:.0f}, {y:.0f}, {z:.0f}) mm, where rings around it stretch "
        "too much",
        hint="use --charts auto",
    )


def _at_nearest(V: Floats, W: Floats, G: Ints, values: Floats) -> Floats:
    """Give the vertices of the mesh the value (n',) at the nearest place on its proxy, (n,)."""
    import igl

    _, near, at = igl.point_mesh_squared_distance(V, W, G)
    return interpolate(values[:, None], G, near, barycentric(W, G, near, at))[:, 0]
