"""Pieces as manifold3d bodies, for booleans and distances."""

from __future__ import annotations

from collections.abc import Sequence

from meshjig.mesh.booleans import Body, body
from meshjig.mesh.validated import Piece

__all__ = ["Body", "bodies"]


def bodies(pieces: Sequence[Piece]) -> list[Body | None]:
    """Give every piece as a manifold3d body in double precision, None where it is no manifold."""
    import manifold3d

    made = [body(V, F) for V, F in pieces]
    return [one if one.status() == manifold3d.Error.NoError else None for one in made]
