"""The Utah teapot: body, handle and spout of the published control points, as one surface."""

import numpy as np
import trimesh

from models.patches import (
    Patch,
    flipped,
    joined,
    mean_girth,
    meshed,
    solid,
    spread,
    tube,
    turns,
    unsolid,
    wheel,
)

__all__ = ["teapot"]

# Newell's control points: the body's profile (radius, height), cubics that share their ends
_BODY = [
    (0, 0), (1.425, 0), (1.5, 0.075), (1.5, 0.15), (1.5, 0.225), (2, 0.45), (2, 0.9),
    (2, 1.35), (1.75, 1.875), (1.5, 2.4), (1.4375, 2.53125), (1.3375, 2.53125), (1.4, 2.4),
]  # fmt: skip
# half of a patch row (x, depth, height): inner edge, two control points at the side, outer edge
_HANDLE = [
    [(-1.6, 0, 2.025), (-1.6, 0.3, 2.025), (-1.5, 0.3, 2.25), (-1.5, 0, 2.25)],
    [(-2.3, 0, 2.025), (-2.3, 0.3, 2.025), (-2.5, 0.3, 2.25), (-2.5, 0, 2.25)],
    [(-2.7, 0, 2.025), (-2.7, 0.3, 2.025), (-3, 0.3, 2.25), (-3, 0, 2.25)],
    [(-2.7, 0, 1.8), (-2.7, 0.3, 1.8), (-3, 0.3, 1.8), (-3, 0, 1.8)],
    [(-2.7, 0, 1.575), (-2.7, 0.3, 1.575), (-3, 0.3, 1.35), (-3, 0, 1.35)],
    [(-2.5, 0, 1.125), (-2.5, 0.3, 1.125), (-2.65, 0.3, 0.9375), (-2.65, 0, 0.9375)],
    [(-2, 0, 0.9), (-2, 0.3, 0.9), (-1.9, 0.3, 0.6), (-1.9, 0, 0.6)],
]
_SPOUT = [
    [(1.7, 0, 1.425), (1.7, 0.66, 1.425), (1.7, 0.66, 0.6), (1.7, 0, 0.6)],
    [(2.6, 0, 1.425), (2.6, 0.66, 1.425), (3.1, 0.66, 0.825), (3.1, 0, 0.825)],
    [(2.3, 0, 2.1), (2.3, 0.25, 2.1), (2.4, 0.25, 2.025), (2.4, 0, 2.025)],
    [(2.7, 0, 2.4), (2.7, 0.25, 2.4), (3.3, 0.25, 2.4), (3.3, 0, 2.4)],
]
_SCALE = 150 / 6.3  # to about 150 mm from handle to spout
_SOLE = 1.42 * _SCALE  # radius of the bottom that is laid flat
_SUNK = 2.5  # mm that the handle's ends go on into the body
_LID = 2.4 * _SCALE  # height of the body's open top


def teapot(step: float = 2.2) -> trimesh.Trimesh:
    """Join the three surfaces to one, open at the top of the body and at the end of the spout; y is up.

    Each brings its own parameters: ways along the outlines that were turned or swept.
    """
    parts = [_body(), _tube(_SPOUT), _tube(_HANDLE, _SUNK)]
    whole = sum((solid(part, 1000.0 * k) for k, part in enumerate(parts[1:], 1)), start=solid(parts[0]))
    return _opened(meshed(unsolid(whole.refine_to_length(step))))


def _body() -> Patch:
    """Turn the profile about the y axis; the bottom is laid flat as it is, the top is closed."""
    profile = _cubics(np.array(_BODY), 24)[1:] * _SCALE
    angle = np.linspace(0, 2 * np.pi, 181)[:-1]
    x, z = profile[:, :1] * np.cos(angle), -profile[:, :1] * np.sin(angle)
    rings = np.stack([x, np.broadcast_to(profile[:, 1:], x.shape), z], -1)
    edge = int((profile[:, 0] > _SOLE).argmax())
    bottom = wheel(rings[: edge + 1], np.zeros(3), angle)
    top = wheel(rings[-1:], np.array([0, _LID, 0]), angle)
    return joined([_rolled(rings[edge:]), flipped(bottom), top])


def _rolled(rings: np.ndarray) -> Patch:
    """Lay a tube out flat, by the length of its rings (k, n, 3) and the way from one to the next."""
    way = np.append(0.0, np.cumsum(np.linalg.norm(np.diff(rings, axis=0), axis=2).mean(1)))
    girth = mean_girth(rings, way)
    return tube(rings, girth * turns(rings), spread(rings, way, girth))


def _tube(rows: list, sunk: float = 0.0) -> Patch:
    """Sweep the outline of half patch rows mirrored at depth 0, closed at both ends, which go on along x."""
    half = _cubics(np.array(rows, float), 30)  # (k, 4, 3)
    t = np.linspace(0, 1, 25)[:, None, None]
    a, b, c, d = np.moveaxis(half, 1, 0)
    arc = (1 - t) ** 3 * a + 3 * t * (1 - t) ** 2 * b + 3 * t**2 * (1 - t) * c + t**3 * d
    arc = np.moveaxis(arc, 0, 1)  # (k, 25, 3): from the inner edge over one side to the outer
    back = arc[:, -2:0:-1] * (1, -1, 1)
    rings = np.concatenate([arc, back], 1)[..., [0, 2, 1]] * (1, 1, -1) * _SCALE
    if sunk:
        inward = np.array([sunk, 0.0, 0.0])
        rings = np.concatenate([rings[:1] + inward, rings, rings[-1:] + inward])
    if np.cross(rings[0], np.roll(rings[0], -1, 0)).sum(0) @ (rings[1] - rings[0]).mean(0) < 0:
        rings = rings[:, ::-1]
    angle = -2 * np.pi * np.arange(rings.shape[1]) / rings.shape[1]
    start = wheel(rings[:1], rings[0].mean(0), angle)
    end = wheel(rings[-1:], rings[-1].mean(0), angle)
    return joined([_rolled(rings), flipped(start), end])


def _cubics(points: np.ndarray, n: int) -> np.ndarray:
    """Evaluate cubic Bezier curves that share their ends, control points (3 k + 1, ...)."""
    t = np.linspace(0, 1, n, endpoint=False).reshape(-1, *[1] * (points.ndim - 1))
    parts = [
        (1 - t) ** 3 * a + 3 * t * (1 - t) ** 2 * b + 3 * t**2 * (1 - t) * c + t**3 * d
        for a, b, c, d in zip(points[:-3:3], points[1:-2:3], points[2:-1:3], points[3::3], strict=True)
    ]
    return np.concatenate([*parts, points[-1:]])


def _opened(mesh: trimesh.Trimesh) -> trimesh.Trimesh:
    """Take the lids off: the plane top of the body, and of the spout."""
    level = np.abs(mesh.triangles[..., 1] - _LID).max(1) < 1e-3
    mesh.update_faces(~(level & (mesh.face_normals[:, 1] > 0.999)))
    mesh.remove_unreferenced_vertices()
    return mesh
