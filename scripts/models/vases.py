"""Vases: one with a creased foot, and a slender one for figures."""

import numpy as np
import trimesh

from models.patches import flat, flipped, joined, mean_girth, meshed, spread, tube, wheel
from models.rings import even, rounded

__all__ = ["slender_vase", "vase"]


def vase(around: int = 96, rows: int = 72) -> trimesh.Trimesh:
    """Revolve a profile with a creased foot: closed at the bottom, open at the top, 150 mm high."""
    foot = np.array([[0.0, 0.0], [26.0, 0.0], [30.0, 4.0], [20.0, 14.0]])
    t = np.linspace(0, 1, 200)
    belly = np.stack([20 + 32 * np.sin(np.pi * t**0.8) ** 1.5 + 6 * t**4, 14 + 136 * t], 1)
    return _turned(even(np.vstack([foot, belly[1:]]), rows, (0, 1, 2, 3)), around, 26.0)


def slender_vase(around: int = 200, rows: int = 140) -> trimesh.Trimesh:
    """Revolve a smooth profile: closed at the bottom, open at the top, 150 mm high."""
    knots = [
        (0, 0),
        (22, 0),
        (30, 2),
        (33, 10),
        (42, 35),
        (44, 62),
        (34, 95),
        (20, 120),
        (20, 136),
        (29, 150),
    ]
    return _turned(even(rounded(np.array(knots, float), 5), rows), around, 22.0)


def _turned(profile: np.ndarray, around: int, sole: float) -> trimesh.Trimesh:
    """Turn a profile of radius and height about the y axis; what is within the sole is laid flat as it is."""
    angle = 2 * np.pi * np.arange(around) / around
    x, z = profile[1:, :1] * np.cos(angle), -profile[1:, :1] * np.sin(angle)
    rings = np.stack([x, np.broadcast_to(profile[1:, 1:], x.shape), z], -1)
    edge = int((profile[1:, 0] > sole - 1e-6).argmax())
    side = rings[edge:]
    way = np.append(0.0, np.cumsum(np.linalg.norm(np.diff(profile[1 + edge :], axis=0), axis=1)))
    girth = mean_girth(side, way)
    wall = tube(side, girth * np.arange(around + 1) / around, spread(side, way, girth))
    bottom = wheel(rings[: edge + 1], np.array([0, profile[0, 1], 0]), angle)
    return meshed(joined([wall, flat(flipped(bottom), (0, 2))]))
