"""Labelled surfaces whose borders, tilts and ways are known from their making."""

from typing import NamedTuple

import numpy as np

from meshjig.assembly import BorderEdges, ShellRays, border_edges, needed_tilt, room_to_lean
from meshjig.mesh.measure import vertex_normals
from tests.meshes import sphere

__all__ = ["THICK", "Cells", "ball", "grid", "sheet"]

THICK = 2.0


class Cells(NamedTuple):
    """A labelled surface, and what plans are made of."""

    V: np.ndarray
    F: np.ndarray
    piece: np.ndarray
    D: np.ndarray
    borders: BorderEdges
    rays: ShellRays
    need: np.ndarray


def cells(V, F, piece, D, on_knob=None):
    on_knob = np.zeros(len(V), bool) if on_knob is None else on_knob
    borders = border_edges(V, F, piece, D, on_knob)
    rays = ShellRays(V, F, D)
    return Cells(V, F, piece, D, borders, rays, needed_tilt(borders, room_to_lean(borders, V, D, rays)))


def grid(width, height, step=1.0, z=0.0):
    """Make a flat sheet of squares in two, normals along +z, a corner at the origin."""
    nx, ny = round(width / step), round(height / step)
    x, y = np.meshgrid(step * np.arange(nx + 1), step * np.arange(ny + 1), indexing="ij")
    k = np.arange(x.size).reshape(x.shape)
    a, b, c, d = (i.ravel() for i in (k[:-1, :-1], k[1:, :-1], k[1:, 1:], k[:-1, 1:]))
    V = np.stack([x.ravel(), y.ravel(), np.full(x.size, z)], 1)
    return V, np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])


def sheet(columns=3, rows=3, edge=10.0, step=1.0, knob=False):
    """Cut a flat sheet into square pieces, numbered row by row; all borders are knobs if asked for."""
    V, F = grid(columns * edge, rows * edge, step)
    column, row = (V[F].mean(axis=1)[:, :2] // edge).astype(int).T
    D = np.tile([0.0, 0.0, -THICK], (len(V), 1))
    return cells(V, F, row * columns + column, D, np.full(len(V), knob))


def ball(n=14, faces=5000, radius=20.0):
    """Cut a ball into the cells around evenly spread points."""
    V, F = sphere(faces, radius)
    i = np.arange(n) + 0.5
    polar, turn = np.arccos(1 - 2 * i / n), np.pi * (1 + 5**0.5) * i
    seeds = np.stack([np.cos(turn) * np.sin(polar), np.sin(turn) * np.sin(polar), np.cos(polar)], 1)
    return cells(V, F, (V[F].mean(axis=1) @ seeds.T).argmax(axis=1), -THICK * vertex_normals(V, F))
