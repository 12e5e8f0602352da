"""A rough puzzle for small pictures, its faces in the order in which pieces are placed, and rays into it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.measure import area_vectors, unit
from meshjig.mesh.mesh import concatenate
from meshjig.mesh.rays import Floats32
from meshjig.output.pictures.scene import Scene, scene_of, shifted
from meshjig.output.pictures.view import guess_up
from meshjig.output.piece import Piece

__all__ = ["FirstHits", "JoinedPieces", "PlacedFaces", "ProxyModel", "join_pieces", "meet", "proxy_model"]


_GRAIN = 0.0125  # of the model's largest extent: what small pictures don't show
_UPRIGHT = 1e-6  # cosine to the outward direction up to which a face is a wall
_A_SCENE = 5  # steps; making a scene takes longer than looking through what is not placed yet


_BEHIND = np.float32(1e-4)  # radii of the model: how far behind a face a ray goes on


class JoinedPieces(NamedTuple):
    """All pieces as one mesh."""

    V: Floats  # (n, 3), mm
    F: Ints  # (m, 3)
    piece_of_vertex: Ints  # (n,), counted from 0
    outer: Bools  # (m,), the face is on the outer side of its piece
    outward: Floats  # (p, 3), where the outer sides face
    up: Floats  # (3,)


class PlacedFaces(NamedTuple):
    """What is there at a step: the first faces of a scene."""

    scene: Scene
    n_faces: int


@dataclass(frozen=True)
class ProxyModel:
    """All pieces, roughly, ready to be looked at step by step."""

    scene: Scene  # of all pieces; its ids are those of the pieces, counted from 0
    V: Floats  # (n, 3), mm
    middle: Floats  # (m, 3), of the faces, mm
    area_vector: Floats  # (m, 3), mm2, outward
    outside: Floats  # (m,), cosine between the face and where the outer side of its piece faces
    up: Floats  # (3,)
    first_vertex: Ints  # (s + 1,), where the vertices of each step begin
    first_face: Ints  # (s + 1,)
    _made: dict[int, Scene] = field(default_factory=dict)

    def until(self, step: int) -> PlacedFaces:
        """Give what is there after a step, counted from 0."""
        last = min(step - step % _A_SCENE + _A_SCENE, len(self.first_face) - 1)
        if last not in self._made:
            n, m = int(self.first_vertex[last]), int(self.first_face[last])
            part = replace(self.scene, F=self.scene.F[:m], id=self.scene.id[:m])
            self._made.clear()
            self._made[last] = self.scene if m == len(self.scene.F) else shifted(part, self.V[:n])
        return PlacedFaces(self._made[last], int(self.first_face[step + 1]))


def join_pieces(pieces: Sequence[Piece], up: Floats | None = None) -> JoinedPieces:
    """Join pieces, at least one, and find their outer sides; and which way is up, where that is not told."""
    V, F, piece_of_vertex, piece_of_face = concatenate(pieces)
    outward = _outward(pieces)
    A, n = area_vectors(V, F), unit(outward)[piece_of_face]
    outer = np.einsum("ij,ij->i", A, n) > _UPRIGHT * np.sqrt(np.einsum("ij,ij->i", A, A))
    return JoinedPieces(V, F, piece_of_vertex, outer, outward, guess_up(V, F) if up is None else up)


def proxy_model(joined: JoinedPieces, steps: Sequence[Sequence[int]]) -> ProxyModel:
    """Make a rough puzzle: points of a piece that lie close together become one.

    Parameters
    ----------
    joined : JoinedPieces
    steps : sequence of sequence of int
        Which pieces are placed in each step, counted from 1.

    Returns
    -------
    ProxyModel
        Without the pieces that are in no step.
    """
    V, F, piece_of_vertex, outer_face, outward, up = joined
    turn = _turns(len(outward), steps)
    outer = np.ones(len(V), bool)
    outer[F] = outer_face[:, None]
    cell = _cells(V, 2 * turn[piece_of_vertex] + outer)
    W = np.stack([np.bincount(cell, x) for x in V.T], 1) / np.bincount(cell)[:, None]
    owner = np.empty(len(W), np.int64)
    owner[cell] = piece_of_vertex
    G = cell[F]
    G = G[(G[:, 0] != G[:, 1]) & (G[:, 1] != G[:, 2]) & (G[:, 2] != G[:, 0])]
    G = G[np.argsort(turn[owner[G[:, 0]]], kind="stable")]
    n_placed = np.cumsum([0, *map(len, steps)])
    first_vertex, first_face = (np.searchsorted(turn[x], n_placed) for x in (owner, owner[G[:, 0]]))
    W, G = W[: first_vertex[-1]], G[: first_face[-1]]
    piece, A = owner[G[:, 0]], area_vectors(W, G) / 2
    return ProxyModel(
        scene_of(W, G, np.ones((len(G), 3)), piece),
        W,
        W[G].mean(axis=1),
        A,
        np.einsum("ij,ij->i", unit(A), unit(outward)[piece]),
        up,
        first_vertex,
        first_face,
    )


def _outward(pieces: Sequence[Piece]) -> Floats:
    """Where the outer sides face, (p, 3); away from the middle of the model where nobody knows."""
    middles = np.array([piece.V.mean(axis=0) for piece in pieces])
    away = middles - middles.mean(axis=0)
    told = [piece.outer_normal for piece in pieces]
    return np.array([x if normal is None else normal for x, normal in zip(away, told, strict=True)])


def _turns(n: int, steps: Sequence[Sequence[int]]) -> Ints:
    """When each piece's turn is, (n,); n for those that are never placed."""
    turn = np.full(n, n)
    row = [piece - 1 for step in steps for piece in step]
    turn[row] = np.arange(len(row))
    return turn


def _cells(V: Floats, rank: Ints) -> Ints:
    """Number the cubes of a grid that hold points of the same rank, lower ranks first, (n,)."""
    grain = max(_GRAIN * float(np.ptp(V, axis=0).max()), 1e-9)
    x, y, z = np.floor((V - V.min(axis=0)) / grain).astype(np.int64).T
    size = int(1 / _GRAIN) + 2
    _, number = np.unique(((rank * size + x) * size + y) * size + z, return_inverse=True)
    return number


class FirstHits(NamedTuple):
    """What rays met, in the scene's own scale."""

    face: Ints  # (k,), -1 for nothing
    depth: Floats32  # (k,), in lengths of the ray's direction
    corner: Floats32  # (k, 3), barycentric


def meet(placed: PlacedFaces, eye: Floats, direction: Floats32) -> FirstHits:
    """Find the first face that each ray meets; rays pass through pieces that are not placed yet.

    Parameters
    ----------
    placed : PlacedFaces
    eye : (3,) or (k, 3) float64, mm
    direction : (k, 3) float32

    Returns
    -------
    FirstHits
    """
    scene, n = placed
    origin = np.broadcast_to(scene.scaled(eye).astype(np.float32), direction.shape)
    found = scene.rays.hits(origin, direction)
    face, depth = found["primID"].astype(np.int64), found["tfar"]
    corner = np.stack([1 - found["u"] - found["v"], found["u"], found["v"]], 1)
    through = np.flatnonzero(face >= n)
    while len(through):
        further = depth[through] + _BEHIND
        toward = direction[through]
        again = scene.rays.hits(origin[through] + further[:, None] * toward, toward)
        face[through], depth[through] = again["primID"], further + again["tfar"]
        corner[through] = np.stack([1 - again["u"] - again["v"], again["u"], again["v"]], 1)
        through = through[face[through] >= n]
    return FirstHits(face, depth, corner)
