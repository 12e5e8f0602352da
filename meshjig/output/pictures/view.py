"""Where a picture is taken from: which way is up, and what fits into the frame."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from meshjig.errors import OptionError
from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.measure import area_vectors, unit
from meshjig.mesh.rays import Floats32, Numbers

__all__ = ["View", "axis_of", "guess_up", "up_of", "view_of"]

_DISTANCE = 4.5  # of the eye, in radii of the model: a mild perspective

_SAMPLE = 50_000  # faces that are enough to find a base


@dataclass(frozen=True)
class View:
    """A camera: rays leave ``eye`` through a rectangle of the plane at distance 1."""

    eye: Floats  # (3,), mm
    axes: Floats  # (3, 3), rows: right, up, forward
    centre: Floats  # (2,), middle of the frame in the plane at distance 1
    half: float  # half the larger side of the frame

    def rays(self, x: Numbers, y: Numbers) -> Floats32:
        """Give the directions (k, 3) of rays through points of the plane at distance 1."""
        right, up, forward = self.axes.astype(np.float32)
        out = np.empty((len(x), 3), np.float32)
        for k in range(3):
            out[:, k] = forward[k] + x * right[k] + y * up[k]
        return out

    def on_plane(self, points: Floats) -> Floats:
        """Give where points (..., 3) are seen in the plane at distance 1, (..., 2)."""
        seen = (points - self.eye) @ self.axes.T
        return seen[..., :2] / seen[..., 2:]


def axis_of(name: str) -> Floats:
    """Give the unit vector of an axis called x, y, z, -x, -y or -z.

    Raises
    ------
    OptionError
        There is no such axis.
    """
    letter = name.removeprefix("-").removeprefix("+")
    if letter not in ("x", "y", "z"):
        raise OptionError(f"there is no axis {name!r}", hint="use x, y, z, -x, -y, -z or auto")
    return np.eye(3)["xyz".index(letter)] * (-1.0 if name.startswith("-") else 1.0)


def guess_up(V: Floats, F: Ints) -> Floats:
    """Guess which way a model stands: up from its flat base, if it clearly has one; else y.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64

    Returns
    -------
    (3,) float64, a unit vector

    Notes
    -----
    A base is a share of the area that lies in one supporting plane. Only ups towards +y or +z count: that
    is how models are stored, and a flat top is as common as a flat bottom.
    """
    F = F[:: 1 + len(F) // _SAMPLE]
    N = area_vectors(V, F)
    size = np.linalg.norm(N, axis=1)
    normal = unit(N)
    middle = V[F].mean(axis=1)
    extent = float(np.ptp(V, axis=0).max())
    best = 0.0
    up: Floats = np.array([0.0, 1.0, 0.0])
    for down in _common_directions(normal, size):
        if max(-down[1], -down[2]) < 0.5:
            continue
        base = (normal @ down > 0.98) & (middle @ down > float((V @ down).max()) - 0.01 * extent)
        share = float(size[base].sum() / size.sum())
        score = share * (1 - down[1])
        if share > 0.015 and score > best:
            best, up = score, -(N * base[:, None]).sum(axis=0)
    up = unit(up)
    return np.round(up) if np.abs(up).max() > 0.99 else up  # a base is seldom tilted by less than 8 degrees


def up_of(report: Mapping[str, Any], V: Floats, F: Ints) -> Floats:
    """Give which way a puzzle is up: as its report says, else as its shape suggests.

    Parameters
    ----------
    report : mapping; ``up``, if there, is a vector
    V : (n, 3) float64, mm, of all pieces
    F : (m, 3) int64

    Returns
    -------
    (3,) float64, a unit vector
    """
    said = report.get("up")
    return guess_up(V, F) if said is None else unit(np.array(said, np.float64))


def _common_directions(normal: Floats, size: Floats) -> Floats:
    """The normals that most area has, roughly, at most ten."""
    cell = np.round(normal * 6).astype(np.int64) + 6
    code = cell @ np.array([169, 13, 1])
    weight = np.bincount(code, size, 13**3)
    cells = np.argsort(-weight, kind="stable")[:10]
    sums: Floats = np.stack([np.bincount(code, normal[:, k] * size, 13**3)[cells] for k in range(3)], 1)
    return unit(sums[weight[cells] > 0])


def view_of(V: Floats, up: Floats, azimuth: float, elevation: float) -> View:
    """Look at points from a side so that they fill the frame.

    Parameters
    ----------
    V : (n, 3) float64, mm
    up : (3,) float64, unit
    azimuth, elevation : float, degrees; azimuth 0 is the front: +z for y up, -y for z up

    Returns
    -------
    View
    """
    low, high = V.min(axis=0), V.max(axis=0)
    middle, radius = (low + high) / 2, max(float(np.linalg.norm(high - low)) / 2, 1e-9)
    front = np.array([0.0, 0.0, 1.0]) if abs(up[2]) < 0.7 else np.array([0.0, -1.0, 0.0])
    front = unit(front - (front @ up) * up)
    turn, lift = np.radians(azimuth), np.radians(elevation)
    toward_eye = (
        np.cos(lift) * (np.cos(turn) * front + np.sin(turn) * np.cross(up, front)) + np.sin(lift) * up
    )
    right = unit(np.cross(up, toward_eye))
    axes = np.stack([right, np.cross(toward_eye, right), -toward_eye])
    eye = middle + _DISTANCE * radius * toward_eye
    seen = (V - eye) @ axes.T
    plane = seen[:, :2] / seen[:, 2:]
    least, most = plane.min(axis=0), plane.max(axis=0)
    return View(eye, axes, (least + most) / 2, float((most - least).max()) / 2)
