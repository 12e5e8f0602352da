"""How a piece lies on the plate of a printer: stable, low, and with little to support."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.measure import area_vectors, barycentric, unit

__all__ = ["STEEP", "Pose", "axis_poses", "lying_pose"]

STEEP = 45.0  # degrees from the horizontal; undersides as steep as that need no support
ON_PLATE = 0.05  # mm above the plate; lower is held by the plate itself
FLAT = 0.8  # of the largest shadow of all stable poses; what casts less stands on an edge
LOW = 0.6  # of the largest extent; higher poses are taken only where none is lower
NEAR = 10.0  # degrees; of poses that differ less only the most stable one is tried
MOST = 64  # poses tried; a ball rests on any of its faces
FACE_UP = 0.1  # share of the surface that may be supported more to have the outer side up


class Pose(NamedTuple):
    """How a piece is turned, and what that means for the printer."""

    R: Floats  # (3, 3), turns points p of the piece to R p; the plate is below
    height: float  # mm
    extent: float  # mm, the largest of the piece in any direction
    overhang: float  # share of the surface that needs support, 0 to 1
    outer_up: bool | None  # None where it was not told which side is the outer one


def lying_pose(V: Floats, F: Ints, outer_normal: Floats | None = None) -> Pose:
    """Lay a piece down.

    A body rests on a face of its convex hull when its centre of mass is above that face. Of these poses,
    those that stand on an edge are left out, since they throw small shadows, and those that are high. Of
    the rest the one is taken that needs least support and height, with the outer side up where that costs
    little.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, closed and oriented outward
    outer_normal : (3,) float64, optional
        The direction that the piece's outer side faces, of any length; zero where that is not known.

    Returns
    -------
    Pose

    Notes
    -----
    O(n log n) for the hull, and O(m k) for k stable poses, of which there are rarely more than ten, and 64
    at most.
    """
    from scipy.spatial import ConvexHull

    hull = ConvexHull(V)
    corners = V[hull.vertices]
    extent = _extent(corners)
    N = area_vectors(V, F) / 2
    down = _stable(V, hull, _centre_of_mass(V, F))
    area = np.linalg.norm(N, axis=1)
    facing = N @ down.T
    shadow = np.abs(facing).sum(axis=0)
    depth = corners @ down.T
    height = np.ptp(depth, axis=0)
    overhang = _overhang(V, F, area, facing, down, depth.max(axis=0)) / area.sum()
    cost = overhang + height / extent
    up = None if outer_normal is None or not outer_normal.any() else -down @ unit(outer_normal)
    if up is not None:
        cost -= FACE_UP * (up > 0)
    flat = shadow >= FLAT * shadow.max()
    low = height <= max(LOW * extent, float(height[flat].min()) * (1 + 1e-9))
    best = int(np.where(flat & low, cost, np.inf).argmin())
    outer_up = None if up is None else bool(up[best] > 0)
    return Pose(_turn(down[best]), float(height[best]), extent, float(overhang[best]), outer_up)


def axis_poses(V: Floats, F: Ints) -> list[Pose]:
    """Give the six poses along the axes, the best first: for what fits a plate in no pose that is stable.

    Parameters
    ----------
    V, F : (n, 3) float64, mm, and (m, 3) int64, closed and oriented outward
    """
    down = np.concatenate([np.eye(3), -np.eye(3)])
    N = area_vectors(V, F) / 2
    area = np.linalg.norm(N, axis=1)
    depth = V @ down.T
    height, extent = np.ptp(depth, axis=0), _extent(V)
    overhang = _overhang(V, F, area, N @ down.T, down, depth.max(axis=0)) / area.sum()
    return [
        Pose(_turn(down[k]), float(height[k]), extent, float(overhang[k]), None)
        for k in np.argsort(overhang + height / extent, kind="stable").tolist()
    ]


def _extent(points: Floats) -> float:
    """The largest distance, as far as it starts from a point that is outermost in some direction."""
    from scipy.spatial.distance import cdist

    directions = np.stack(np.meshgrid(*[[-1.0, 0.0, 1.0]] * 3), -1).reshape(-1, 3)
    return float(cdist(points[(points @ directions.T).argmax(axis=0)], points).max())


def _centre_of_mass(V: Floats, F: Ints) -> Floats:
    """The centre of mass of a solid, (3,); of its corners where it has no volume."""
    middle = V.mean(axis=0)
    a, b, c = (V[F[:, k]] - middle for k in range(3))
    volume = np.einsum("ij,ij->i", a, np.cross(b, c))
    if abs(total := float(volume.sum())) <= 1e-9:
        return middle
    centre: Floats = middle + volume @ (a + b + c) / 4 / total
    return centre


def _stable(V: Floats, hull: object, centre: Floats) -> Floats:
    """The directions that point down in stable poses, (k, 3), the most stable first."""
    simplices: Ints = hull.simplices.astype(np.int64)  # type: ignore[attr-defined]
    planes: Floats = hull.equations  # type: ignore[attr-defined]
    distance = -(planes[:, :3] @ centre + planes[:, 3])
    foot = centre + distance[:, None] * planes[:, :3]
    bary = barycentric(V, simplices, np.arange(len(simplices)), foot)
    stable = bary.min(axis=1) >= -1e-9
    stable[distance.argmin()] = True  # no body tips off the face nearest to its centre
    faces = np.flatnonzero(stable)
    return _distinct(planes[faces[np.argsort(distance[faces], kind="stable")], :3])


def _distinct(directions: Floats) -> Floats:
    """Keep of ordered directions those that are not near one kept before, and not too many."""
    kept: list[Floats] = []
    while len(directions) and len(kept) < MOST:
        kept.append(directions[0])
        directions = directions[directions @ directions[0] < np.cos(np.radians(NEAR))]
    return np.array(kept)


def _overhang(V: Floats, F: Ints, area: Floats, facing: Floats, down: Floats, plate: Floats) -> Floats:
    """The area that leans over too far to be printed without support, mm2, (k,)."""
    leaning = facing > np.cos(np.radians(STEEP)) * area[:, None]
    on_plate = (plate - V @ down.T < ON_PLATE)[F].all(axis=1)
    return area @ (leaning & ~on_plate)


def _turn(down: Floats) -> Floats:
    """The rotation that takes a direction to -z, (3, 3)."""
    z = -unit(down)
    x = unit(np.cross(np.eye(3)[np.abs(z).argmin()], z))
    return np.stack([x, np.cross(z, x), z])
