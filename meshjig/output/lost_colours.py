"""What the colours of a scan lose in the files of a puzzle."""

from __future__ import annotations

from collections.abc import Sequence

from meshjig.output.piece import Piece

__all__ = ["lost_colours"]

_KEEP_ALL = {"3mf", "obj", "glb"}


def lost_colours(pieces: Sequence[Piece], formats: Sequence[str], plates: bool) -> list[str]:
    """Say in a sentence where no file keeps what the scan shows.

    Parameters
    ----------
    pieces : sequence of Piece
    formats : sequence of str, those of the pieces
    plates : bool, whether there are plates as well, which are 3MF

    Returns
    -------
    list of str; empty where the scan shows nothing, or a file keeps it
    """
    textures = [piece.texture for piece in pieces if piece.texture is not None]
    if not textures or plates or _KEEP_ALL & set(formats):
        return []
    what = "texture" if textures[0].picture is not None else "colours"
    if "ply" not in formats:
        return [f"STL has no colours: add 3mf to --format to keep the {what} of the scan"]
    if what == "texture":
        return ["PLY has the texture of the scan at vertices only: add 3mf to --format to keep all of it"]
    return []
