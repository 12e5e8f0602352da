"""How much longer a short line is on the surface than in its chart."""

from collections.abc import Callable

import numpy as np

from meshjig.mesh.types import Atlas, Floats

__all__ = ["Stretch", "chart_stretch"]

Stretch = Callable[[Floats, Floats], Floats]

WITHIN = (0.5, 2.0)  # what a face may tell; one beyond that is a sliver


def chart_stretch(atlas: Atlas, chart: int) -> Stretch:
    """Measure a chart's faces, to ask the nearest one.

    Parameters
    ----------
    atlas : Atlas
    chart : int

    Returns
    -------
    callable
        For points (k, 2) of the chart's plane, mm, and directions (k, 2) there: how many times as long as
        in the plane a short line is on the surface, (k,) float64. Points may be periods away.
    """
    from scipy.spatial import cKDTree

    faces = np.flatnonzero(atlas.chart_of_face == chart)
    flat = atlas.uv[atlas.F_uv[faces]]
    metric = _metrics(flat, atlas.mesh.V[atlas.mesh.F[faces]])
    tree, low = cKDTree(flat.mean(1)), flat[..., 0].min()
    period = 0.0 if atlas.period is None else float(atlas.period[chart])

    def stretch(points: Floats, directions: Floats) -> Floats:
        x = low + (points[:, 0] - low) % period if period else points[:, 0]
        M = metric[tree.query(np.column_stack([x, points[:, 1]]))[1]]
        squared = np.einsum("ki,kij,kj->k", directions, M, directions)
        length = np.maximum(np.linalg.norm(directions, axis=1), 1e-12)
        times: Floats = np.clip(np.sqrt(np.maximum(squared, 0.0)) / length, *WITHIN)
        return times

    return stretch


def _metrics(flat: Floats, solid: Floats) -> Floats:
    """Give the first fundamental forms (f, 2, 2) of faces from the plane (f, 3, 2) to space (f, 3, 3)."""
    A = (solid[:, 1:] - solid[:, :1]).transpose(0, 2, 1)
    (a, c), (b, d) = (flat[:, 1:] - flat[:, :1]).transpose(1, 2, 0)
    det = a * d - b * c
    inverse = np.array([[d, -b], [-c, a]]).transpose(2, 0, 1) / np.where(det == 0, np.inf, det)[:, None, None]
    J = A @ inverse
    return J.transpose(0, 2, 1) @ J
