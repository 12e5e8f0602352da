"""How thick pieces are, from one sheet to the other, measured on the finished pieces alone."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from meshjig.check.piece_rays import first_hit, scene_of
from meshjig.mesh.sampling import Soup, area_samples, soup
from meshjig.mesh.types import Bools, Floats, Ints
from meshjig.mesh.validated import Piece

__all__ = ["Thickness", "measure_thickness"]

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


def measure_thickness(pieces: Sequence[Piece]) -> Thickness:
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
    s = soup(pieces)
    scene = scene_of(s)
    P, face = area_samples(s, _SAMPLES_A_PIECE * len(pieces))
    exit_face, way = first_hit(scene, s, P, -s.N[face])
    through = (exit_face >= 0) & (s.piece[exit_face] == s.piece[face])
    through &= np.einsum("ij,ij->i", s.N[exit_face], s.N[face]) <= _OPPOSITE
    P, face, exit_face, way = P[through], face[through], exit_face[through], way[through]
    exit_point = P - way[:, None] * s.N[face]
    sheet = ~(_on_wall(scene, s, P, face) | _on_wall(scene, s, exit_point, exit_face))
    return Thickness(way[sheet], s.piece[face[sheet]])


def _on_wall(scene: Any, s: Soup, P: Floats, face: Ints) -> Bools:
    """Tell which points of the surface have another piece right before them, (k,) bool."""
    across, distance = first_hit(scene, s, P, s.N[face])
    wall = (across >= 0) & (s.piece[across] != s.piece[face]) & (distance < _WALL_REACH)
    return wall & (np.einsum("ij,ij->i", s.N[across], s.N[face]) <= _FACING)
