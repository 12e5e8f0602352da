"""Cells that are easy to think about: the squares of a sheet, flat, rolled, folded or waved."""

from itertools import pairwise

import numpy as np

from meshjig.mesh.types import Atlas, Mesh

EDGE = 20.0  # mm


def square_cells(n=4, m=None, fine=10, shape=None, plane=None):
    """Cut a sheet into n x m squares of EDGE, each of 2 fine^2 faces, laid apart in the plane.

    `shape` takes points (k, 2) of the sheet to space, `plane` warps them in the plane; lengths there
    are those of the sheet as long as both keep them.
    """
    m = m or n
    nx, ny = n * fine, m * fine
    x = np.stack(np.meshgrid(np.arange(nx + 1), np.arange(ny + 1), indexing="ij"), -1).reshape(-1, 2)
    i, j = (a.ravel() for a in np.meshgrid(np.arange(nx), np.arange(ny), indexing="ij"))
    a = i * (ny + 1) + j
    F = np.concatenate([np.stack([a, a + ny + 1, a + ny + 2], 1), np.stack([a, a + ny + 2, a + 1], 1)])
    cell = np.tile(i // fine * m + j // fine, 2)
    flat = x * EDGE / fine
    V = np.c_[flat, np.zeros(len(flat))] if shape is None else shape(flat)
    uv = flat if plane is None else plane(flat)
    key, F_uv = np.unique(cell[:, None] * len(V) + F, return_inverse=True)
    of_cell, vertex = key // len(V), key % len(V)
    apart = np.stack([of_cell // m, of_cell % m], 1) * EDGE
    return Atlas(Mesh(V, F), uv[vertex] + apart, F_uv.reshape(-1, 3), cell)


def waved(x):
    """Bend straight lines of the plane a little, everywhere differently."""
    return x + 0.8 * np.stack([np.sin(x[:, 1] / 5.0 + x[:, 0] / 17.0), np.sin(x[:, 0] / 6.0)], 1)


def waved_flat(x):
    return np.c_[waved(x), np.zeros(len(x))]


def rolled(x):
    """Roll the sheet around a cylinder of radius 40 mm."""
    return np.stack([40 * np.sin(x[:, 0] / 40), x[:, 1], 40 * np.cos(x[:, 0] / 40)], 1)


def folded(x, at=32.0):
    """Fold the sheet by 90 degrees along a line."""
    over = np.maximum(x[:, 0] - at, 0)
    return np.stack([np.minimum(x[:, 0], at), x[:, 1], -over], 1)


def hemispheres(rings=14):
    """A sphere of radius 30 mm as two cells that meet in one closed border."""
    count = 6 * rings
    r = np.repeat(np.arange(1, rings + 1) / rings, count)
    t = np.tile(2 * np.pi * np.arange(count) / count, rings)
    disc = np.vstack([[0, 0], np.stack([r * np.cos(t), r * np.sin(t)], 1)])
    first = 1 + np.arange(rings) * count
    k = np.arange(count)
    following = (k + 1) % count
    faces = [np.stack([np.zeros(count, int), 1 + k, 1 + following], 1)]
    for inner, outer in pairwise(first):
        faces.append(np.stack([inner + k, outer + k, outer + following], 1))
        faces.append(np.stack([inner + k, outer + following, inner + following], 1))
    half = np.concatenate(faces)
    radius = np.linalg.norm(disc, axis=1, keepdims=True)
    top = (
        30 * np.c_[np.sin(radius * np.pi / 2) * disc / np.maximum(radius, 1e-12), np.cos(radius * np.pi / 2)]
    )
    bottom = top * [1, 1, -1]
    inner_vertices = len(disc) - count
    number = np.where(
        np.arange(len(disc)) < inner_vertices, np.arange(len(disc)) + len(disc), np.arange(len(disc))
    )
    V = np.vstack([top, bottom[:inner_vertices]])
    F = np.vstack([half, number[half][:, ::-1]])
    uv = 30 * np.sqrt(2) * np.vstack([disc, disc * [1, -1] + [4, 0]])
    F_uv = np.vstack([half, (half + len(disc))[:, ::-1]])
    return Atlas(Mesh(V, F), uv, F_uv, np.repeat([0, 1], len(half)))
