"""Charts that go around: rings for vases, bottles and limbs, and caps for their closed ends."""

import numpy as np
from numpy.typing import NDArray

from meshjig.charts.chart import Chart
from meshjig.charts.transfer.proxy import proxy
from meshjig.charts.tubes.bands import FlatBand, carried, flat_band
from meshjig.charts.tubes.ends import Ends, carried_ends, rims, two_ends
from meshjig.charts.tubes.harmonic_function import Girths, girths, harmonic_height
from meshjig.charts.tubes.is_tubular import suits
from meshjig.charts.tubes.separating_loops import across, divided
from meshjig.charts.tubes.tube_decomposition import Band, stack
from meshjig.errors import ChartError
from meshjig.mesh.measure import barycentric, face_areas, interpolate

__all__ = ["periodic", "suits"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]

_PROXY = 12_000  # faces
_LEAST_SHARE = 0.97  # of the area that has to be within FLAT_LIMITS
_LEAST_OF_ONE = 0.9  # of the area of one chart
_LEAST_RINGS = 0.2  # of the area that has to be in rings
_ROUNDS = 10  # of stacking anew without bands that stretch too much
_MOST = 12  # charts that a tube may take


def periodic(V: Floats, F: Ints, seed: int = 0) -> list[Chart]:
    """Cover a tube-like component with rings that are charts going around, and caps.

    Rings are as few as the stretch limits allow: one takes girths that differ by up to half.
    Neighbouring charts meet in short loops around the tube. A closed end that is no dome is cut
    into charts like any other surface.

    Parameters
    ----------
    V : (n, 3) float64, mm, y upward
    F : (m, 3) int64, manifold, one component
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
    W, G = proxy(V, F, _PROXY)
    ends = two_ends(W, G)
    height = harmonic_height(W, G, ends)
    slices = girths(W, G, height)
    along = np.interp(height, slices.level, slices.way)
    cuts, flats = _planned(W, G, ends, slices, along, seed)
    if G is F:
        parts = [flat.faces for flat in flats]
    else:
        ends = carried_ends(V, F, W, ends)
        label = divided(V, F, ends, across(V, F, ends), _at_nearest(V, W, G, along), cuts)
        parts = [np.flatnonzero(label == k) for k in range(len(flats))]
    charts = [carried(V, F, part, W, G, flat, seed) for part, flat in zip(parts, flats, strict=True)]
    return [chart for some in charts for chart in some]


def _planned(
    W: Floats, G: Ints, ends: Ends, slices: Girths, along: Floats, seed: int
) -> tuple[Floats, list[FlatBand]]:
    """Stack bands until all of them flatten within limits; give the cuts between, and the bands."""
    left = across(W, G, ends)
    tips = len(ends.first) == 1, len(ends.last) == 1
    area = face_areas(W, G)
    refused: list[Band] = []
    for _ in range(_ROUNDS):
        bands = stack(slices, tips, refused)
        in_rings = sum(float(slices.area[b.start : b.stop].sum()) for b in bands if b.kind == "ring")
        if len(bands) > _MOST or in_rings < _LEAST_RINGS * area.sum():
            break
        cuts = slices.way[[band.start for band in bands[1:]]]
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
        loops = rims(G[some]) if band.kind == "cap" else []
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
    middle = slices.way[(rings[0].start + rings[0].stop) // 2]
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
