"""Mesh to cells: equal-area pieces of any surface, flattened, with knobs on their borders."""

from meshjig.cells.cell_mesh import CellMesh, Seeds
from meshjig.cells.flatten.cell_atlas import cell_atlas
from meshjig.cells.grow import grow_cells
from meshjig.cells.knobs.knob_outlines import KnobLayout, WaysOut, knob_outlines

__all__ = ["CellMesh", "KnobLayout", "Seeds", "WaysOut", "cell_atlas", "grow_cells", "knob_outlines"]
