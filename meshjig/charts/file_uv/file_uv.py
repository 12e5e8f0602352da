"""Charts from the UVs that came with the file."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from meshjig.charts.chart import Chart
from meshjig.charts.cuts import cut_open
from meshjig.charts.file_uv.periodic_islands import closed_around
from meshjig.charts.file_uv.source_uv import SourceUV, is_as_loaded, sample, source_uv
from meshjig.charts.flatten.flatten import is_unflipped, unit_stretch
from meshjig.charts.flatten.separate_border import part
from meshjig.charts.flatten.untangle import untangle
from meshjig.charts.regularize import steady
from meshjig.charts.segment.clean_labels import tidy
from meshjig.errors import ChartError
from meshjig.mesh.components import components
from meshjig.mesh.halfedges import Edges, border_halfedges, compact, edges
from meshjig.mesh.measure import face_areas, sums
from meshjig.mesh.types import Mesh

__all__ = ["own_uv"]

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]

_MOST = 60  # islands that can make charts: tiles on smaller ones would nearly all be cut by seams
_APART = 0.5  # of an edge's length in the texture: sides farther apart are those of a seam
_STRAY = 0.02  # of an island's area
_NEXT_TO_NONE = 1e-6  # what the UV of a stray face counts, where other faces know better
_JUMP = 0.5  # of the texture: a face that reaches farther goes around its edge


def own_uv(mesh: Mesh, source: Any, to_source: Floats) -> list[Chart]:
    """Make a chart of every island of a file's UVs.

    The mesh may have been repaired and decimated since: each face asks the source where it lies.

    Parameters
    ----------
    mesh : Mesh
    source : trimesh.Trimesh, as loaded
    to_source : (4, 4) float64, takes the mesh's coordinates to those of source

    Returns
    -------
    list of Chart
        Cut where the UVs are cut; mirrored islands are turned; the mean stretch of each is 1. An island
        whose cut joins two sides one way apart goes around: it has a period.

    Raises
    ------
    ChartError
        The UVs are missing, in too many islands, without area, folded or overlapping.
    """
    found = source_uv(source, to_source)
    n = int(found.island.max(initial=-1)) + 1
    if n > _MOST:
        raise ChartError(
            f"the file's UVs fall into {n} islands, and more than {_MOST} leave hardly a tile whole",
            hint="use --charts auto",
        )
    if not is_as_loaded(mesh.V, mesh.F, found).any():
        mesh = Mesh(steady(mesh.V, mesh.F), mesh.F)
    island, places = sample(mesh.V, mesh.F, found)
    e = edges(mesh.F)
    if (island < 0).any() or not _hangs_together(mesh.F, e, island):
        island = tidy(mesh.F, island, face_areas(mesh.V, mesh.F))
    seam, stray = _without_strays(mesh, e, island, _seams(e, island, places))
    corners, origin = cut_open(mesh.F, e, seam)
    flat, weight = corners.ravel(), np.repeat(np.where(stray, _NEXT_TO_NONE, 1.0), 3)
    total = sums(flat, weight, len(origin))
    uv = np.stack([sums(flat, weight * places[..., k].ravel(), len(origin)) / total for k in (0, 1)], 1)
    n_charts, chart = components(corners)
    charts = [_chart(mesh, found, np.flatnonzero(chart == k), uv, corners, origin) for k in range(n_charts)]
    return [closed_around(chart, e) for chart in charts]


def _hangs_together(F: Ints, e: Edges, island: Ints) -> bool:
    wall = np.repeat(island, 3) != np.repeat(island, 3)[e.twin]
    return components(F, wall)[0] == len(np.unique(island))


def _seams(e: Edges, island: Ints, places: Floats) -> Bools:
    """Mark the edges whose sides lie in different islands, or apart in one, (e,)."""
    h = np.flatnonzero(e.twin > np.arange(len(e.twin)))
    t = e.twin[h]
    start, end = places.reshape(-1, 2), np.roll(places, -1, 1).reshape(-1, 2)
    length = (np.linalg.norm(end[h] - start[h], axis=1) + np.linalg.norm(end[t] - start[t], axis=1)) / 2
    apart = np.linalg.norm(start[h] - end[t], axis=1) + np.linalg.norm(end[h] - start[t], axis=1)
    seam = np.zeros(len(e.E), bool)
    seam[e.edge_of_halfedge[h]] = (island[h // 3] != island[t // 3]) | (apart > _APART * length)
    return seam


def _without_strays(mesh: Mesh, e: Edges, island: Ints, seam: Bools) -> tuple[Bools, Bools]:
    """Join small parts that sampling has torn off their island to it again: give the seams and the parts."""
    _, part = components(mesh.F, seam[e.edge_of_halfedge])
    area = face_areas(mesh.V, mesh.F)
    stray = (
        sums(part, area, int(part.max()) + 1)[part]
        < _STRAY * sums(island, area, int(island.max()) + 1)[island]
    )
    h = np.flatnonzero(e.twin > np.arange(len(e.twin)))
    here, there = h // 3, e.twin[h] // 3
    mend = (island[here] == island[there]) & (stray[here] | stray[there])
    seam = seam.copy()
    seam[e.edge_of_halfedge[h[mend]]] = False
    return seam, stray


def _chart(mesh: Mesh, source: SourceUV, faces: Ints, uv: Floats, corners: Ints, origin: Ints) -> Chart:
    """Turn, scale and check one island."""
    G, rows = compact(corners[faces])
    V, uv = mesh.V[origin[rows]], uv[rows]
    area = face_areas(uv, G)
    if area.sum() < 0:
        uv = uv * [-1.0, 1.0]
    x, y, z = np.average(mesh.V[mesh.F[faces]].mean(1), axis=0, weights=face_areas(V, G) + 1e-300)
    where = f"near ({x:.0f}, {y:.0f}, {z:.0f}) mm"
    if not np.abs(area).sum() > 0:
        raise ChartError(f"the file's UVs have no area {where}", hint="use --charts auto")
    uv = unit_stretch(V, G, uv)
    if not is_unflipped(uv, G):
        uv = untangle(V, G, uv)
    if not is_unflipped(uv, G):
        around = (np.ptp(source.uv[source.F], axis=1) > _JUMP).any()
        what = "go around the edge of the texture inside faces" if around else "fold"
        raise ChartError(f"the file's UVs {what} {where}", hint="use --charts auto")
    if _meets_itself(uv, G):  # teeth of a decimated border may cross
        uv = part(V, G, uv)
    uv = unit_stretch(V, G, uv)
    if not is_unflipped(uv, G) or _meets_itself(uv, G):
        raise ChartError(f"the file's UVs overlap themselves {where}", hint="use --charts auto")
    return Chart(faces, uv, G)


def _meets_itself(uv: Floats, G: Ints) -> bool:
    """Tell whether border edges cross others that they share no end with."""
    import shapely

    h = border_halfedges(G)
    ends = np.stack([G.ravel()[h], np.roll(G, -1, 1).ravel()[h]], 1)
    segments = shapely.linestrings(uv[ends])
    a, b = shapely.STRtree(segments).query(segments, predicate="intersects")
    return bool((~(ends[a][:, :, None] == ends[b][:, None, :]).any((1, 2))).any())
