"""A finished puzzle: its pieces, its report, and how it is saved and loaded."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from meshjig.errors import InputError
from meshjig.output import save_puzzle
from meshjig.output.read import read_pieces
from meshjig.types import Floats, Ints

__all__ = ["Curves", "Piece", "Puzzle"]


@dataclass(frozen=True)
class Piece:
    """One piece of a puzzle, in its place on the model."""

    id: int
    V: Floats  # (n, 3), mm
    F: Ints  # (m, 3)
    colour: tuple[float, float, float] = (0.7, 0.7, 0.7)

    @property
    def name(self) -> str:
        """The name that the piece has in files."""
        return f"piece_{self.id:03d}"

    @property
    def mesh(self) -> Any:
        """The piece as a trimesh.Trimesh."""
        import trimesh

        return trimesh.Trimesh(self.V, self.F, process=False)


@dataclass(frozen=True)
class Curves:
    """The cuts as polylines."""

    plane: list[Floats] = field(default_factory=list)  # each (k, 2), mm, in the charts' plane
    space: list[Floats] = field(default_factory=list)  # each (k, 3), mm


@dataclass(frozen=True)
class Puzzle:
    """Pieces that cover a model, and what was measured of them."""

    pieces: list[Piece]
    report: dict[str, Any]
    curves: Curves = field(default_factory=Curves)

    def save(self, directory: str | Path, formats: tuple[str, ...] | None = None, *, preview: bool = True) -> Path:
        """Write the puzzle to a folder.

        An existing folder is replaced only when meshjig made it, and only once all files are written.

        Parameters
        ----------
        directory : path
        formats : tuple of "stl", "3mf", "obj", "glb"; as the options have it when not given
        preview : bool, also draw preview.png

        Returns
        -------
        pathlib.Path, the folder

        Raises
        ------
        OutputError
            The folder can't be written, or holds something else.
        """
        return save_puzzle(
            directory,
            [(p.name, p.V, p.F, p.colour) for p in self.pieces],
            self.report,
            formats=formats if formats is not None else tuple(self.report["options"]["format"]),
            curves=(self.curves.plane, self.curves.space) if self.curves.space else None,
            preview=preview,
        )

    @classmethod
    def load(cls, directory: str | Path) -> Puzzle:
        """Read a puzzle back from its folder.

        Raises
        ------
        InputError
            The folder holds no puzzle made by meshjig.
        """
        path = Path(directory) / "report.json"
        if not path.is_file():
            raise InputError(f"{directory} holds no report.json", hint="give a folder that meshjig made")
        try:
            report = json.loads(path.read_text(encoding="utf-8"))
        except ValueError:
            raise InputError(f"{path} is no valid JSON", hint="make the puzzle again") from None
        pieces = [
            Piece(int(name.rsplit("_", 1)[-1]) if name.rsplit("_", 1)[-1].isdigit() else i + 1, V, F)
            for i, (name, V, F) in enumerate(read_pieces(directory))
        ]
        return cls(pieces, report)
