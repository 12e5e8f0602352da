"""Any triangle mesh, 3D scans first of all, as a printable 3D jigsaw puzzle of its surface.

>>> import meshjig
>>> puzzle = meshjig.make_puzzle("bunny.obj", pieces=100)  # doctest: +SKIP
>>> puzzle.save("bunny-jigsaw")  # doctest: +SKIP
"""

from __future__ import annotations

import importlib

from meshjig.errors import (
    ChartError,
    CutError,
    InputError,
    MeshjigError,
    OptionError,
    OutputError,
    ResourceError,
    SolidError,
)

# __init__.pyi tells type checkers the same; a test holds the two together
_HOMES = {
    "Atlas": "meshjig.mesh.types",
    "BatchSettings": "meshjig.fleet.settings",
    "CutMesh": "meshjig.mesh.types",
    "MappedAtlas": "meshjig.charts",
    "Mesh": "meshjig.mesh.types",
    "Options": "meshjig.options",
    "Outlines": "meshjig.mesh.types",
    "Piece": "meshjig.puzzle",
    "Puzzle": "meshjig.puzzle",
    "atlas": "meshjig.pipeline.prepare",
    "batch": "meshjig.fleet.batch",
    "build_atlas": "meshjig.charts",
    "cell_atlas": "meshjig.cells",
    "displacement": "meshjig.solid",
    "get_family": "meshjig.tiling.registry",
    "grow_cells": "meshjig.cells",
    "kerf": "meshjig.solid",
    "knob_outlines": "meshjig.cells",
    "make_puzzle": "meshjig.pipeline.make",
    "overlay": "meshjig.cut",
    "read_scan": "meshjig.scan",
    "repair": "meshjig.scan",
    "shell": "meshjig.solid",
    "solidify": "meshjig.solid",
    "stitch": "meshjig.layout.stitch",
    "tile_charts": "meshjig.tiling",
}

__all__ = [
    "__version__",
    "check",
    "ChartError",
    "CutError",
    "InputError",
    "MeshjigError",
    "OptionError",
    "OutputError",
    "ResourceError",
    "SolidError",
    *_HOMES,
]


def __getattr__(name: str) -> object:
    """Load a public name where it lives, when it is first used: imports cost a command its start."""
    if name in _HOMES:
        value = globals()[name] = getattr(importlib.import_module(_HOMES[name]), name)
        return value
    if name == "check":
        return importlib.import_module("meshjig.check")
    if name == "__version__":
        from meshjig.runtime.version import meshjig_version

        return meshjig_version()
    raise AttributeError(f"module 'meshjig' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted(__all__)
