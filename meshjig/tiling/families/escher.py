"""Animals that interlock by their outlines, in the manner of M. C. Escher, drawn for meshjig."""

import numpy as np

from meshjig.errors import OptionError
from meshjig.mesh.types import Floats
from meshjig.tiling.assemble_unit import assemble
from meshjig.tiling.families.art.bird import BIRD
from meshjig.tiling.families.art.dog import DOG
from meshjig.tiling.families.art.figure import Figure, outline_edges, spline
from meshjig.tiling.families.art.fish import FISH
from meshjig.tiling.families.art.gecko import GECKO
from meshjig.tiling.families.art.heesch import Complex, Motion, copies
from meshjig.tiling.families.art.lizard import LIZARD
from meshjig.tiling.families.art.turtle import TURTLE
from meshjig.tiling.families.art.whale import WHALE
from meshjig.tiling.unit import Unit

__all__ = ["decor", "names", "unit"]

_FIGURES = {
    "lizard": LIZARD,
    "gecko": GECKO,
    "fish": FISH,
    "bird": BIRD,
    "turtle": TURTLE,
    "whale": WHALE,
    "dog": DOG,
}


def names() -> list[str]:
    """List the figures there are."""
    return list(_FIGURES)


def unit(name: str) -> Unit:
    """Repeat a figure, turned and mirrored as its symmetry has it.

    Parameters
    ----------
    name : str, one of `names`

    Returns
    -------
    Unit
        Its edges are curves.

    Raises
    ------
    OptionError
        There is no such figure.

    References
    ----------
    Heesch and Kienzle, "Flaechenschluss", 1963: the types of tiles.
    Kaplan and Salesin, "Escherization", 2000.
    """
    figure = _figure(name)
    corners, edges = outline_edges(figure)
    motions, translations = _turned_copies(figure, corners)
    return assemble([_carried(edges, motion) for motion in motions], _planar(translations))


def decor(name: str) -> list[list[Floats]]:
    """Give the lines drawn inside a figure: eyes, mouth, scales.

    Parameters
    ----------
    name : str, one of `names`

    Returns
    -------
    list of lists of (n, 2) float64
        For every tile of the unit its lines, where the tile lies in the unit; circles are closed lines.

    Raises
    ------
    OptionError
        There is no such figure.
    """
    figure = _figure(name)
    corners, _ = outline_edges(figure)
    motions, translations = _turned_copies(figure, corners)
    scale = np.sqrt((translations[0].conjugate() * translations[1]).imag / len(motions))
    around = np.exp(1j * np.linspace(0, 2 * np.pi, 25))
    lines = [spline(np.array(line) @ (1, 1j)) for line in figure.lines]
    lines += [complex(x, y) + radius * around for x, y, radius in figure.dots]
    return [[_planar(motion(line) / scale) for line in lines] for motion in motions]


def _figure(name: str) -> Figure:
    if name not in _FIGURES:
        raise OptionError(f"there is no figure {name!r}", hint="known are " + ", ".join(_FIGURES))
    return _FIGURES[name]


def _turned_copies(figure: Figure, corners: Complex) -> tuple[list[Motion], Complex]:
    motions, translations = copies(figure.symmetry, corners)
    turn = Motion(complex(np.exp(1j * np.radians(figure.turn))))
    return [turn.after(motion) for motion in motions], turn(translations)


def _carried(edges: list[Complex], motion: Motion) -> list[Floats]:
    """Place a tile's edges, counterclockwise there too."""
    placed = [_planar(motion(edge)) for edge in edges]
    return [edge[::-1] for edge in placed[::-1]] if motion.mirrored else placed


def _planar(points: Complex) -> Floats:
    return np.column_stack([points.real, points.imag])
