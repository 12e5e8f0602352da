"""Symmetries of a tile: which of its edges are alike, and where that puts its copies."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from meshjig.mesh.arrays import Floats

__all__ = ["PAIRS", "Complex", "Motion", "Pair", "copies", "snapped_corners"]

Complex = NDArray[np.complex128]  # points of the plane

_SAME = 1e-6  # of a tile
_STEPS = 4  # from neighbour to neighbour, to all turns and to two translations


@dataclass(frozen=True)
class Pair:
    """Two edges that are alike, or one edge that is its own other half turned.

    A motion takes the tile onto its neighbour, and the first edge onto the second: it mirrors the
    plane at the x axis where mirrored is set, then turns it. Mirrored edges run the same way around
    the tile, others run against each other.
    """

    first: int
    second: int
    degrees: float = 0.0
    mirrored: bool = False

    @property
    def turn(self) -> "Motion":
        """The motion, up to a translation."""
        return Motion(complex(np.exp(1j * np.radians(self.degrees))), 0.0, self.mirrored)

    def motion(self, corners: Complex) -> "Motion":
        """The motion for a tile with corners (c,)."""
        last = (self.second + (not self.mirrored)) % len(corners)
        move = corners[last] - self.turn(corners[self.first : self.first + 1])[0]
        return Motion(self.turn.factor, complex(move), self.mirrored)


@dataclass(frozen=True)
class Motion:
    """Mirror the plane at the x axis where set, turn it by a factor, then move it."""

    factor: complex = 1.0
    move: complex = 0.0
    mirrored: bool = False

    def __call__(self, points: Complex) -> Complex:
        """Map points."""
        moved: Complex = self.factor * (points.conj() if self.mirrored else points) + self.move
        return moved

    def after(self, other: "Motion") -> "Motion":
        """The motion that does the other one first."""
        factor, move = self._flipped(other.factor), self._flipped(other.move)
        return Motion(self.factor * factor, self.factor * move + self.move, self.mirrored ^ other.mirrored)

    def back(self) -> "Motion":
        """The motion that undoes this one."""
        return Motion(self._flipped(1 / self.factor), self._flipped(-self.move / self.factor), self.mirrored)

    def is_turned_like(self, other: "Motion") -> bool:
        """Tell whether two motions differ by a translation."""
        return self.mirrored == other.mirrored and abs(self.factor - other.factor) < _SAME

    def is_near(self, other: "Motion") -> bool:
        """Tell whether two motions are one."""
        return self.is_turned_like(other) and abs(self.move - other.move) < _SAME

    def _flipped(self, number: complex) -> complex:
        return complex(number).conjugate() if self.mirrored else number


PAIRS = {
    "TTTTTT": (Pair(0, 3), Pair(1, 4), Pair(2, 5)),
    "C3C3C3C3C3C3": (Pair(0, 1, -120.0), Pair(2, 3, -120.0), Pair(4, 5, -120.0)),
    "CG1CG2G1G2": (
        Pair(0, 0, 180.0),
        Pair(1, 4, mirrored=True),
        Pair(2, 2, 180.0),
        Pair(3, 5, 180.0, mirrored=True),
    ),
}
"""Types of tiles, named as by Heesch: the pairs of edges, which are counted counterclockwise."""


def snapped_corners(symmetry: str, corners: Complex) -> Complex:
    """Find the corners nearest to those given that a tile of a type can have.

    Parameters
    ----------
    symmetry : str, a key of `PAIRS`
    corners : (c,) complex128, counterclockwise

    Returns
    -------
    (c,) complex128
    """
    n = len(corners)
    unknowns = np.eye(2 * n).reshape(2 * n, n, 2) @ (1, 1j)  # corners that are zero but for one number
    forms: list[Floats] = []
    for pair in PAIRS[symmetry]:
        edge = np.roll(unknowns, -1 - pair.first, 1)[:, 0] - unknowns[:, pair.first]
        other = np.roll(unknowns, -1 - pair.second, 1)[:, 0] - unknowns[:, pair.second]
        misfit = pair.turn(edge) - (other if pair.mirrored else -other)
        forms += [misfit.real, misfit.imag]
    flat = np.column_stack([corners.real, corners.imag]).ravel()
    nearest = flat - np.linalg.pinv(np.array(forms)) @ (np.array(forms) @ flat)
    return np.asarray(nearest.reshape(n, 2) @ (1, 1j), np.complex128)


def copies(symmetry: str, corners: Complex) -> tuple[list[Motion], Complex]:
    """Find the copies of a tile that translations repeat.

    Parameters
    ----------
    symmetry : str, a key of `PAIRS`
    corners : (c,) complex128, as `snapped_corners` gives them

    Returns
    -------
    motions : list of Motion, one for each turn of the tile; the first leaves it in place
    translations : (2,) complex128, the second on the left of the first
    """
    steps = [pair.motion(corners) for pair in PAIRS[symmetry]]
    steps += [step.back() for step in steps]
    found, latest = [Motion()], [Motion()]
    for _ in range(_STEPS):
        reached, latest = [motion.after(step) for motion in latest for step in steps], []
        for motion in reached:
            if not any(motion.is_near(other) for other in found):
                found.append(motion)
                latest.append(motion)
    middle = corners.mean(keepdims=True)
    found.sort(key=lambda motion: round(float(np.abs(motion(middle) - middle)[0]), 6))
    motions: list[Motion] = []
    for motion in found:
        if not any(motion.is_turned_like(other) for other in motions):
            motions.append(motion)
    moves = [motion.move for motion in found[1:] if motion.is_turned_like(found[0])]
    across = [(moves[0].conjugate() * move).imag for move in moves]
    k = int(np.argmax(np.abs(across) > _SAME))
    return motions, np.array([moves[0], moves[k] if across[k] > 0 else -moves[k]])
