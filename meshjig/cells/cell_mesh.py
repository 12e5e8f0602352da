"""What the cells of a surface are, as data."""

from dataclasses import dataclass

from meshjig.mesh.refinement import Refinement
from meshjig.mesh.types import Floats, Ints

__all__ = ["CellFacts", "CellMesh", "Seeds", "ThinLimb"]


@dataclass(frozen=True)
class Seeds:
    """Where the cells of a surface grew from; another pass can start from it.

    Some cells grew in pairs, since a power cell was no disc: the union of the two, or the one cell alone
    where the second has no seed, was cut in two between two poles.
    """

    points: Floats  # (N, 3), mm
    weights: Floats  # (N,), mm2, of the power cells
    pairs: Ints  # (p, 2), cells
    poles: Floats  # (p, 2, 3), mm

    @property
    def n_cells(self) -> int:
        """Count the cells; some have no seed of their own, being halves of another."""
        return max(len(self.points), int(self.pairs.max(initial=-1)) + 1)


@dataclass(frozen=True)
class ThinLimb:
    """A place where cells went around a limb."""

    at: list[float]  # mm
    pieces: int  # for which cells would be as large as the limb is around


@dataclass(frozen=True)
class CellFacts:
    """What cells say of themselves, for the report."""

    cells: int
    halved: int  # that have no seed of their own
    thin_limbs: list[ThinLimb]


@dataclass(frozen=True)
class CellMesh(Refinement):
    """A surface whose edges follow the borders of its cells; every cell is one disc."""

    cell: Ints  # (m,), 0..N-1
    seeds: Seeds | None = None
    facts: CellFacts | None = None

    @property
    def n_cells(self) -> int:
        """Count the cells."""
        return int(self.cell.max(initial=-1)) + 1
