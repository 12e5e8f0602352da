"""What the cells of a surface are, as data."""

from dataclasses import dataclass, field
from typing import Any

from meshjig.mesh.types import Floats, Ints, Mesh

__all__ = ["CellMesh", "Seeds"]


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
class CellMesh:
    """A surface whose edges follow the borders of its cells; every cell is one disc.

    It is the input mesh refined: the same surface, and the vertices of the input come first.
    """

    mesh: Mesh
    parent: Ints  # (m,), the face of the input mesh that a face lies in
    vertex_face: Ints  # (n,), a face of the input mesh that a vertex lies in
    vertex_bary: Floats  # (n, 3), where in that face
    cell: Ints  # (m,), 0..N-1
    seeds: Seeds | None = None
    facts: dict[str, Any] = field(default_factory=dict)  # the report's "cells"

    @property
    def n_cells(self) -> int:
        """Count the cells."""
        return int(self.cell.max(initial=-1)) + 1
