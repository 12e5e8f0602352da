"""Surfaces that bring their parameterization along: tubes and discs with UVs in mm, joined to models."""

from typing import Any, NamedTuple

import numpy as np
import trimesh

__all__ = [
    "Patch", "flat", "flipped", "joined", "mean_girth", "meshed", "parted", "solid", "spread", "tube",
    "turns", "unsolid", "wheel",
]  # fmt: skip

_APART = 20.0  # mm, between islands
_SAME = 1e-4  # mm, in the plane


class Patch(NamedTuple):
    """A surface and where it lies in its own plane; vertices on a cut come twice."""

    V: np.ndarray  # (n, 3), mm
    F: np.ndarray  # (m, 3)
    uv: np.ndarray  # (n, 2), mm


def tube(rings: np.ndarray, u: np.ndarray, v: np.ndarray) -> Patch:
    """Join rings (k, n, 3) one after another, cut open where the first and the last point of a ring meet.

    Seen along the sweep the points of a ring run clockwise: then faces look outward.
    u : (n + 1,) or (k, n + 1), mm, along the rings; v : (k,), mm, across them.
    """
    return _strip(np.concatenate([rings, rings[:, :1]], 1), u, v)


def _strip(rows: np.ndarray, u: np.ndarray, v: np.ndarray) -> Patch:
    """Join rows (k, n, 3) of points one after another; u (n,) or (k, n) along them, v (k,) across, mm."""
    k, n = rows.shape[:2]
    i, j = (x.ravel() for x in np.meshgrid(np.arange(k - 1), np.arange(n - 1), indexing="ij"))
    a, b = i * n + j, i * n + j + 1
    F = np.concatenate([np.stack([a, b, b + n], 1), np.stack([a, b + n, a + n], 1)])
    uv = np.stack([np.broadcast_to(u, (k, n)), np.broadcast_to(v[:, None], (k, n))], -1)
    return Patch(rows.reshape(-1, 3), F, uv.reshape(-1, 2))


def wheel(rings: np.ndarray, middle: np.ndarray, angle: np.ndarray) -> Patch:
    """Close an end: rings (k, n, 3) from the middle outward, laid flat around it without changing areas.

    angle : (n,), radians, where the points of a ring lie. Faces look to where the points are seen to run
    counterclockwise.
    """
    k, n = rings.shape[:2]
    V = np.concatenate([np.reshape(middle, (1, 3)), rings.reshape(-1, 3)])
    j = np.arange(n)
    first = np.stack([np.zeros(n, int), 1 + j, 1 + (j + 1) % n], 1)
    i, j = (x.ravel() for x in np.meshgrid(np.arange(k - 1), j, indexing="ij"))
    a, b = 1 + i * n + j, 1 + i * n + (j + 1) % n
    F = np.concatenate([first, np.stack([a, b + n, b], 1), np.stack([a, a + n, b + n], 1)])
    row = np.concatenate([np.zeros(n, int), i, i])
    area = np.cumsum(np.bincount(row, trimesh.triangles.area(V[F]), k))
    # what a polygon of n corners has in area, as a circle has
    radius = np.sqrt(area / (n / 2 * np.sin(2 * np.pi / n)))
    around = np.stack([np.cos(angle), np.sin(angle)], 1)
    uv = np.concatenate([np.zeros((1, 2)), (radius[:, None, None] * around).reshape(-1, 2)])
    return Patch(V, F, uv)


def flipped(patch: Patch) -> Patch:
    """Let a patch look the other way."""
    return patch._replace(F=patch.F[:, ::-1], uv=patch.uv * [1.0, -1.0])


def flat(patch: Patch, axes: tuple[int, int]) -> Patch:
    """Lay a plane patch into the plane of two of its axes as it is."""
    return patch._replace(uv=patch.V[:, axes])


