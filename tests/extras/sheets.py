"""Outer sheets with the way to the inner one, and the pieces between them, all known from their making."""

import numpy as np

from meshjig.mesh.measure import vertex_normals
from meshjig.mesh.types import Mesh
from tests.check.pieces import shell
from tests.meshes import Shape

__all__ = ["inward", "plate", "whole_shell"]


def plate(width, depth, thickness, n=24):
    """Make a flat plate whose outer side looks up; its outer sheet and the way down."""
    x, y = np.meshgrid(np.linspace(-width / 2, width / 2, n), np.linspace(-depth / 2, depth / 2, n))
    V = np.stack([x.ravel(), y.ravel(), np.zeros(n * n)], 1)
    k = np.arange(n * n).reshape(n, n)
    a, b, c, d = (p.ravel() for p in (k[:-1, :-1], k[:-1, 1:], k[1:, 1:], k[1:, :-1]))
    F = np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])
    return whole_shell(Shape(V, F), thickness)


def inward(shape, thickness):
    """Give the way from a smooth surface to its inner sheet, straight down."""
    return -thickness * vertex_normals(*shape)


def whole_shell(shape, thickness):
    """Make one piece of a whole open surface; give it with the outer sheet and the way to the inner one."""
    D = inward(shape, thickness)
    return shell(shape.V, shape.V + D, shape.F), Mesh(*shape), D
