"""All pieces as one list of faces: points spread evenly over them, and rays from one to another."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from meshjig.mesh.arrays import Floats, Ints, connected, row_of, starts
from meshjig.mesh.halfedges import edges
from meshjig.mesh.measure import area_vectors, interpolate
from meshjig.mesh.mesh import Mesh
from meshjig.mesh.rays import RayScene

__all__ = ["Samples", "Soup", "area_samples", "first_hit", "smooth_regions", "soup"]

_SMOOTH = 0.906  # cosine of 25 degrees, the most that faces of one region turn at an edge
_SKIN = 1e-3  # mm; rays start this far from the surface, since Embree works in float32


class Soup(NamedTuple):
    """All pieces as one list of faces."""

    V: Floats  # (n, 3), mm
    F: Ints  # (m, 3)
    piece: Ints  # (m,), the piece of a face
    N: Floats  # (m, 3), unit normals
    area: Floats  # (m,), mm2
    start: Ints  # (pieces + 1,), where a piece's faces start


class Samples(NamedTuple):
    """Points on the faces of a soup, ordered by face; each stands for the same area."""

    P: Floats  # (k, 3), mm
    face: Ints  # (k,)


def soup(pieces: Iterable[Mesh]) -> Soup:
    """Put all pieces into one list of faces."""
    verts, faces = zip(*pieces, strict=True)
    first, count = starts(np.array([len(V) for V in verts])), np.array([len(F) for F in faces])
    V, F = np.concatenate(verts), np.concatenate([F + k for F, k in zip(faces, first, strict=True)])
    piece = row_of(count)
    twice = area_vectors(V, F)
    area = np.linalg.norm(twice, axis=1) / 2
    return Soup(
        V, F, piece, twice / np.maximum(2 * area, 1e-300)[:, None], area, np.append(0, np.cumsum(count))
    )


def area_samples(s: Soup, n: int) -> Samples:
    """Spread n points over the faces, each standing for the same area.

    Steps of equal area through the list of faces, and within a face a golden-ratio sequence:
    as random as needed, and the same every time.
    """
    end = np.cumsum(s.area)
    face = np.searchsorted(end, (np.arange(n) + 0.5) * (end[-1] / n), side="right")
    face = np.minimum(face, len(s.F) - 1)
    k = np.arange(1, n + 1)
    a, b = np.modf(k * 0.7548776662466927)[0], np.modf(k * 0.5698402909980532)[0]
    a = np.sqrt(a)
    return Samples(interpolate(s.V, s.F, face, np.stack([1 - a, a * (1 - b), a * b], 1)), face)


def smooth_regions(s: Soup) -> Ints:
    """Number the parts of the surface between edges sharper than 25 degrees, (m,) int64, a number a face."""
    twin = edges(s.F).twin
    h = np.flatnonzero(twin > np.arange(len(twin)))
    a, b = h // 3, twin[h] // 3
    smooth = np.einsum("ij,ij->i", s.N[a], s.N[b]) > _SMOOTH
    return connected(len(s.F), a[smooth], b[smooth])[1]


def first_hit(scene: RayScene, s: Soup, P: Floats, direction: Floats) -> tuple[Ints, Floats]:
    """Shoot rays from points of the surface; give the faces they meet, -1 for none, and how far it is.

    The distance is measured to the plane of the face in double precision.
    """
    face = scene.first_face(P + _SKIN * direction, direction)
    toward = np.einsum("ij,ij->i", s.N[face], direction)
    height = np.einsum("ij,ij->i", s.N[face], s.V[s.F[face, 0]] - P)
    flat = np.abs(toward) < 1e-6
    way = np.where(flat, np.inf, height / np.where(flat, 1.0, toward))
    return np.where(way > 0, face, -1), way
