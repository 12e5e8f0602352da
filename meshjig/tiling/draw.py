"""A tiling as a picture: tiles in soft colours, the unit that is repeated set off."""

from itertools import product

import numpy as np

from meshjig.mesh.arrays import Floats
from meshjig.tiling.unit import Unit, edge_curves, tile_outlines, tile_steps

__all__ = ["draw_svg"]

_TILE_MM = 25.0  # edge of the square that is as large as the mean tile
_MARGIN_MM = 5.0
_SOFT = ("#dbe7f3", "#fbe3d0", "#dff0dc", "#f3dfee", "#faf1cb", "#d8efee", "#e8e2f4", "#eee6dc")
_FULL = ("#8fb4da", "#f2b184", "#97cf90", "#d79bc8", "#ecd36f", "#83ccc8", "#ae9cd8", "#c6ad8c")

Place = tuple[int, int, int]  # tile, and how far its unit is moved


def draw_svg(unit: Unit, repeats: tuple[int, int] = (3, 3), decor: list[list[Floats]] | None = None) -> str:
    """Draw copies of a unit, knobs in place, one unit in full colours.

    Parameters
    ----------
    unit : Unit
    repeats : two ints of at least 1, how often the unit is repeated along either translation
    decor : list of lists of (n, 2) float64, optional
        Lines inside the unit's tiles, such as an eye, a list a tile.

    Returns
    -------
    str
        An SVG document in mm; the mean tile is as large as a square of 25 mm.
    """
    outlines = tile_outlines(unit, edge_curves(unit))
    places = list(product(range(unit.n_tiles), range(repeats[0]), range(repeats[1])))
    lines: list[list[Floats]] = [[] for _ in range(unit.n_tiles)] if decor is None else decor
    drawn = [_TILE_MM * (outlines[tile] + np.array(by) @ unit.translations) for tile, *by in places]
    colours = _colours(unit, places)
    emphasised = ((repeats[0] - 1) // 2, (repeats[1] - 1) // 2)
    around: list[str] = []
    inside: list[str] = []
    for (tile, *by), points in zip(places, drawn, strict=True):
        palette, group = (_FULL, inside) if tuple(by) == emphasised else (_SOFT, around)
        group.append(f'<path fill="{palette[colours[(tile, by[0], by[1])]]}" d="{_path(points)}Z"/>')
        for line in lines[tile]:
            inner = _TILE_MM * (line + np.array(by) @ unit.translations)
            group.append(f'<path fill="none" d="{_path(inner)}"/>')
    every = np.vstack(drawn) * (1, -1)
    low, high = every.min(0) - _MARGIN_MM, every.max(0) + _MARGIN_MM
    box = " ".join(f"{value:.3f}" for value in (*low, *(high - low)))
    page = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{high[0] - low[0]:.3f}mm" '
        f'height="{high[1] - low[1]:.3f}mm" viewBox="{box}">',
        '<g stroke="#7d858f" stroke-width="0.3" stroke-linejoin="round">',
        *around,
        '</g>\n<g stroke="#2b3440" stroke-width="0.6" stroke-linejoin="round">',
        *inside,
        "</g>\n</svg>\n",
    ]
    return "\n".join(page)


def _colours(unit: Unit, places: list[Place]) -> dict[Place, int]:
    """Choose for every tile the colour used least, of those that none of its neighbours has."""
    colours: dict[Place, int] = {}
    used = [0] * len(_SOFT)
    beside = _neighbours(unit)
    for place in sorted(places, key=lambda place: (place[1], place[2], place[0])):
        tile, i, j = place
        taken = {colours.get((other, i + di, j + dj)) for other, di, dj in beside[tile]}
        free = [k for k in range(len(_SOFT)) if k not in taken] or list(range(len(_SOFT)))
        colours[place] = min(free, key=lambda k: (used[k], k))
        used[colours[place]] += 1
    return colours


def _neighbours(unit: Unit) -> list[set[Place]]:
    neighbours: list[set[Place]] = []
    for steps in tile_steps(unit):
        across = [(unit.sides[step.edge, int(step.forward)], step.shift) for step in steps]
        neighbours.append({(int(s[0]), int(s[1] + by[0]), int(s[2] + by[1])) for s, by in across})
    return neighbours


def _path(points: Floats) -> str:
    return "M" + "L".join(f"{x:.3f},{-y:.3f}" for x, y in points)
