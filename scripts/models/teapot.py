"""The Utah teapot: body, handle and spout of the published control points, as one surface."""

import numpy as np
import trimesh

from models.rings import swept

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
_LID = 2.4 * _SCALE  # height of the body's open top


def teapot(step: float = 1.9) -> trimesh.Trimesh:
    """Join the three surfaces to one, open at the top of the body and at the end of the spout; y is up."""
    from manifold3d import Manifold, Mesh

    def solid(mesh: trimesh.Trimesh) -> Manifold:
        return Manifold(Mesh(mesh.vertices.astype(np.float32), mesh.faces.astype(np.uint32)))

    profile = _cubics(np.array(_BODY), 24)
    angle = np.linspace(0, 2 * np.pi, 181)[:-1]
    rings = np.stack(
        [profile[1:, :1] * np.cos(angle), np.broadcast_to(profile[1:, 1:], (len(profile) - 1, 180))], -1
    )
    body = swept(
        np.concatenate([rings, -(profile[1:, :1] * np.sin(angle))[..., None]], -1) * _SCALE,
        np.zeros(3),
        np.array([0, _LID, 0]),
    )
    spout = _tube(_SPOUT, 1)
    whole = solid(body) + solid(spout) + solid(_tube(_HANDLE, -1))
    mesh = whole.refine_to_length(step).to_mesh()
    joined = trimesh.Trimesh(mesh.vert_properties[:, :3], mesh.tri_verts, process=False)
    return _opened(joined)


def _tube(rows: list, side: int) -> trimesh.Trimesh:
    """Sweep the outline of half patch rows mirrored at depth 0, closed at both ends."""
    half = _cubics(np.array(rows, float), 30)  # (k, 4, 3)
    t = np.linspace(0, 1, 25)[:, None, None]
    a, b, c, d = np.moveaxis(half, 1, 0)
    arc = (1 - t) ** 3 * a + 3 * t * (1 - t) ** 2 * b + 3 * t**2 * (1 - t) * c + t**3 * d
    arc = np.moveaxis(arc, 0, 1)  # (k, 25, 3): from the inner edge over one side to the outer
    back = arc[:, -2:0:-1] * (1, -1, 1)
    rings = np.concatenate([arc, back], 1)[..., [0, 2, 1]] * (1, 1, -1) * _SCALE
    tube = swept(rings, rings[0].mean(0), rings[-1].mean(0))
    if tube.volume < 0:
        tube.invert()
    return tube


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
