"""A screwdriver: what a long limb with a changing girth looks like."""

import numpy as np
import trimesh

from models.rings import even, rounded, swept

__all__ = ["limb"]

_KNOTS = [
    (0, 0), (6, 0.6), (10, 3), (12.5, 9), (14, 22), (14.5, 40), (13, 54), (10, 64), (8.5, 72), (9, 78),
    (8.5, 84), (6.5, 92), (5.5, 104), (5, 130), (4.8, 142), (4.2, 146.5), (2.5, 149.2), (0, 150),
]  # fmt: skip


def limb(around: int = 120, rows: int = 210) -> trimesh.Trimesh:
    """Sweep a fluted handle, a waist, a shaft and a round tip; closed, 150 mm high."""
    profile = even(rounded(np.array(_KNOTS, float)), rows)
    height = profile[1:-1, 1:]
    flutes = 0.05 * np.clip((height - 6) / 14, 0, 1) * np.clip((62 - height) / 14, 0, 1)
    angle = 2 * np.pi * np.arange(around) / around
    radius = profile[1:-1, :1] * (1 + flutes * np.cos(6 * angle))
    rings = np.stack(
        [radius * np.cos(angle), np.broadcast_to(height, radius.shape), -radius * np.sin(angle)], -1
    )
    return swept(rings, np.array([0, profile[0, 1], 0]), np.array([0, profile[-1, 1], 0]))
