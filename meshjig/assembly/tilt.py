"""How far walls must lean for a piece to go out in a direction."""

from __future__ import annotations

import numpy as np

from meshjig.assembly.borders import BorderEdges
from meshjig.assembly.shell_rays import ShellRays
from meshjig.mesh.arrays import Floats

__all__ = ["DIRECTIONS", "FREE", "around_sphere", "needed_tilt", "room_to_lean"]

FREE = 50.0  # degrees of room that put no price on leaning
_LEANS = (15.0, 25.0, 33.0, 41.0, 50.0)  # degrees
_MOST = 80  # edges of a border that are looked at


def around_sphere(n: int) -> Floats:
    """Spread n unit vectors evenly, (n, 3), along a spiral with the golden angle."""
    i = np.arange(n) + 0.5
    polar, turn = np.arccos(1 - 2 * i / n), np.pi * (1 + 5**0.5) * i
    return np.stack([np.cos(turn) * np.sin(polar), np.sin(turn) * np.sin(polar), np.cos(polar)], 1)


DIRECTIONS = around_sphere(1600)


def needed_tilt(b: BorderEdges, room: Floats) -> Floats:
    """Give how far each border's walls must lean from the normal for a piece to leave along each direction.

    A wall may stay on the normal where the way out leads away from it, as a cork's does. On a knob's curve
    walls face every way, and all lean along the way out. Where there is little room to lean, as on ridges, a
    lean counts for more.

    Parameters
    ----------
    b : BorderEdges
    room : (e, 4) float64, degrees, as of `room_to_lean`

    Returns
    -------
    (2, p, d) float64, degrees
        For the lower and for the upper piece of each pair, and each of DIRECTIONS.
    """
    order = np.argsort(b.pair, kind="stable")
    start = np.searchsorted(b.pair[order], np.arange(len(b.pairs) + 1))
    need = np.zeros((2, len(b.pairs), len(DIRECTIONS)))
    for i in range(len(b.pairs)):
        e = order[start[i] : start[i + 1]]
        if len(e) > _MOST:
            e = e[np.linspace(0, len(e) - 1, _MOST).astype(int)]
        knob = b.knob[e]
        up, out = b.normal[e] @ DIRECTIONS.T, b.conormal[e] @ DIRECTIONS.T
        dear = FREE / room[e]
        if knob.any():
            on = e[knob]
            along = b.tangent[on] @ DIRECTIONS.T
            way = np.where(out[knob] > 0, dear[knob, 1:2], dear[knob, 0:1])  # walls lead down against it
            side = np.where(along > 0, dear[knob, 3:4], dear[knob, 2:3])
            flat = np.maximum(out[knob] ** 2 + along**2, 1e-12)
            dearer = (way * out[knob] ** 2 + side * along**2) / flat
            need[:, i] = (np.degrees(np.arccos(np.clip(up[knob], -1, 1))) * dearer).max(axis=0)
        if not knob.all():
            up, out, dear = up[~knob], out[~knob], dear[~knob]
            for side_, sign in enumerate((1, -1)):
                lean = np.degrees(np.arctan2(np.maximum(sign * out, 0), up)) * dear[:, side_ ^ 1, None]
                need[side_, i] = np.maximum(need[side_, i], lean.max(axis=0))
    return need


def room_to_lean(b: BorderEdges, V: Floats, D: Floats, rays: ShellRays) -> Floats:
    """Tell how far walls can lean before they run along the shell instead of through it.

    Parameters
    ----------
    b : BorderEdges
    V : (n, 3) float64, mm, the outer sheet
    D : (n, 3) float64, mm, to the inner sheet
    rays : ShellRays

    Returns
    -------
    (e, 4) float64, degrees
        For walls whose foot is moved along the conormal, against it, along the tangent, and against that.
    """
    middle = (V[b.tail] + V[b.head]) / 2 + (D[b.tail] + D[b.head]) / 4
    half = np.linalg.norm(D[b.tail] + D[b.head], axis=1)[:, None] / 4
    room = np.full((len(b.tail), 4), 8.0)
    for k, foot in enumerate((b.conormal, -b.conormal, b.tangent, -b.tangent)):
        free = np.ones(len(b.tail), bool)
        for lean in _LEANS:
            at = np.flatnonzero(free)
            way = half[at] * (np.tan(np.radians(lean)) * foot[at] - b.normal[at])
            free[at] = rays.leads_through(middle[at], way)
            room[free, k] = lean
    return room
