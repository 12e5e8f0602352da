"""How thick pieces are, from one sheet to the other, measured on the finished pieces alone."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from meshjig.check.gap import Gap
from meshjig.check.sheet_rays import OPPOSITE, SheetRays
from meshjig.check.soup import first_hit, soup
from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.pieces import Pieces
from meshjig.mesh.rays import RayScene

__all__ = ["THICKNESS_SHARE", "Thickness", "measure_thickness", "thickest", "thickness_of", "without_sheets"]

THICKNESS_SHARE = (0.8, 1.25)  # of the thickness, between which a piece's median must lie


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

    def without(self, pieces: Collection[int]) -> Thickness:
        """Leave out the samples of some pieces."""
        kept = ~np.isin(self.piece, list(pieces))
        return Thickness(self.samples[kept], self.piece[kept])


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
    return thickness_of(SheetRays(Pieces.of(pieces)))


def thickness_of(rays: SheetRays) -> Thickness:
    """Measure the thickness of pieces that are ready for rays."""
    found = rays.spread()
    return Thickness(found.way[found.free], found.piece[found.free])


def thickest(sheets: Thickness, nominal: float, through: Collection[int], n: int) -> Floats:
    """Give the most that a sheet of each of n pieces has behind it, (n,), mm.

    Parameters
    ----------
    sheets : Thickness
    nominal : float, mm, what pieces are as thick as
    through : pieces that reach through a part, and are as thick as that is
    n : int
    """
    most = np.full(n, nominal)
    for i in through:
        own = np.append(sheets.samples[sheets.piece == i], nominal)
        most[i] = max(nominal, float(np.percentile(own, 99)))
    return THICKNESS_SHARE[1] * most


def without_sheets(gap: Gap, pieces: Pieces, pairs: Sequence[tuple[int, int]], behind: Floats) -> Gap:
    """Leave out the samples between some pairs that lie on a sheet.

    Inside an ear or a fin the inner sheets of front and back face each other all over, as walls do. Behind a
    sheet the piece is as thick as its material; behind a wall, unless at a neck, it goes on.

    Parameters
    ----------
    gap : Gap
    pieces : Pieces, those it was measured on
    pairs : pairs of pieces
    behind : (n,) float64, mm, the most that a sheet of each piece has behind it

    Returns
    -------
    Gap
    """
    among = {(min(pair), max(pair)) for pair in pairs}
    asked = np.flatnonzero([tuple(pair) in among for pair in gap.sample_pair.tolist()])
    s = soup(pieces)
    face = gap.sample_face[asked]
    far, way = first_hit(RayScene(s.V, s.F), s, gap.at[asked], -s.N[face])
    sheet = (far >= 0) & (s.piece[far] == s.piece[face]) & (way <= behind[s.piece[face]])
    sheet &= np.einsum("ij,ij->i", s.N[far], s.N[face]) <= OPPOSITE
    kept = np.ones(len(gap.samples), bool)
    kept[asked[sheet]] = False
    return replace(
        gap,
        samples=gap.samples[kept],
        sample_pair=gap.sample_pair[kept],
        sample_face=gap.sample_face[kept],
        at=gap.at[kept],
    )
