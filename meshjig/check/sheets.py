"""Where the gap was met between two sheets, and not between two walls."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from meshjig.check.gap import Gap
from meshjig.check.piece_rays import first_hit, scene_of
from meshjig.mesh.sampling import soup
from meshjig.mesh.validated import Piece

__all__ = ["without_sheets"]

_OPPOSITE = -0.5  # cosine between the normals where a ray goes in and where it comes out


def without_sheets(
    gap: Gap, pieces: Sequence[Piece], pairs: Sequence[tuple[int, int]], thickest: float
) -> Gap:
    """Leave out the samples between some pairs that lie on a sheet.

    Inside an ear or a fin the inner sheets of front and back face each other all over, as walls do. Behind a
    sheet the piece is as thick as its material; behind a wall, unless at a neck, it goes on.

    Parameters
    ----------
    gap : Gap
    pieces : list of (V, F), those it was measured on
    pairs : pairs of pieces
    thickest : float, mm, the most that a sheet has behind it

    Returns
    -------
    Gap
    """
    among = {(min(pair), max(pair)) for pair in pairs}
    asked = np.flatnonzero([tuple(pair) in among for pair in gap.sample_pair.tolist()])
    s = soup(pieces)
    face = gap.sample_face[asked]
    behind, way = first_hit(scene_of(s), s, gap.at[asked], -s.N[face])
    sheet = (behind >= 0) & (s.piece[behind] == s.piece[face]) & (way <= thickest)
    sheet &= np.einsum("ij,ij->i", s.N[behind], s.N[face]) <= _OPPOSITE
    kept = np.ones(len(gap.samples), bool)
    kept[asked[sheet]] = False
    return replace(
        gap,
        samples=gap.samples[kept],
        sample_pair=gap.sample_pair[kept],
        sample_face=gap.sample_face[kept],
        at=gap.at[kept],
    )
