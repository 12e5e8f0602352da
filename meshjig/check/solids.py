"""Pieces as manifold3d bodies, for booleans and distances."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from meshjig.check.arrays import Piece

__all__ = ["Body", "bodies"]

Body = Any  # manifold3d.Manifold, or None where manifold3d refuses the piece


def bodies(pieces: Sequence[Piece]) -> list[Body]:
    """Give every piece as a manifold3d body in double precision, None where it is no manifold."""
    import manifold3d

    made = []
    for V, F in pieces:
        mesh = manifold3d.Mesh64(np.ascontiguousarray(V, np.float64), np.ascontiguousarray(F, np.uint64))
        body = manifold3d.Manifold(mesh)
        made.append(body if body.status() == manifold3d.Error.NoError else None)
    return made
