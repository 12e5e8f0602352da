"""Isohedral tilings: one tile, turned and mirrored, by the type of its symmetry."""

import re
from collections.abc import Iterator
from itertools import product
from typing import Any

import numpy as np

from meshjig.errors import OptionError
from meshjig.mesh.arrays import Floats
from meshjig.mesh.measure import signed_area
from meshjig.tiling.assemble_unit import assemble
from meshjig.tiling.families.edge_shapes import EDGE_SHAPES, neck_width, with_symmetry
from meshjig.tiling.svg.read_paths import bounded
from meshjig.tiling.svg.tile_paths import read_edges
from meshjig.tiling.unit import Unit

__all__ = ["STRAIGHT", "isohedral"]

STRAIGHT = (20, 32, 37, 40, 72, 76, 77, 82, 93)  # types whose edges can be nothing but straight

_SIZES = 1.15 * 0.85 ** np.arange(8)  # of a knob, that of the classic square is 1
_LARGEST = 1.5  # that a knob grows to on a short edge, where 1 is as on the edge of a square
_WALLS = np.arange(0.05, 0.16, 0.015)  # of a tile's edge: what may be left between two knobs


def isohedral(name: str, seed: int = 0) -> Unit:
    """Shape the edges of an isohedral tiling so that its tiles interlock.

    Knobs are as large, and point to the sides, that leave the widest necks and walls: at least 5 % of
    the tile's edge. Edges of one's own are drawn in a file: the first path is for the tile's first edge and
    those that are copies of it, the second one for the second, and so on, in turn.

    Parameters
    ----------
    name : str, IH1 to IH93, or such and the path of an SVG file, with a colon between the two
    seed : int, decides to which sides the knobs point where several choices are as good

    Returns
    -------
    Unit

    Raises
    ------
    OptionError
        There is no such type, it has straight edges only, or the package tactile is missing; or the file
        can't be read, or its curves don't fit.

    References
    ----------
    Gruenbaum and Shephard, "Tilings and Patterns", 1987, chapter 6.
    Kaplan, "Introductory Tiling Theory for Computer Graphics", 2009.
    """
    kind, _, path = name.partition(":")
    number = _number(kind)
    own = bounded(read_edges, path) if path else None
    tiling = _tiling(number)
    translations = np.array([tiling.t1, tiling.t2])
    if np.linalg.det(translations) < 0:
        translations = translations[::-1]
    scale = float(np.sqrt(np.linalg.det(translations) / tiling.num_aspects))
    best, widest = None, 0.0
    for edges, neck in _shaped(tiling, scale, np.random.default_rng(seed), own):
        wall = min(neck, _thinnest(edges, scale, widest)) if neck > widest else 0.0
        if wall > widest:
            best, widest = edges, wall
    if best is None and path:
        raise OptionError(
            f"{path}: on the edges of IH{number:02d} its curves cross each other, or leave a tile "
            f"thinner than {_WALLS[0]:.0%} of its edge, whichever side they are on",
            hint="draw flatter ones",
        )
    if best is None:
        raise OptionError(f"IH{number:02d} leaves no room for knobs")
    return assemble([_placed(best, aspect) for aspect in tiling.aspects], translations)


def _number(name: str) -> int:
    match = re.fullmatch(r"IH0*(\d+)", name.strip(), re.IGNORECASE)
    if not match:
        raise OptionError(f"{name!r} is no isohedral type", hint="give IH and a number, such as IH04")
    number = int(match[1])
    if number in STRAIGHT:
        raise OptionError(
            f"IH{number:02d} can't interlock: its symmetry keeps all edges straight",
            hint="choose a type other than " + ", ".join(f"IH{k}" for k in STRAIGHT),
        )
    return number


def _tiling(number: int) -> Any:
    try:
        from tactile import IsohedralTiling, tiling_types
    except ImportError:
        raise OptionError(
            "isohedral tilings need the package tactile", hint="pip install meshjig[isohedral]"
        ) from None
    if number not in tiling_types:
        least, most = (f"IH{found(set(tiling_types) - set(STRAIGHT)):02d}" for found in (min, max))
        hint = f"there are most from {least} to {most}, such as IH04"
        raise OptionError(f"IH{number:02d} is no type whose tiles interlock", hint=hint)
    return IsohedralTiling(number)


def _shaped(
    tiling: Any, scale: float, rng: np.random.Generator, own: list[Floats] | None
) -> Iterator[tuple[list[Floats], float]]:
    """Draw the tile's edges, in turn around it, with knobs to whichever sides; ever smaller knobs.

    With them comes the width of the narrowest neck, in tile's edges.
    """
    shapes = list(tiling.shapes)
    choices = np.array(list(product((1.0, -1.0), repeat=1 + max(shape.id for shape in shapes))))
    matrices = [np.reshape(shape.T, (2, 3)) for shape in shapes]
    length = [float(np.linalg.norm(matrix[:, 0])) / scale for matrix in matrices]
    for size in _SIZES.tolist() if own is None else (1.0,):
        factors = [min(size / edge, _LARGEST) for edge in length]
        curves = [
            EDGE_SHAPES[shape.shape.name](by)
            if own is None
            else with_symmetry(own[shape.id % len(own)], shape.shape.name)
            for shape, by in zip(shapes, factors, strict=True)
        ]
        neck = (
            1.0
            if own is not None
            else min(
                neck_width(shape.shape.name, by) * edge
                for shape, by, edge in zip(shapes, factors, length, strict=True)
            )
        )
        for side in rng.permutation(choices):
            yield (
                [
                    _moved(curve[:: -1 if shape.rev else 1] * (1.0, side[shape.id]), matrix)
                    for curve, shape, matrix in zip(curves, shapes, matrices, strict=True)
                ],
                neck,
            )


def _thinnest(edges: list[Floats], scale: float, least: float) -> float:
    """The width up to which walls can be taken off a tile that stays in one piece; 0, if no more."""
    import shapely

    tile = shapely.Polygon(np.vstack([curve[:-1] for curve in edges]))
    if not tile.is_valid:
        return 0.0
    widest = 0.0
    for width in _WALLS[least < _WALLS]:
        if tile.buffer(-width * scale / 2).geom_type != "Polygon":
            break
        widest = width
    return float(widest)


def _placed(edges: list[Floats], aspect: list[float]) -> list[Floats]:
    """Carry the tile to one of its places, counterclockwise there too."""
    matrix = np.reshape(aspect, (2, 3))
    edges = [_moved(curve, matrix) for curve in edges]
    if signed_area(np.vstack([curve[:-1] for curve in edges])) < 0:
        edges = [curve[::-1] for curve in edges[::-1]]
    return edges


def _moved(points: Floats, matrix: Floats) -> Floats:
    moved: Floats = points @ matrix[:, :2].T + matrix[:, 2]
    return moved
