"""A square grid of tiles over one chart."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from meshjig.types import Floats, Ints

__all__ = ["Grid", "place_grid"]


@dataclass(frozen=True)
class Grid:
    """Square tiles that cover a chart; tile (i, j) has the corners (i, j) and (i + 1, j + 1)."""

    origin: Floats  # (2,), mm
    size: float  # edge of a tile, mm
    shape: tuple[int, int]  # tiles along u and v

    def nodes(self) -> Floats:
        """Give the corners, (nx + 1, ny + 1, 2)."""
        nx, ny = self.shape
        i, j = np.meshgrid(np.arange(nx + 1), np.arange(ny + 1), indexing="ij")
        return self.origin + self.size * np.stack([i, j], -1)

    def inner_edges(self) -> tuple[Ints, Ints, Ints]:
        """List the edges between two tiles.

        Returns
        -------
        ends : (e, 2) int64, corners numbered i (ny + 1) + j
        left, right : (e,) int64, tiles numbered i ny + j
        """
        nx, ny = self.shape
        i, j = (x.ravel() for x in np.meshgrid(np.arange(nx), np.arange(1, ny), indexing="ij"))
        along_u = np.stack([i * (ny + 1) + j, (i + 1) * (ny + 1) + j], 1), i * ny + j, i * ny + j - 1
        i, j = (x.ravel() for x in np.meshgrid(np.arange(1, nx), np.arange(ny), indexing="ij"))
        along_v = np.stack([i * (ny + 1) + j, i * (ny + 1) + j + 1], 1), (i - 1) * ny + j, i * ny + j
        ends, left, right = (np.concatenate(pair) for pair in zip(along_u, along_v, strict=True))
        return ends, left, right


def place_grid(polygon: Any, size: float, shift: tuple[float, float]) -> Grid:
    """Lay a grid over a chart, with one tile to spare on every side.

    Parameters
    ----------
    polygon : shapely.Polygon, the chart
    size : float, edge of a tile, mm
    shift : two floats in 0..1: what share of a tile the middle of the chart lies off a corner
    """
    low, high = np.array(polygon.bounds[:2]), np.array(polygon.bounds[2:])
    middle = (low + high) / 2 - size * np.asarray(shift)
    before = np.ceil((middle - low) / size).astype(int) + 1
    after = np.ceil((high - middle) / size).astype(int) + 1
    nx, ny = (before + after).tolist()
    return Grid(middle - before * size, size, (nx, ny))
