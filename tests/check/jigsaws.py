"""Small puzzles whose motions are known from their making."""

import numpy as np
import shapely
import trimesh

from tests.meshes import Shape, moved

__all__ = ["GAP", "coupon", "dovetail", "prism", "ring"]

GAP, TILE, THICK = 0.2, 10.0, 2.0  # mm


def prism(outline, low, high):
    """Make a closed solid from an outline in the plane."""
    solid = trimesh.creation.extrude_polygon(shapely.Polygon(outline).buffer(0), high - low)
    return moved(Shape(np.asarray(solid.vertices, float), np.asarray(solid.faces, np.int64)), [0, 0, low])


def coupon():
    """Make 3 x 3 tiles of a flat sheet, each with a knob wider than its neck into the one to the right."""
    knobs = [[shapely.Polygon(_knob(x, y)) for x in (1, 2)] for y in range(3)]
    pieces = []
    for y in range(3):
        for x in range(3):
            tile = shapely.box(TILE * x, TILE * y, TILE * (x + 1), TILE * (y + 1))
            if x > 0:
                tile = tile.difference(knobs[y][x - 1])
            if x < 2:
                tile = tile.union(knobs[y][x])
            pieces.append(prism(tile.buffer(-GAP / 2, join_style="mitre").exterior.coords, 0.0, THICK))
    return pieces


def _knob(x, y):
    at = [TILE * x - 0.1, TILE * y]
    return np.array([[0, 4.4], [1.5, 3.5], [3, 3.5], [3, 6.5], [1.5, 6.5], [0, 5.6]]) + at


def dovetail(wide_below):
    """Make two tiles, the first with a knob whose sides lean: wider below where that is asked for."""
    a, b = (1.0, 2.5) if wide_below else (2.5, 1.0)
    side = [[5 - a, THICK], [5 + a, THICK], [5 + b, 0], [5 - b, 0]]  # across and up
    knob = trimesh.creation.extrude_polygon(shapely.Polygon(side), 3.0)
    V = np.asarray(knob.vertices) @ np.array([[0, 1, 0], [0, 0, 1], [1, 0, 0]]) + [TILE - 0.1, 0, 0]
    knob = trimesh.Trimesh(V, knob.faces)
    hole = trimesh.creation.extrude_polygon(shapely.Polygon(side).buffer(GAP, join_style="mitre"), 3.2 + GAP)
    V = np.asarray(hole.vertices) @ np.array([[0, 1, 0], [0, 0, 1], [1, 0, 0]]) + [TILE - 0.1, 0, 0]
    hole = trimesh.Trimesh(V, hole.faces)
    left = trimesh.creation.box(bounds=[[0, 0, 0], [TILE, TILE, THICK]])
    right = trimesh.creation.box(bounds=[[TILE + GAP, 0, 0], [2 * TILE, TILE, THICK]])
    return [_shape(left.union(knob)), _shape(right.difference(hole))]


def ring():
    """Make four blocks around a middle, each with a peg into the next: none can be put in last."""
    block = trimesh.creation.box(bounds=[[GAP / 2] * 3, [TILE] * 3])
    peg = trimesh.creation.box(bounds=[[-3.0, 3.5, 3.5], [GAP, 6.5, 6.5]])
    hole = trimesh.creation.box(bounds=[[3.5 - GAP, -3 - GAP, 3.5 - GAP], [6.5 + GAP, GAP, 6.5 + GAP]])
    hole.apply_transform(_quarter_turns(2, [5.0, 0.0, 0.0]))
    blocks = [block.union(peg).difference(hole)]
    return [_shape(blocks[0].copy().apply_transform(_quarter_turns(k))) for k in range(4)]


def _quarter_turns(k, about=(0.0, 0.0, 0.0)):
    return trimesh.transformations.rotation_matrix(k * np.pi / 2, [0, 0, 1], about)


def _shape(solid):
    return Shape(np.asarray(solid.vertices, float), np.asarray(solid.faces, np.int64))
