"""Build a unit from its tiles' outlines, each given edge by edge."""

from collections.abc import Sequence

import numpy as np

from meshjig.errors import OptionError
from meshjig.mesh.arrays import Floats, Ints
from meshjig.tiling.unit import Unit

__all__ = ["NoOtherSide", "assemble"]


class NoOtherSide(OptionError):
    """An edge of a tile is no edge of the tile on its other side."""

    def __init__(self, at: Floats) -> None:
        super().__init__(f"the edge at ({at[0]:.4g}, {at[1]:.4g}) is no edge of the tile on its other side")
        self.at = at


Reference = tuple[int, int, int]  # corner or tile, and how far it is moved


def assemble(tiles: Sequence[Sequence[Floats]], translations: Floats, tolerance: float = 1e-6) -> Unit:
    """Find out which edges of the tiles are one, and which corners.

    Parameters
    ----------
    tiles : sequence of sequences of (n, 2) float64
        A tile's edges counterclockwise, each from the corner where the one before it ends. The edge of
        the tile next to it runs back between the same corners; the first one's curve is kept.
    translations : (2, 2) float64, a vector a row, the second on the left of the first
    tolerance : float, share of a tile's edge that points which are one may lie apart

    Returns
    -------
    Unit
        Scaled so that the mean tile has area 1, its edges given as curves.

    Raises
    ------
    NoOtherSide
        The sentence names the place.
    """
    scale = float(np.sqrt(np.linalg.det(translations) / len(tiles)))
    lattice = _Lattice(translations, tolerance * scale)
    edges: list[tuple[int, Floats, Reference, Reference]] = [
        (tile, curve, lattice.corner(curve[0]), lattice.corner(curve[-1]))
        for tile, curves in enumerate(tiles)
        for curve in curves
    ]
    ends, sides, drawn = [], [], []
    left_over = list(range(len(edges)))
    while left_over:
        tile, curve, start, stop = edges[left_over.pop(0)]
        for k in left_over:
            other, back, first, last = edges[k]
            shift = (stop[1] - first[1], stop[2] - first[2])
            around = (last[0], last[1] + shift[0], last[2] + shift[1])
            if stop[0] == first[0] and around == start and lattice.is_same(curve, back[::-1], shift):
                left_over.remove(k)
                break
        else:
            raise NoOtherSide(_middle(curve))
        ends.append([start, stop])
        sides.append([(tile, 0, 0), (other, *shift)])
        drawn.append(lattice.snapped(curve, start, stop) / scale)
    return Unit(
        translations / scale,
        np.array(lattice.corners) / scale,
        np.array(ends),
        np.array(sides),
        len(tiles),
        curves=tuple(drawn),
    )


class _Lattice:
    """Points that count as one where they lie whole translations apart."""

    def __init__(self, translations: Floats, tolerance: float) -> None:
        self.translations = translations
        self.tolerance = tolerance
        self.corners: list[Floats] = []

    def corner(self, point: Floats) -> Reference:
        """Name the corner at a point, a new one if need be."""
        for number, corner in enumerate(self.corners):
            shift = self._shift(point - corner)
            if np.linalg.norm(point - corner - shift @ self.translations) <= self.tolerance:
                return number, int(shift[0]), int(shift[1])
        self.corners.append(point)
        return len(self.corners) - 1, 0, 0

    def is_same(self, curve: Floats, other: Floats, shift: tuple[int, int]) -> bool:
        """Tell whether two curves lie on each other halfway, the other one moved."""
        apart = _middle(curve) - _middle(other) - np.array(shift) @ self.translations
        return bool(np.linalg.norm(apart) <= max(4 * self.tolerance, 0.02 * _length(curve)))

    def snapped(self, curve: Floats, start: Reference, stop: Reference) -> Floats:
        """Put a curve's ends onto its corners."""
        curve = curve.copy()
        for end, (corner, *shift) in ((0, start), (-1, stop)):
            curve[end] = self.corners[corner] + np.array(shift) @ self.translations
        return curve

    def _shift(self, apart: Floats) -> Ints:
        return np.rint(apart @ np.linalg.inv(self.translations)).astype(np.int64)


def _length(curve: Floats) -> float:
    return float(np.linalg.norm(np.diff(curve, axis=0), axis=1).sum())


def _middle(curve: Floats) -> Floats:
    """The point halfway along a curve."""
    along = np.r_[0.0, np.linalg.norm(np.diff(curve, axis=0), axis=1).cumsum()]
    return np.array([np.interp(along[-1] / 2, along, curve[:, axis]) for axis in (0, 1)])
