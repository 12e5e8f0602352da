"""Animals that interlock by their outlines, in the manner of M. C. Escher, drawn for meshjig.

They are kept as control points in figures/, a file each.
"""

import json
from dataclasses import dataclass
from importlib.resources import files

import numpy as np

from meshjig.errors import OptionError
from meshjig.mesh.arrays import Floats
from meshjig.tiling.assemble_unit import assemble
from meshjig.tiling.families.heesch import PAIRS, Complex, Motion, copies, snapped_corners
from meshjig.tiling.unit import Unit

__all__ = ["decor", "names", "unit"]

_NAMES = ("lizard", "gecko", "fish", "bird", "turtle", "whale", "dog")
_SPACING = 0.02  # of a tile's edge, between points of a curve

Points = list[list[float]]  # x and y of each


@dataclass(frozen=True)
class _Figure:
    """A tile as it is drawn; its area need not be 1. Edges that follow by symmetry aren't given."""

    about: str
    symmetry: str  # a key of PAIRS
    turn: float  # degrees by which the whole tiling is turned in the end
    corners: Points  # counterclockwise; edge k starts at corner k
    edges: list[Points]  # of each pair's first edge, the control points between its corners
    lines: list[Points]  # control points of strokes inside
    dots: Points  # x, y and radius of circles inside


def names() -> list[str]:
    """List the figures there are."""
    return list(_NAMES)


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
    corners, edges = _outline_edges(figure)
    motions, translations = _turned_copies(figure, corners)
    return assemble([_carried(edges, motion) for motion in motions], _planar(translations))


def decor(name: str) -> list[list[Floats]]:
    """Draw the lines inside a figure: eyes, mouth, scales.

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
    corners, _ = _outline_edges(figure)
    motions, translations = _turned_copies(figure, corners)
    scale = np.sqrt((translations[0].conjugate() * translations[1]).imag / len(motions))
    around = np.exp(1j * np.linspace(0, 2 * np.pi, 25))
    lines = [_spline(np.array(line) @ (1, 1j)) for line in figure.lines]
    lines += [complex(x, y) + radius * around for x, y, radius in figure.dots]
    return [[_planar(motion(line) / scale) for line in lines] for motion in motions]


def _figure(name: str) -> _Figure:
    if name not in _NAMES:
        raise OptionError(f"there is no figure {name!r}", hint="known are " + ", ".join(_NAMES))
    text = (files("meshjig.tiling.families") / "figures" / f"{name}.json").read_text(encoding="utf-8")
    return _Figure(**json.loads(text))


def _turned_copies(figure: _Figure, corners: Complex) -> tuple[list[Motion], Complex]:
    motions, translations = copies(figure.symmetry, corners)
    turn = Motion(complex(np.exp(1j * np.radians(figure.turn))))
    return [turn.after(motion) for motion in motions], turn(translations)


def _carried(edges: list[Complex], motion: Motion) -> list[Floats]:
    """Place a tile's edges, counterclockwise there too."""
    placed = [_planar(motion(edge)) for edge in edges]
    return [edge[::-1] for edge in placed[::-1]] if motion.mirrored else placed


def _planar(points: Complex) -> Floats:
    return np.column_stack([points.real, points.imag])


def _outline_edges(figure: _Figure) -> tuple[Complex, list[Complex]]:
    """Draw a figure: its corners (c,), where the symmetry is exact, and its edges (n,), counterclockwise."""
    drawn = _complex(figure.corners)
    corners = snapped_corners(figure.symmetry, drawn)
    following = np.roll(corners, -1)
    edges: dict[int, Complex] = {}
    for pair, inner in zip(PAIRS[figure.symmetry], figure.edges, strict=True):
        k = pair.first
        old_start, old_stop = drawn[k], drawn[(k + 1) % len(drawn)]
        share = (_complex(inner) - old_start) / (old_stop - old_start)
        controls = np.r_[corners[k], corners[k] + share * (following[k] - corners[k]), following[k]]
        motion = pair.motion(corners)
        if pair.first == pair.second:
            controls = (controls + motion(controls)[::-1]) / 2
        edges[k] = _spline(controls)
        if pair.first != pair.second:
            other = motion(edges[k])
            edges[pair.second] = other if pair.mirrored else other[::-1]
    return corners, [edges[k] for k in range(len(corners))]


def _spline(controls: Complex) -> Complex:
    """Draw a smooth curve through points (k,), with evenly spaced points on it."""
    from scipy.interpolate import CubicSpline

    if len(controls) < 3:
        along = np.arange(len(controls), dtype=np.float64)
        fine = np.interp(np.linspace(0, along[-1], 50), along, controls)
    else:
        along = np.r_[0.0, np.sqrt(np.abs(np.diff(controls))).cumsum()]
        fine = CubicSpline(along, controls, bc_type="natural")(np.linspace(0, along[-1], 40 * len(along)))
    length = np.r_[0.0, np.abs(np.diff(fine)).cumsum()]
    n = max(int(np.ceil(length[-1] / _SPACING)), 2)
    even: Complex = np.interp(np.linspace(0, length[-1], n + 1), length, fine)
    even[[0, -1]] = controls[[0, -1]]
    return even


def _complex(points: Points) -> Complex:
    pairs: Floats = np.array(points, np.float64).reshape(-1, 2)
    return np.asarray(pairs @ (1, 1j))
