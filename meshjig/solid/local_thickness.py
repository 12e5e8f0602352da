"""How thick a wall can be at all, half the way through the model by rays; and how thin walls came out."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from meshjig.errors import SolidError
from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.halfedges import border_halfedges
from meshjig.mesh.measure import area_vectors, face_areas, mesh_volume
from meshjig.mesh.rays import RayScene

__all__ = [
    "ThinFacts",
    "TooThick",
    "check_thickness",
    "inward_room",
    "refuse_crowds",
    "thin_share",
    "thinness",
]

_SHARE = 0.45  # of the way through the model; two walls meet at half
_FAR = 1e9  # mm
_TILT = np.deg2rad(35.0)
_OPPOSITE = -0.7  # cosine between normals: a tilted ray counts when it ends on a surface that faces back
_CROWDED = 1 / 3  # share of the area that may be thin
_THIN = 0.8  # of the thickness


def inward_room(V: Floats, F: Ints, d: Floats, enough: float = np.inf) -> Floats:
    """Measure how deep a wall may go at each vertex before it meets the one from the other side.

    One ray goes straight inward. Four tilted rays find what it misses behind folds and in corners.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, oriented outward
    d : (n, 3) float64, unit, outward
    enough : float, mm; tilted rays need not find out whether there is more room than that

    Returns
    -------
    (n,) float64, mm: 0.45 of the free way; inf where nothing lies across, as on an open surface

    Notes
    -----
    Rays start a little below the surface, and a hit is measured in the hit face's plane in float64, since
    Embree works in float32.
    """
    scene = RayScene(V, F)
    N = area_vectors(V, F)
    N /= np.maximum(np.linalg.norm(N, axis=1), 1e-300)[:, None]
    origin = V - 1e-3 * d
    side, across = _frame(d)
    depth = np.full(len(V), np.inf)
    for angle, around in [(0.0, 0.0), *((_TILT, k * np.pi / 2) for k in range(4))]:
        ray = -np.cos(angle) * d + np.sin(angle) * (np.cos(around) * side + np.sin(around) * across)
        far = min(enough / _SHARE / np.cos(angle), _FAR) if angle else _FAR
        face = scene.first_face(origin, ray, np.full(len(V), far))
        hit = np.flatnonzero(face >= 0)
        n = N[face[hit]]
        facing = np.einsum("ij,ij->i", ray[hit], n)
        way = np.einsum("ij,ij->i", V[F[face[hit], 0]] - origin[hit], n) / np.where(
            facing > 1e-6, facing, np.inf
        )
        valid = (facing > 1e-6) & (way > 0)
        if angle:
            valid &= np.einsum("ij,ij->i", n, d[hit]) < _OPPOSITE
        depth[hit[valid]] = np.minimum(depth[hit[valid]], way[valid] * np.cos(angle))
    return _SHARE * depth


def thin_share(V: Floats, F: Ints, thin: Bools) -> float:
    """Give the share of the area at vertices that are marked thin."""
    area = face_areas(V, F)
    return float((area * thin[F].mean(1)).sum() / max(area.sum(), 1e-300))


def _frame(d: Floats) -> tuple[Floats, Floats]:
    """Give two unit vectors at right angles to unit d."""
    axis = np.eye(3)[np.abs(d).argmin(1)]
    side = np.cross(d, axis)
    side /= np.maximum(np.linalg.norm(side, axis=1), 1e-300)[:, None]
    return side, np.cross(d, side)


class TooThick(SolidError):
    """A model has no room for walls so thick.

    Parameters
    ----------
    thickness : float, mm, that was wanted
    largest : float, mm, that may do
    """

    def __init__(self, thickness: float, largest: float) -> None:
        step = 10.0 ** np.floor(np.log10(max(largest, 1e-6)) - 1)
        self.largest = float(np.floor(largest / step) * step)  # rounded down to two digits
        super().__init__(
            f"walls of {thickness:.3g} mm are too thick for this model",
            hint=f"a thickness of {self.largest:.3g} mm may do",
        )


class ThinFacts(NamedTuple):
    """Where walls came out too thin."""

    thin_area_share: float  # of the area, that is under 0.8 of the thickness
    min_thickness: float  # mm
    thinnest_at: list[float]  # x, y, z


def thinness(V: Floats, F: Ints, distance: Floats, thickness: float) -> ThinFacts:
    """Say how much of the area is too thin, how thin, and where.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64
    distance : (n,) float64, mm, from one sheet to the other
    thickness : float, mm, that was wanted

    Returns
    -------
    ThinFacts
    """
    least = int(distance.argmin())
    share = thin_share(V, F, distance < _THIN * thickness)
    return ThinFacts(share, float(distance[least]), V[least].tolist())


def check_thickness(V: Floats, F: Ints, thickness: float, room: Floats) -> None:
    """Refuse walls that the model has no room for.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64
    thickness : float, mm
    room : (n,) float64, mm, as `inward_room` gives it

    Raises
    ------
    TooThick
        The thickness is over a third of a closed model's smallest extent or of an open model's middle one,
        or twice what more than half of the surface has room for.
    """
    largest = 2 * _quantile(room[F].mean(1), face_areas(V, F), 0.5)
    closed = mesh_volume(V, F) > 0 and not len(border_halfedges(F))
    third = float(np.sort(np.ptp(V[F.ravel()], axis=0))[0 if closed else 1]) / 3
    if thickness > third:
        largest = min(largest, third)
    if thickness > largest:
        raise TooThick(thickness, largest)


def refuse_crowds(V: Floats, F: Ints, thickness: float, room: Floats, distance: Floats) -> None:
    """Refuse a wall that crosses itself where much of it is too thin as well: the model lacks the room."""
    if thin_share(V, F, distance < _THIN * thickness) > _CROWDED:
        fits = _quantile(room[F].mean(1), face_areas(V, F), _CROWDED) / _THIN
        raise TooThick(thickness, min(fits, _THIN * thickness))


def _quantile(values: Floats, weights: Floats, q: float) -> float:
    order = np.argsort(values)
    share = np.cumsum(weights[order])
    return float(values[order[np.searchsorted(share, q * share[-1])]])
