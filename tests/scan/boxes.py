"""Small boxes to be put together, as bodies that share corners, edges or walls."""

import numpy as np

from tests.meshes import Shape


def box(at=(0, 0, 0), parts=2):
    """A unit cube around a point, each side in parts x parts squares."""
    k = np.arange(parts + 1) / parts - 0.5
    i, j = (x.ravel() for x in np.meshgrid(np.arange(parts), np.arange(parts), indexing="ij"))
    a, b, c, d = (x * (parts + 1) + y for x, y in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)))
    square = np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])
    u, v = (x.ravel() for x in np.meshgrid(k, k, indexing="ij"))
    V, F = [], []
    for axis in range(3):
        for side in (-0.5, 0.5):
            P = np.empty((len(u), 3))
            P[:, axis], P[:, (axis + 1) % 3], P[:, (axis + 2) % 3] = side, u, v
            F.append((square if side > 0 else square[:, ::-1]) + len(u) * len(V))
            V.append(P)
    return welded(Shape(np.concatenate(V) + np.array(at, float), np.concatenate(F)))


def welded(*shapes):
    """Shapes in one mesh, with one vertex in a place."""
    V = np.concatenate([shape.V for shape in shapes])
    first = np.cumsum([0, *(len(shape.V) for shape in shapes)])
    F = np.concatenate([shape.F + k for shape, k in zip(shapes, first, strict=False)])
    places, number = np.unique(np.round(V, 9), axis=0, return_inverse=True)
    return Shape(places, number.ravel()[F])


def without_wall(shape, x):
    """A shape without its faces in the plane x."""
    return Shape(shape.V, shape.F[~(np.abs(shape.V[shape.F][:, :, 0] - x) < 1e-9).all(1)])
