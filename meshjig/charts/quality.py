"""What an atlas is worth, measured on the full mesh."""

from typing import Any

import numpy as np

from meshjig.charts.flatten import FLAT_LIMITS, border_is_simple
from meshjig.measure import face_areas, singular_values
from meshjig.topology import compact, edges
from meshjig.types import Atlas

__all__ = ["quality"]


def quality(atlas: Atlas) -> dict[str, Any]:
    """Measure an atlas.

    Parameters
    ----------
    atlas : Atlas

    Returns
    -------
    dict with
        n_charts, flips (mirrored or empty faces), gate_share (share of the area whose stretch
        lies within FLAT_LIMITS both ways), seam_over_sqrt_area (length of all cuts over the root of the
        area), overlaps (charts whose border meets itself in the plane)
    """
    V, F = atlas.mesh.V, atlas.mesh.F
    area = face_areas(V, F)
    s = singular_values(V, F, atlas.uv, atlas.F_uv)
    good = (s[:, 1] >= FLAT_LIMITS[0]) & (s[:, 0] <= FLAT_LIMITS[1])
    return {
        "n_charts": atlas.n_charts,
        "flips": int((face_areas(atlas.uv, atlas.F_uv) <= 0).sum()),
        "gate_share": float(area[good].sum() / area.sum()),
        "seam_over_sqrt_area": float(_seam_length(atlas) / np.sqrt(area.sum())),
        "overlaps": _n_overlaps(atlas),
    }


def _seam_length(atlas: Atlas) -> float:
    """Give the length of the edges whose two sides lie apart in the plane, mm."""
    V, F, G = atlas.mesh.V, atlas.mesh.F, atlas.F_uv
    twin = edges(F).twin
    rim = edges(G).twin == np.arange(3 * len(G))
    h = np.flatnonzero(rim & (twin > np.arange(len(twin))))
    ends = V[np.roll(F, -1, 1).ravel()[h]] - V[F.ravel()[h]]
    return float(np.linalg.norm(ends, axis=1).sum())


def _n_overlaps(atlas: Atlas) -> int:
    count = 0
    for chart in range(atlas.n_charts):
        G, kept = compact(atlas.F_uv[atlas.chart_of_face == chart])
        count += not border_is_simple(atlas.uv[kept], G)
    return count
