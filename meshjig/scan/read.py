"""The scan stage in one call: from a file to the mesh that the puzzle is made of."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace
from typing import Any, Literal

import numpy as np

from meshjig.mesh.arrays import Floats
from meshjig.mesh.boundary_loops import border_loops
from meshjig.mesh.intersections import self_crossings
from meshjig.mesh.mesh import Mesh
from meshjig.scan.coarse import refuse_coarse
from meshjig.scan.fill import FilledHoles
from meshjig.scan.floor import FloorFacts
from meshjig.scan.forecast import foretell
from meshjig.scan.load import load
from meshjig.scan.notes import repair_notes
from meshjig.scan.preparation import Preparation
from meshjig.scan.repair import Repairs, repair
from meshjig.scan.resurface import ResurfaceFacts, resurfacing_cell
from meshjig.scan.resurface import resurface as rebuild
from meshjig.scan.scale import decimate, refuse_size
from meshjig.scan.sized import to_size
from meshjig.scan.source import Source

__all__ = ["Scan", "ScanFacts", "describe", "read_scan", "with_crossings"]


@dataclass(frozen=True)
class ScanFacts:
    """What a mesh is, and what was done to it: the report's ``input``."""

    file: str | None
    sha256: str | None  # of the file's bytes
    reader: str
    notes: list[str]  # what of the file was left out, a sentence each
    faces: int  # as loaded
    components: int
    borders: int  # open loops
    genus: int  # summed over components
    self_crossings: int | None  # None: not counted, or the test failed
    repairs: Repairs
    scale: float
    size_mm: list[float]
    units: str
    moved_mm: list[float] | None
    working_faces: int
    decimated_from: int | None  # faces before
    resurfaced: ResurfaceFacts | None  # None when it was not asked for
    picture: str  # what the mesh shows: texture, colours
    floor: FloorFacts | None  # None when none was cut off
    filled_holes: FilledHoles | None = None

    def as_dict(self) -> Mapping[str, Any]:
        """Give the facts as the report has them, without those of holes before any were looked for."""
        facts = asdict(self)
        if self.filled_holes is None:
            del facts["filled_holes"]
        return facts


@dataclass(frozen=True)
class Scan:
    """What came out of a file: the mesh to work on, what was loaded, and what was done to it."""

    mesh: Mesh
    source: Source  # as loaded; UVs, textures and colours are sampled from it
    to_source: Floats  # (4, 4), takes mesh coordinates back to those of source
    facts: ScanFacts


def read_scan(
    source: Any,
    *,
    size: float | None = None,
    faces: int | Literal["all"] = 100_000,
    cavities: bool = False,
    resurface: bool = False,
    preparation: Preparation | None = None,
) -> Scan:
    """Load, repair, scale and simplify a mesh.

    Parameters
    ----------
    source : path, trimesh.Trimesh, trimesh.Scene, or (V (n, 3), F (m, 3))
    size : float, mm, the largest extent; None: see `to_millimetres`
    faces : int or "all", the working resolution
    cavities : bool, whether shells that lie inside a solid stay
    resurface : bool, whether the outer surface is rebuilt, without crossings; see `resurface`
    preparation : Preparation, the unit, parts to keep, a floor to cut off

    Returns
    -------
    Scan

    Raises
    ------
    InputError
        The mesh can't be read, or is no surface; the sentence says why.
    OptionError
        The size is no length.
    ResourceError
        It would take more memory than allowed.
    """
    refuse_size(size)
    preparation = preparation or Preparation()
    foretell(source, preparation.memory)
    loaded = load(source)
    refuse_coarse(loaded.V, loaded.F, loaded.file or "the mesh")
    V, F, repairs = repair(loaded.V, loaded.F, cavities=cavities)
    scaled, F, floor, notes = to_size(V, F, loaded.source, size, preparation)
    V, resurfaced = scaled.V, None
    if resurface:
        V, F, resurfaced = rebuild(V, F, resurfacing_cell(V, F, faces), cavities=cavities)
    n_clean = len(F)
    if faces != "all":
        V, F = decimate(V, F, faces)
    mesh = Mesh(np.ascontiguousarray(V), np.ascontiguousarray(F))
    n_borders = len(border_loops(F))
    euler = len(V) - len(mesh.edges.E) + len(F)
    facts = ScanFacts(
        file=loaded.file,
        sha256=loaded.sha256,
        reader=loaded.reader,
        notes=[*loaded.notes, *repair_notes(repairs), *notes],
        faces=len(loaded.F),
        components=mesh.n_components,
        borders=n_borders,
        genus=(2 * mesh.n_components - euler - n_borders) // 2,
        self_crossings=None,
        repairs=repairs,
        scale=scaled.facts.scale,
        size_mm=scaled.facts.size_mm,
        units=scaled.facts.units,
        moved_mm=scaled.facts.moved_mm,
        working_faces=len(F),
        decimated_from=n_clean if len(F) < n_clean else None,
        resurfaced=resurfaced,
        picture=loaded.source.look.describe(),
        floor=floor,
    )
    return Scan(mesh, loaded.source, scaled.to_source, facts)


def describe(
    source: Any,
    *,
    size: float | None = None,
    faces: int | Literal["all"] = 100_000,
    cavities: bool = False,
    preparation: Preparation | None = None,
) -> ScanFacts:
    """Say what a mesh is and what would be done to it, without making a puzzle.

    Parameters
    ----------
    source, size, faces, cavities, preparation
        As for `read_scan`.

    Returns
    -------
    ScanFacts
        Those of `read_scan`, with ``self_crossings`` counted on the working mesh (None when the test failed).

    Raises
    ------
    InputError
        As `read_scan`.
    """
    return with_crossings(
        read_scan(source, size=size, faces=faces, cavities=cavities, preparation=preparation)
    )


def with_crossings(scan: Scan) -> ScanFacts:
    """Give the facts of a scan, with ``self_crossings`` counted on its mesh."""
    pairs = self_crossings(scan.mesh.V, scan.mesh.F)
    return replace(scan.facts, self_crossings=None if pairs is None else len(pairs))
