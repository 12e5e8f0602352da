"""Planar tilings of charts, one file a family."""

from meshjig.tiling.domain import chart_borders, chart_periods, chart_polygons
from meshjig.tiling.families.regular import squares
from meshjig.tiling.fit import Fit
from meshjig.tiling.net import Placing
from meshjig.tiling.shapes import TileShapes
from meshjig.tiling.template import Template
from meshjig.tiling.tiles import TileStyle, Tiling, tile_charts, tile_surface
from meshjig.tiling.unit import Unit

__all__ = [
    "Fit",
    "Placing",
    "Template",
    "TileShapes",
    "TileStyle",
    "Tiling",
    "Unit",
    "chart_borders",
    "chart_periods",
    "chart_polygons",
    "squares",
    "tile_charts",
    "tile_surface",
]
