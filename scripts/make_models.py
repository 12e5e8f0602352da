"""Make the models in data/: shapes computed here, nothing downloaded."""

from pathlib import Path

import numpy as np
import trimesh

DATA = Path(__file__).parent.parent / "data"


def vase(around: int = 96, rows: int = 72) -> trimesh.Trimesh:
    """Revolve a profile with a creased foot: closed at the bottom, open at the top, 150 mm high."""
    foot = np.array([[0.0, 0.0], [26.0, 0.0], [30.0, 4.0], [20.0, 14.0]])
    t = np.linspace(0, 1, 200)
    belly = np.stack([20 + 32 * np.sin(np.pi * t**0.8) ** 1.5 + 6 * t**4, 14 + 136 * t], 1)
    profile = _resampled(np.vstack([foot, belly[1:]]), rows)[1:]
    angle = np.linspace(0, 2 * np.pi, around, endpoint=False)
    rings = np.stack(
        [
            profile[:, :1] * np.cos(angle),
            np.broadcast_to(profile[:, 1:], (len(profile), around)),
            -profile[:, :1] * np.sin(angle),
        ],
        -1,
    )
    i, j = np.meshgrid(np.arange(len(profile) - 1), np.arange(around), indexing="ij")
    a, b = i * around + j, i * around + (j + 1) % around
    c, d = a + around, b + around
    walls = np.stack([np.stack([a, b, d], -1), np.stack([a, d, c], -1)], 2).reshape(-1, 3)
    pole = len(profile) * around
    bottom = np.stack([np.full(around, pole), np.roll(np.arange(around), -1), np.arange(around)], 1)
    vertices = np.vstack([rings.reshape(-1, 3), [[0.0, 0.0, 0.0]]])
    return trimesh.Trimesh(vertices, np.vstack([walls, bottom]), process=False)


def _resampled(polyline: np.ndarray, n: int) -> np.ndarray:
    """Spread points along a polyline, its corners among them."""
    length = np.linalg.norm(np.diff(polyline, axis=0), axis=1)
    arc = np.concatenate([[0], np.cumsum(length)])
    corners = arc[:4]
    even = np.linspace(0, arc[-1], n)
    away = np.abs(even[:, None] - corners).min(1) > 0.4 * even[1]
    place = np.sort(np.concatenate([even[away], corners]))
    return np.stack([np.interp(place, arc, polyline[:, k]) for k in (0, 1)], 1)


if __name__ == "__main__":
    DATA.mkdir(exist_ok=True)
    vase().export(DATA / "vase.ply")
