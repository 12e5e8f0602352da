"""Vases: one with a creased foot, and a slender one for figures."""

import numpy as np
import trimesh

from models.rings import even, revolved, rounded

__all__ = ["slender_vase", "vase"]


def vase(around: int = 96, rows: int = 72) -> trimesh.Trimesh:
    """Revolve a profile with a creased foot: closed at the bottom, open at the top, 150 mm high."""
    foot = np.array([[0.0, 0.0], [26.0, 0.0], [30.0, 4.0], [20.0, 14.0]])
    t = np.linspace(0, 1, 200)
    belly = np.stack([20 + 32 * np.sin(np.pi * t**0.8) ** 1.5 + 6 * t**4, 14 + 136 * t], 1)
    return revolved(even(np.vstack([foot, belly[1:]]), rows, (0, 1, 2, 3)), around)


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
    return revolved(even(rounded(np.array(knots, float), 5), rows), around)
