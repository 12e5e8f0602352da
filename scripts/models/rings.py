"""Meshes of rings: what a closed curve sweeps, from pole to pole or with open ends."""

import numpy as np
import trimesh

__all__ = ["even", "revolved", "rounded", "swept"]


def swept(
    rings: np.ndarray, start: np.ndarray | None = None, end: np.ndarray | None = None
) -> trimesh.Trimesh:
    """Join rings (k, n, 3) of n points each, one after another; a point closes an end, None leaves it open.

    Seen along the sweep the points of a ring run clockwise: then faces look outward.
    """
    k, n = rings.shape[:2]
    i, j = (x.ravel() for x in np.meshgrid(np.arange(k - 1), np.arange(n), indexing="ij"))
    a, b = i * n + j, i * n + (j + 1) % n
    faces = [np.stack([a, b, b + n], 1), np.stack([a, b + n, a + n], 1)]
    points, here = [rings.reshape(-1, 3)], np.arange(n)
    for pole, first, turn in ((start, 0, 1), (end, (k - 1) * n, -1)):
        if pole is not None:
            top = np.full(n, sum(map(len, points)))
            rim = first + here, first + (here + 1) % n
            faces.append(np.stack([top, rim[1], rim[0]] if turn > 0 else [top, rim[0], rim[1]], 1))
            points.append(np.reshape(pole, (1, 3)))
    return trimesh.Trimesh(np.vstack(points), np.vstack(faces), process=False)


def revolved(profile: np.ndarray, around: int) -> trimesh.Trimesh:
    """Turn a profile (k, 2) of radius and height about the y axis; ends on the axis are closed by poles."""
    on_axis = (profile[[0, -1], 0] == 0).tolist()
    body = profile[on_axis[0] : len(profile) - on_axis[1]]
    angle = 2 * np.pi * np.arange(around) / around
    x, z = body[:, :1] * np.cos(angle), -body[:, :1] * np.sin(angle)
    rings = np.stack([x, np.broadcast_to(body[:, 1:], x.shape), z], -1)
    poles = [np.array([0, y, 0]) if on else None for on, y in zip(on_axis, profile[[0, -1], 1], strict=True)]
    return swept(rings, *poles)


def rounded(polyline: np.ndarray, rounds: int = 4) -> np.ndarray:
    """Cut corners until a polyline looks smooth; its ends stay."""
    for _ in range(rounds):
        a, b = polyline[:-1], polyline[1:]
        cut = np.stack([0.75 * a + 0.25 * b, 0.25 * a + 0.75 * b], 1).reshape(-1, polyline.shape[1])
        polyline = np.vstack([polyline[:1], cut[1:-1], polyline[-1:]])
    return polyline


def even(polyline: np.ndarray, n: int, corners: tuple[int, ...] = ()) -> np.ndarray:
    """Spread n points along a polyline, those of the given numbers among them."""
    arc = np.append(0.0, np.cumsum(np.linalg.norm(np.diff(polyline, axis=0), axis=1)))
    place = np.linspace(0, arc[-1], n)
    keep = arc[list(corners)]
    away = np.abs(place[:, None] - keep).min(1, initial=np.inf) > 0.4 * place[1]
    place = np.sort(np.append(place[away], keep))
    return np.stack([np.interp(place, arc, column) for column in polyline.T], 1)
