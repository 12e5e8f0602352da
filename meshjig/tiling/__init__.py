"""Planar tilings of charts, one file a family."""

from meshjig.tiling.domain import chart_polygons
from meshjig.tiling.grid import Grid, place_grid
from meshjig.tiling.tiles import FAMILIES, tile_charts

__all__ = ["FAMILIES", "Grid", "chart_polygons", "place_grid", "tile_charts"]
