"""Planar tilings of charts, one file a family."""

from meshjig.tiling.domain import chart_borders, chart_periods, chart_polygons
from meshjig.tiling.families.square import squares
from meshjig.tiling.fit import Fit
from meshjig.tiling.placing import Placing
from meshjig.tiling.shapes import Shapes
from meshjig.tiling.tiles import tile_charts
from meshjig.tiling.unit import Unit

__all__ = [
    "Fit",
    "Placing",
    "Shapes",
    "Unit",
    "chart_borders",
    "chart_periods",
    "chart_polygons",
    "squares",
    "tile_charts",
]
