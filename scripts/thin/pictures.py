"""Pictures of a puzzle from both sides, a colour a piece, and what is too thin in red."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from PIL import Image

from meshjig.mesh.arrays import Floats
from meshjig.mesh.mesh import Mesh, concatenate
from meshjig.mesh.pieces import Pieces
from meshjig.output.pictures.colours import colours
from meshjig.output.pictures.render import render
from meshjig.output.pictures.scene import scene_of
from meshjig.output.pictures.view import view_of

__all__ = ["draw"]

_SIDES = ((30.0, 18.0), (210.0, 18.0))  # azimuth and elevation, degrees
_SIZE = 900  # pixels
_RED = (0.85, 0.05, 0.05)
_MARK = 0.5  # mm


def draw(path: Path, pieces: Sequence[Mesh], up: Floats, thin: Floats) -> None:
    """Draw pieces from the front and from behind, side by side, and mark places (k, 3)."""
    tint = colours(len(pieces), Pieces.of(pieces).close(0.5))
    whole = concatenate([*pieces, *(_mark(at) for at in thin)])
    tint = np.concatenate([tint, np.tile(_RED, (len(thin), 1))])
    scene = scene_of(whole.V, whole.F, tint[whole.part_of_face], whole.part_of_face)
    views = [view_of(whole.V, up, *side) for side in _SIDES]
    halves = [render(scene, replace(view, half=1.05 * view.half), _SIZE) for view in views]
    Image.fromarray(np.hstack(halves)).save(path)


def _mark(at: Floats) -> Mesh:
    """Give a small octahedron around a place."""
    V = at + _MARK * np.concatenate([np.eye(3), -np.eye(3)])
    return Mesh(
        V,
        np.array([[0, 1, 2], [1, 3, 2], [3, 4, 2], [4, 0, 2], [1, 0, 5], [3, 1, 5], [4, 3, 5], [0, 4, 5]]),
    )
