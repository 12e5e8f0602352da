"""Planar tilings of charts, one file a family."""

from meshjig.tiling.domain import chart_borders, chart_periods, chart_polygons
from meshjig.tiling.families.square import squares
from meshjig.tiling.fit import Fit
from meshjig.tiling.placing import Placing
from meshjig.tiling.shapes import Shapes
from meshjig.tiling.tiles import Tiling, tile_charts, tile_surface
from meshjig.tiling.unit import Unit

__all__ = [
    "Fit",
    "Placing",
    "Shapes",
    "Tiling",
    "Unit",
    "chart_borders",
    "chart_periods",
    "chart_polygons",
    "squares",
    "tile_charts",
    "tile_surface",
]