def turns(rings: np.ndarray) -> np.ndarray:
    """Give the share of a turn, by length along each ring (k, n, 3), at which its points lie, (k, n + 1)."""
    step = np.linalg.norm(np.roll(rings, -1, 1) - rings, axis=2)
    turn = np.cumsum(step, 1) / step.sum(1, keepdims=True)
    return np.concatenate([np.zeros((len(rings), 1)), turn], 1)


def mean_girth(rings: np.ndarray, length: np.ndarray) -> float:
    """Give the mean circumference of rings (k, n, 3), mm, each standing for its part of the way (k,)."""
    girth = np.linalg.norm(rings - np.roll(rings, -1, 1), axis=2).sum(1)
    return float((girth * np.gradient(length)).sum() / np.gradient(length).sum())


def spread(rings: np.ndarray, way: np.ndarray, girth: float, even: float = 0.5) -> np.ndarray:
    """Give v for rings (k, n, 3) whose u goes around by a girth: the way along them (k,), mm, where it fits.

    Where a ring is narrower than that girth its tiles become narrow, and may become as much shorter:
    not at all with even 0, and just as much with even 1, which keeps angles, but not areas.
    """
    own = np.linalg.norm(rings - np.roll(rings, -1, 1), axis=2).sum(1)
    rate = (girth / (own[1:] + own[:-1]) * 2) ** even
    return np.append(0.0, np.cumsum(np.diff(way) * rate))


def joined(patches: list[Patch]) -> Patch:
    """Put patches into one, their islands side by side."""
    V, F, uv, at, left = [], [], [], 0, 0.0
    for patch in patches:
        V.append(patch.V)
        F.append(patch.F + at)
        uv.append(patch.uv - patch.uv.min(0) + [left, 0.0])
        at += len(patch.V)
        left += float(np.ptp(patch.uv[:, 0])) + _APART
    return Patch(np.concatenate(V), np.concatenate(F), np.concatenate(uv))


def meshed(patch: Patch) -> trimesh.Trimesh:
    """Make a mesh with UVs; points that are one in space stay apart where they are in the plane."""
    visual = trimesh.visual.TextureVisuals(uv=patch.uv)
    return trimesh.Trimesh(patch.V, patch.F, visual=visual, process=False)


def solid(patch: Patch, left: float = 0.0) -> Any:
    """Make a solid of a closed surface; u begins at left, so that islands of several solids stay apart."""
    from manifold3d import Manifold, Mesh

    V = patch.V.astype(np.float32)
    _, first, number = np.unique(V, axis=0, return_index=True, return_inverse=True)
    same = first[number.ravel()]
    again = np.flatnonzero(same != np.arange(len(V)))
    uv = patch.uv - patch.uv.min(0) + [left, 0.0]
    made = Manifold(
        Mesh(
            np.hstack([V, uv]).astype(np.float32),
            patch.F.astype(np.uint32),
            again.astype(np.uint32),
            same[again].astype(np.uint32),
            face_id=np.arange(len(patch.F), dtype=np.uint32),  # no faces of one plane are made one
        )
    )
    if made.is_empty() or made.volume() <= 0:
        raise ValueError(f"no solid: {made.status()}")
    return made


def unsolid(made: Any) -> Patch:
    """Take the surface of a solid back, with the UVs that its parts brought."""
    mesh = made.to_mesh()
    V = np.asarray(mesh.vert_properties, np.float64)
    first = np.arange(len(V))
    first[np.asarray(mesh.merge_from_vert)] = np.asarray(mesh.merge_to_vert)
    return Patch(V[first, :3], np.asarray(mesh.tri_verts, np.int64), V[:, 3:])


def parted(V: np.ndarray, F: np.ndarray, uv: np.ndarray) -> Patch:
    """Split vertices whose faces' corners, uv (m, 3, 2), lie apart in the plane."""
    corner = np.column_stack([F.ravel(), np.rint(uv.reshape(-1, 2) / _SAME)])
    _, first, number = np.unique(corner, axis=0, return_index=True, return_inverse=True)
    return Patch(V[F.ravel()[first]], number.reshape(-1, 3), uv.reshape(-1, 2)[first])
