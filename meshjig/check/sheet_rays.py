"""Rays through finished pieces, from one sheet to the other, which no file tells from walls."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from meshjig.check.sharp_edges import at_edges
from meshjig.check.soup import area_samples, first_hit, smooth_regions, soup
from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.halfedges import edges
from meshjig.mesh.pieces import Pieces
from meshjig.mesh.rays import RayScene

__all__ = ["OPPOSITE", "Rays", "SheetRays"]

OPPOSITE = -0.5  # cosine between the normals where a ray goes in and where it comes out
_STRAIGHT = -0.95  # the same, of a ray from a sheet to another that lies along it
_FACING = -0.8  # cosine between the normals of two walls that face each other
_WALL_REACH = 1.0  # mm; a wall has another piece before it, no farther than this
_WALL_SHARE = 0.5  # of a smooth region that faces other pieces, from which all of it is wall
_FLAKE = 0.001  # of a piece's surface; smaller smooth regions beside a wall are of the wall
_BROAD = 0.02  # of a piece's surface, that a smooth region has which is no flake of a wall
_SAMPLES_A_PIECE = 1000


class Rays(NamedTuple):
    """Rays that came out on the piece they went into, through a face that looks the other way."""

    start: Floats  # (k, 3), mm
    end: Floats  # (k, 3), mm
    way: Floats  # (k,), mm
    piece: Ints  # (k,)
    free: Bools  # (k,), nothing lies right before either end
    sheet: Bools  # (k,), they go from sheet to sheet
    faces: Ints  # (k, 2), the faces of all pieces that they start and end on

    def where(self, some: Bools) -> Rays:
        """Give some of the rays."""
        return Rays(
            self.start[some],
            self.end[some],
            self.way[some],
            self.piece[some],
            self.free[some],
            self.sheet[some],
            self.faces[some],
        )


class SheetRays:
    """Pieces that are ready for rays.

    A point is before another piece when that has a face that turns towards it within 1 mm. A smooth region of
    which half is so is a wall, with its corners, where nothing lies before it, and with what is tiny beside
    it. The two inner sheets of a limb lie before each other as walls do: a ray that comes straight to one
    from a broad region that is free has met a sheet.

    Parameters
    ----------
    pieces : Pieces, closed and oriented outward
    """

    def __init__(self, pieces: Pieces) -> None:
        self._soup = soup(pieces)
        self._scene = RayScene(self._soup.V, self._soup.F)
        self._spread = area_samples(self._soup, _SAMPLES_A_PIECE * len(pieces))
        region, share = self._regions()
        self._wall, self._broad = self._walls(region, share)[region], (share >= _BROAD)[region]

    def spread(self) -> Rays:
        """Send in rays that each stand for the same area, a thousand a piece as a mean."""
        return self._through(*self._spread)

    def of_each(self, some: Ints, n: int) -> Rays:
        """Send n rays, spread evenly, into each of some pieces."""
        s = self._soup
        whole = np.bincount(s.piece, s.area, minlength=int(s.piece.max()) + 1)
        share = np.where(np.isin(s.piece, some), s.area / np.maximum(whole, 1e-300)[s.piece], 0.0)
        return self._through(*area_samples(s._replace(area=share), n * len(some)))

    def at_edges(self, rays: Rays) -> Bools:
        """Tell which rays go through a sharp edge, see `at_edges`, (k,) bool."""
        return at_edges(self._soup, rays.start, rays.end, rays.faces)

    def _through(self, P: Floats, face: Ints) -> Rays:
        s = self._soup
        exit_face, way = first_hit(self._scene, s, P, -s.N[face])
        turned = np.einsum("ij,ij->i", s.N[exit_face], s.N[face])
        through = (exit_face >= 0) & (s.piece[exit_face] == s.piece[face]) & (turned <= OPPOSITE)
        P, face, exit_face = P[through], face[through], exit_face[through]
        way, turned = way[through], turned[through]
        end = P - way[:, None] * s.N[face]
        before = self._before(P, face), self._before(end, exit_face)
        wall, across = self._wall[face] | before[0], self._wall[exit_face] | before[1]
        broad = np.where(wall, self._broad[exit_face], self._broad[face])
        sheet = ~(wall | across) | ((wall ^ across) & broad & (turned <= _STRAIGHT))
        return Rays(
            P, end, way, s.piece[face], ~(before[0] | before[1]), sheet, np.stack([face, exit_face], 1)
        )

    def _regions(self) -> tuple[Ints, Floats]:
        """Give the smooth region of each face, (m,), and which share of its piece each region is, (n,)."""
        s, region = self._soup, smooth_regions(self._soup)
        whole = np.maximum(np.bincount(s.piece, s.area), 1e-300)
        return region, np.asarray(np.bincount(region, s.area / whole[s.piece]), np.float64)

    def _walls(self, region: Ints, share: Floats) -> Bools:
        """Mark the smooth regions that are walls, (n,) bool."""
        s, (P, face), n = self._soup, self._spread, len(share)
        every, middle = np.arange(len(s.F)), s.V[s.F].mean(axis=1)  # for regions too small for a sample
        at = region[np.append(face, every)]
        weight = np.append(np.full(len(P), s.area.sum() / len(P)), s.area)
        before = np.append(self._before(P, face), self._before(middle, every))
        wall = np.bincount(at, weight * before, n) >= _WALL_SHARE * np.maximum(
            np.bincount(at, weight, n), 1e-300
        )
        touching = np.zeros(n, bool)
        touching[region[np.flatnonzero(wall[region[edges(s.F).twin // 3]]) // 3]] = True
        return np.asarray(wall | (touching & (share < _FLAKE)))

    def _before(self, P: Floats, face: Ints) -> Bools:
        """Tell which points of the surface have another piece right before them, (k,) bool."""
        s = self._soup
        across, distance = first_hit(self._scene, s, P, s.N[face])
        facing = (across >= 0) & (s.piece[across] != s.piece[face]) & (distance < _WALL_REACH)
        return facing & (np.einsum("ij,ij->i", s.N[across], s.N[face]) <= _FACING)
