"""Questions that tests ask of any tiling, answered without its own bookkeeping of neighbours."""

import numpy as np
import shapely

from meshjig.tiling.unit import edge_curves, tile_outlines

__all__ = ["copies", "cover_counts", "is_moved", "outlines"]


def outlines(unit):
    return tile_outlines(unit, edge_curves(unit))


def copies(unit, reach=3):
    """Polygons of all copies moved by up to `reach` translations either way."""
    steps = np.arange(-reach, reach + 1)
    moves = np.stack(np.meshgrid(steps, steps), -1).reshape(-1, 2) @ unit.translations
    return [shapely.Polygon(tile + by) for tile in outlines(unit) for by in moves]


def cover_counts(unit, n=400, seed=0):
    """How many tiles random points of the plane, all over one unit, lie in."""
    at = np.random.default_rng(seed).random((n, 2)) @ unit.translations + np.mean(outlines(unit)[0], axis=0)
    tree = shapely.STRtree(copies(unit, reach=4))
    found = tree.query(shapely.points(at), predicate="intersects")[0]
    return np.bincount(found, minlength=n)


def is_moved(tile, other, mirrored=False, tolerance=1e-6):
    """Whether a tile is another, turned and moved (and mirrored, where that counts too)."""
    a, b = (points - np.array(shapely.Polygon(points).centroid.coords[0]) for points in (tile, other))
    flips = [np.eye(2), np.diag([1.0, -1.0])] if mirrored else [np.eye(2)]
    first = a[np.argmax(np.linalg.norm(a, axis=1))]
    far = np.flatnonzero(np.abs(np.linalg.norm(b, axis=1) - np.linalg.norm(first)) < tolerance)
    for flip in flips:
        for k in far:
            turn = np.arctan2(*b[k][::-1]) - np.arctan2(*(first @ flip)[::-1])
            c, s = np.cos(turn), np.sin(turn)
            turned = shapely.LinearRing(a @ flip @ np.array([[c, s], [-s, c]]))
            if turned.hausdorff_distance(shapely.LinearRing(b)) < 10 * tolerance:
                return True
    return False
