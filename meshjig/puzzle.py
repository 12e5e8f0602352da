"""A finished puzzle: its pieces, its report, and how it is saved and loaded."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from meshjig.errors import InputError
from meshjig.output import piece as named
from meshjig.output.files.curve_files import Curves
from meshjig.output.files.read_pieces import read_puzzle_files
from meshjig.output.save import Outputs, save_puzzle
from meshjig.runtime.cores import use_cores

__all__ = ["Curves", "Piece", "Puzzle"]

GREY = (0.7, 0.7, 0.7)  # files of single pieces have no colour


@dataclass(frozen=True, eq=False, repr=False)
class Piece(named.Piece):
    """One piece of a puzzle, in its place on the model."""

    id: int = 0  # counted from 1

    @property
    def mesh(self) -> Any:
        """The piece as a trimesh.Trimesh."""
        import trimesh

        return trimesh.Trimesh(self.V, self.F, process=False)

    def __repr__(self) -> str:
        return f"<Piece {self.id}: {self.name}, {len(self.V)} vertices, {len(self.F)} faces>"


@dataclass(frozen=True, eq=False, repr=False)
class Puzzle:
    """Pieces that cover a model, and what was measured of them.

    Two puzzles are equal when their pieces and cores are, to the last bit; reports hold seconds, too.
    """

    pieces: list[Piece]
    report: dict[str, Any]
    curves: Curves = field(default_factory=Curves)
    core: list[named.Piece] = field(default_factory=list)  # parts of what it is built up on, where asked for

    def __repr__(self) -> str:
        model, promises = self.report.get("input", {}), "kept" if self.report.get("ok") else "broken"
        size = " x ".join(f"{extent:.0f}" for extent in model.get("size_mm", []))
        of = f"{Path(model.get('file') or 'a mesh').name}, {size} mm" if size else "a mesh"
        return f"<Puzzle of {of}: {len(self.pieces)} pieces, promises {promises}>"

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Puzzle):
            return NotImplemented
        return self.pieces == other.pieces and self.core == other.core

    def save(
        self,
        directory: str | Path,
        formats: tuple[str, ...] | None = None,
        *,
        preview: bool = True,
        viewer: bool = True,
        guide: bool = True,
    ) -> Path:
        """Write the puzzle to a folder.

        An existing folder is replaced only when meshjig made it, and only once all files are written.

        Parameters
        ----------
        directory : path
        formats : tuple of "stl", "ply", "3mf", "obj", "glb"; as the options have it when not given
        preview : bool, also draw preview.png
        viewer : bool, also write viewer.html
        guide : bool, also write guide.pdf

        Returns
        -------
        pathlib.Path, the folder

        Raises
        ------
        OutputError
            The folder can't be written, or holds something else.
        """
        asked = self.report["options"]
        outputs = Outputs(
            formats if formats is not None else asked["format"],
            preview,
            viewer and asked.get("viewer", True),
            guide and asked.get("guide", True),
            **{key: asked[key] for key in ("plate", "nest", "explode", "turntable") if key in asked},
        )
        with use_cores(asked.get("cores")):
            written = save_puzzle(
                directory, self.pieces, self.report, outputs, curves=self.curves, core=self.core
            )
        self.report.update(written)
        return Path(directory)

    def plot(self, size: int = 800) -> Any:
        """Draw the puzzle put together.

        Parameters
        ----------
        size : int, pixels along each side

        Returns
        -------
        PIL.Image.Image
            A notebook shows it; elsewhere, its ``show`` and ``save`` do.

        Raises
        ------
        OutputError
            There are no pieces.
        """
        from PIL import Image

        from meshjig.output.pictures.preview import draw_whole

        said = self.report.get("up")
        return Image.fromarray(draw_whole(self.pieces, size, None if said is None else np.array(said)))

    def _repr_html_(self) -> str:
        """Show the viewer in a notebook."""
        from meshjig.output.viewer.page import viewer_html

        return viewer_html(self.pieces, self.report, self.core)

    @classmethod
    def load(cls, directory: str | Path) -> Puzzle:
        """Read the pieces, the core and the report of a puzzle back from its folder.

        Colours and curves stay in the files.

        Raises
        ------
        InputError
            The folder holds no puzzle made by meshjig.
        """
        path = Path(directory) / "report.json"
        if not path.is_file():
            raise InputError(f"{directory} holds no report.json", hint="give a folder that meshjig made")
        files = read_puzzle_files([directory])
        report = files.report or {}
        if "meshjig" not in report:
            raise InputError(f"{path} is no report of meshjig", hint="give a folder that meshjig made")
        listed = [piece["id"] for piece in report["pieces"]]
        pieces = [
            Piece(name, V, F, GREY, listed[i] if i < len(listed) else i + 1)
            for i, (name, V, F) in enumerate(files.pieces)
        ]
        core = [named.Piece(*part, GREY) for part in files.core]
        return cls(pieces, report, core=core)
