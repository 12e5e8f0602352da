"""How thick pieces are, from one sheet to the other, measured on the finished pieces alone."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from meshjig.check.gap import Gap
from meshjig.check.soup import Soup, area_samples, first_hit, soup
from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.pieces import Pieces
from meshjig.mesh.rays import RayScene

__all__ = ["Thickness", "measure_thickness", "without_sheets"]

_SAMPLES_A_PIECE = 1000
_OPPOSITE = -0.5  # cosine between the normals where a ray goes in and where it comes out
_FACING = -0.8  # cosine between the normals of two walls that face each other
_WALL_REACH = 1.0  # mm; a wall has another piece before it, no farther than this


@dataclass(frozen=True)
class Thickness:
    """Thicknesses at points spread evenly over the sheets."""

    samples: Floats  # (k,), mm
    piece: Ints  # (k,), the piece of a sample

    def facts(self, nominal: float | None) -> dict[str, float | None]:
        """Give min, p1 and median in mm, and the share of the area under 0.8 of the nominal thickness."""
        known = len(self.samples) > 0
        return {
            "min": float(self.samples.min()) if known else None,
            "p1": float(np.percentile(self.samples, 1)) if known else None,
            "median": float(np.median(self.samples)) if known else None,
            "thin_area_share": float((self.samples < 0.8 * nominal).mean()) if known and nominal else None,
        }

    def thin(self, least: float) -> list[int]:
        """List the pieces of which more than 1 % of the sheets is thinner than the least thickness, mm."""
        order = np.argsort(self.piece, kind="stable")
        found, start = np.unique(self.piece[order], return_index=True)
        own = np.split(self.samples[order], start[1:])
        return [int(i) for i, x in zip(found, own, strict=False) if np.percentile(x, 1) < least]


def measure_thickness(pieces: Iterable[Any]) -> Thickness:
    """Measure the thickness of pieces with rays that go straight in and come out on the other side.

    A file does not tell sheets from walls. A point is taken to lie on a wall when another piece's face
    turns towards it within 1 mm. A ray counts when it neither starts nor ends on a wall, and comes out
    on the piece itself, through a face that looks the other way.

    Parameters
    ----------
    pieces : list of (V, F)
        V (n, 3) float64, mm; F (m, 3) int64, closed and oriented outward.

    Returns
    -------
    Thickness

    Notes
    -----
    Both sheets are sampled. The rim of an open surface faces nobody and counts as sheet: that is why
    the figures to rely on are p1 and the median.
    """
    pieces = Pieces.of(pieces)
    s = soup(pieces)
    scene = RayScene(s.V, s.F)
    P, face = area_samples(s, _SAMPLES_A_PIECE * len(pieces))
    exit_face, way = first_hit(scene, s, P, -s.N[face])
    through = (exit_face >= 0) & (s.piece[exit_face] == s.piece[face])
    through &= np.einsum("ij,ij->i", s.N[exit_face], s.N[face]) <= _OPPOSITE
    P, face, exit_face, way = P[through], face[through], exit_face[through], way[through]
    exit_point = P - way[:, None] * s.N[face]
    sheet = ~(_on_wall(scene, s, P, face) | _on_wall(scene, s, exit_point, exit_face))
    return Thickness(way[sheet], s.piece[face[sheet]])


def _on_wall(scene: RayScene, s: Soup, P: Floats, face: Ints) -> Bools:
    """Tell which points of the surface have another piece right before them, (k,) bool."""
    across, distance = first_hit(scene, s, P, s.N[face])
    wall = (across >= 0) & (s.piece[across] != s.piece[face]) & (distance < _WALL_REACH)
    return wall & (np.einsum("ij,ij->i", s.N[across], s.N[face]) <= _FACING)


def without_sheets(gap: Gap, pieces: Pieces, pairs: Sequence[tuple[int, int]], thickest: float) -> Gap:
    """Leave out the samples between some pairs that lie on a sheet.

    Inside an ear or a fin the inner sheets of front and back face each other all over, as walls do. Behind a
    sheet the piece is as thick as its material; behind a wall, unless at a neck, it goes on.

    Parameters
    ----------
    gap : Gap
    pieces : Pieces, those it was measured on
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
    behind, way = first_hit(RayScene(s.V, s.F), s, gap.at[asked], -s.N[face])
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
