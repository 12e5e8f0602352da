"""How much of the pieces is thinner than can be made, where the model is not."""

from __future__ import annotations

from collections import Counter
from typing import NamedTuple

import numpy as np

from meshjig.mesh.arrays import Bools, Floats, Ints
from meshjig.mesh.measure import unit
from meshjig.mesh.mesh import Concatenated, Mesh, concatenate
from meshjig.mesh.rays import RayScene
from thin.model import SKIN, TURNED, Model, spread

__all__ = ["Thin", "thin_share"]

_SAMPLES = 20_000
_TOO_THIN = 0.9  # of the least wall
_FLAT = -0.866  # cosine between the normals of two sides that enclose less than 30 degrees


class Thin(NamedTuple):
    """Where pieces are too thin, as shares of the area where the model is thicker than the least wall."""

    sheets: float  # an end of the ray, or both, lie on the model's surface
    inside: float  # neither end does: between two walls, or a wall and an inner sheet
    flat: float  # of both, where the two sides enclose less than 30 degrees: a skin, no sharp edge
    pardoned: float  # share of all samples at which the model itself is too thin
    thinnest: float  # mm, of what is counted, or of all rays if nothing is
    worst: list[tuple[int, int]]  # pieces, from 1, with most samples that count, and how many
    at: Floats  # (k, 3), the samples that count

    @property
    def share(self) -> float:
        """Both shares together."""
        return self.sheets + self.inside


def thin_share(model: Model, pieces: list[Mesh], min_wall: float) -> Thin:
    """Send a ray inward from 20,000 samples of the pieces' faces to the same piece's other side.

    A ray counts that is shorter than 0.9 of the least wall, and ends on a face that is turned by over
    120 degrees against the one it starts on. One that starts or ends on the model's surface is pardoned
    where the model, along the same ray, is not thicker than the least wall. A piece so thin that a ray
    starts outside it has no thickness there.

    Parameters
    ----------
    model : Model
    pieces : closed meshes, mm
    min_wall : float, mm
    """
    whole = concatenate(pieces)
    mesh = Mesh(whole.V, whole.F)
    N = unit(mesh.area_vectors)
    points, face = spread(mesh, _SAMPLES)
    way = -N[face]
    length, cosine = _through_own_piece(whole, N, points, face)
    starts_on, below = model.thickness(points, way)
    ends = points + np.where(np.isfinite(length), length, 0.0)[:, None] * way
    ends_on, above = model.thickness(ends, -way)
    ends_on &= np.isfinite(length)
    model_thin: Bools = (starts_on & (below <= min_wall)) | (ends_on & (above <= min_wall))
    bad = (length < _TOO_THIN * min_wall) & ~model_thin
    counted = max(int((~model_thin).sum()), 1)
    sheet = starts_on | ends_on
    some = length[bad] if bad.any() else length
    return Thin(
        sheets=float((bad & sheet).sum() / counted),
        inside=float((bad & ~sheet).sum() / counted),
        flat=float((bad & (cosine <= _FLAT)).sum() / counted),
        pardoned=float(model_thin.mean()),
        thinnest=float(some.min()),
        worst=Counter((whole.part_of_face[face[bad]] + 1).tolist()).most_common(5),
        at=points[bad],
    )


def _through_own_piece(whole: Concatenated, N: Floats, points: Floats, face: Ints) -> tuple[Floats, Floats]:
    """Send rays straight in to the other side of their own piece.

    Returns
    -------
    length : (k,), mm; infinite where the other side is turned by less than 120 degrees
    cosine : (k,), between the normals of the two sides; -1 where the ray starts outside
    """
    length, cosine = np.full(len(points), np.inf), np.full(len(points), -1.0)
    piece_of_sample = whole.part_of_face[face]
    for piece in np.unique(piece_of_sample):
        mine, own = np.flatnonzero(piece_of_sample == piece), np.flatnonzero(whole.part_of_face == piece)
        inward = -N[face[mine]]
        hit = RayScene(whole.V, whole.F[own]).hits(points[mine] + SKIN * inward, inward)
        met = np.asarray(hit["primID"], np.int64)
        other = N[own[met]]
        leaves = (met >= 0) & (np.einsum("ij,ij->i", other, inward) > 0)
        turn = np.einsum("ij,ij->i", other, -inward)
        far = np.where(turn <= TURNED, np.asarray(hit["tfar"], float) + SKIN, np.inf)
        length[mine], cosine[mine] = np.where(leaves, far, 0.0), np.where(leaves, turn, -1.0)
    return length, cosine
