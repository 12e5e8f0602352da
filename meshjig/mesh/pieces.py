"""Finished pieces: solids with names, and who borders on whom."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from meshjig.errors import InputError
from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.booleans import Body, body
from meshjig.mesh.mesh import Mesh
from meshjig.mesh.validated import validated

__all__ = ["Pieces", "piece_names"]


def piece_names(n: int) -> list[str]:
    """Give the names of n pieces in order: piece_001 and so on."""
    return [f"piece_{i + 1:03d}" for i in range(n)]


@dataclass(frozen=True, eq=False)
class Pieces:
    """Solids, each with its name; to go through them is to go through the solids."""

    names: tuple[str, ...]
    solids: tuple[Mesh, ...]  # closed and oriented outward
    neighbours: Ints | None = None  # (k, 2), pieces that face each other; None where that is not known

    @classmethod
    def of(cls, pieces: Iterable[Any], neighbours: Any = None) -> Pieces:
        """Take pieces from outside, whatever made them.

        Parameters
        ----------
        pieces : Pieces, or (name, V, F) or (V, F) for each
            V (n, 3), mm; F (m, 3). Without a name a piece is called piece_001 and so on.
        neighbours : (k, 2) integers, optional

        Raises
        ------
        InputError
            Arrays that are no mesh with finite coordinates; or neighbours that don't exist.
        """
        if isinstance(pieces, Pieces):
            neighbours = pieces.neighbours if neighbours is None else neighbours
            pieces = [(name, V, F) for name, (V, F) in zip(pieces.names, pieces, strict=True)]
        given = [tuple(piece) for piece in pieces]
        names = [
            str(piece[0]) if len(piece) > 2 else name
            for piece, name in zip(given, piece_names(len(given)), strict=True)
        ]
        solids = [Mesh(*validated(V, F, name)) for (*_, V, F), name in zip(given, names, strict=True)]
        if neighbours is not None:
            neighbours = np.asarray(neighbours, np.int64).reshape(-1, 2)
            if len(neighbours) and (neighbours.min() < 0 or neighbours.max() >= len(given)):
                raise InputError(f"neighbours: a pair names a piece beyond the {len(given)} that there are")
        return cls(tuple(names), tuple(solids), neighbours)

    def __len__(self) -> int:
        return len(self.solids)

    def __iter__(self) -> Iterator[Mesh]:
        return iter(self.solids)

    def __getitem__(self, i: int) -> Mesh:
        return self.solids[i]

    def with_solids(self, solids: Iterable[Any]) -> Pieces:
        """Give the same pieces with other solids, (V, F) each."""
        return replace(self, solids=tuple(Mesh(*solid) for solid in solids))

    @cached_property
    def boxes(self) -> tuple[Floats, Floats]:
        """The lowest and highest corner of every piece's box, two (n, 3), mm."""
        return (
            np.array([V[F].min((0, 1)) for V, F in self]).reshape(-1, 3),
            np.array([V[F].max((0, 1)) for V, F in self]).reshape(-1, 3),
        )

    @cached_property
    def bodies(self) -> list[Body | None]:
        """Every piece as a manifold3d body in double precision, None where it is no manifold."""
        import manifold3d

        made = [body(V, F) for V, F in self]
        return [one if one.status() == manifold3d.Error.NoError else None for one in made]

    def close(self, reach: float) -> Ints:
        """List pairs of pieces whose boxes are no farther than a reach (mm) from each other along any axis.

        Returns
        -------
        (k, 2) int64, lower first, in lexicographic order
        """
        (low, high), pairs = self.boxes, [np.zeros((0, 2), np.int64)]
        for i in range(len(low) - 1):
            near = ((low[i + 1 :] - high[i] <= reach) & (low[i] - high[i + 1 :] <= reach)).all(1)
            others = np.flatnonzero(near) + i + 1
            pairs.append(np.stack([np.full(len(others), i), others], 1))
        return np.concatenate(pairs)

    def __getstate__(self) -> dict[str, object]:
        return {"names": self.names, "solids": self.solids, "neighbours": self.neighbours}
