"""From where to look at a step, so that its new pieces are seen."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.measure import unit
from meshjig.output.guide.arrows import Arrows
from meshjig.output.guide.proxy import PlacedFaces, ProxyModel, meet
from meshjig.output.pictures.view import View, view_of

__all__ = ["Camera", "cameras", "choose_cameras"]

_AZIMUTHS = tuple(range(30, 390, 45))  # degrees
_ELEVATIONS = (20.0, 48.0)
_BELOW = -35.0  # for pieces that go in from below
_UPSIDE_DOWN = 0.8  # worth of a view from below: who builds has to lift the model
_RAYS = 60  # a piece
_INSIDE = 0.6  # worth of a piece's inner side, seen through an opening
_WALL = 0.1  # worth of the walls around it
_ENOUGH = 0.3  # of a piece's outline, in mm2 of half its surface: it is found at a glance
_BEFORE = 2e-3  # of the distance from the eye: what a ray meets there hides nothing
_SAME = 0.3  # how much worse a view may be that spares turning the model
_HIDDEN = 0.2  # of enough, below which a piece deserves another picture
_BETTER = 0.3  # how much more of enough the other picture has to show
_NO_ARROW = 0.15  # worth of a piece whose arrow is not seen
_SIDEWAYS = 0.6  # sine of the angle between an arrow and the eye from which on it is seen well
_ON_ARROW = np.linspace(0.1, 1, 5)  # where rays meet an arrow


class Camera(NamedTuple):
    """One of the places from which pictures are taken."""

    azimuth: float
    elevation: float
    view: View
    extent: Floats  # (2,), width and height of the model in the plane at distance 1

    @property
    def words(self) -> str:
        """Say where it stands."""
        side = ("front", "right", "back", "left")[int((self.azimuth + 45) // 90) % 4]
        height = " and below" if self.elevation < 0 else " and above"
        return f"from the {side}" + ("" if self.elevation == _ELEVATIONS[0] else height)


def cameras(model: ProxyModel, *, below: bool = False) -> list[Camera]:
    """Give places all around a model, at the same distance; some below it, if asked for."""
    from scipy.spatial import ConvexHull

    outline = model.V[ConvexHull(model.V).vertices]
    made = []
    for elevation in (*_ELEVATIONS, _BELOW) if below else _ELEVATIONS:
        for azimuth in _AZIMUTHS:
            view = view_of(outline, model.up, azimuth, elevation)
            extent = np.ptp(view.on_plane(outline), axis=0)
            made.append(Camera(azimuth % 360, elevation, view, extent))
    return made


def choose_cameras(
    model: ProxyModel,
    placed: PlacedFaces,
    new: Sequence[int],
    places: Sequence[Camera],
    last: int,
    arrows: Arrows | None = None,
) -> list[tuple[int, list[int]]]:
    """Choose the places that show the new pieces best, and their arrows.

    Parameters
    ----------
    model : ProxyModel
    placed : PlacedFaces, what is there, the new pieces included
    new : sequence of int, pieces counted from 0
    places : sequence of Camera
    last : int
        The place of the picture before; it is kept where it is nearly as good.
    arrows : Arrows, optional

    Returns
    -------
    list of (int, list of int)
        One place with all pieces; more where some can hardly be seen from the first, but from another:
        each with those pieces that it is there for.
    """
    shown = np.minimum(_seen(model, placed, new, places) / _ENOUGH, 1)
    if arrows is not None:
        shown *= _NO_ARROW + (1 - _NO_ARROW) * _arrow_seen(placed, new, places, arrows)
    shown[[place.elevation < 0 for place in places]] *= _UPSIDE_DOWN
    total = shown.sum(axis=1)
    total[last] += _SAME * len(new)
    chosen = [int(total.argmax())]
    best = shown[chosen[0]].copy()
    home = np.zeros(len(new), np.int64)
    while True:
        better = (best < _HIDDEN) & (shown > best + _BETTER)
        gain = np.where(better, shown - best, 0).sum(axis=1)
        if not gain.any():
            break
        another = int(gain.argmax())
        home[better[another]] = len(chosen)
        best = np.maximum(best, shown[another])
        chosen.append(another)
    whose = [
        [piece for piece, at in zip(new, home.tolist(), strict=True) if at == k] for k in range(len(chosen))
    ]
    return [(camera, mine) for camera, mine in zip(chosen, whose, strict=True) if mine]


def _seen(model: ProxyModel, placed: PlacedFaces, new: Sequence[int], places: Sequence[Camera]) -> Floats:
    """Tell how much of each new piece is seen from each place, in shares of half its surface, (c, p).

    Rays go from the eyes to some faces of each piece; those count that meet nothing else before.
    """
    owner = placed.scene.id[: placed.n_faces]
    faces = [_some(np.flatnonzero(owner == piece)) for piece in new]
    face, piece = np.concatenate(faces), np.repeat(np.arange(len(new)), [len(some) for some in faces])
    A = model.area_vector[face]
    outside = model.outside[face]
    flat = np.minimum(_WALL + 1.2 * np.abs(outside), 1)
    worth = flat * np.where(outside > 0, 1.0, _INSIDE)
    half = np.maximum(np.bincount(piece, flat * np.linalg.norm(A, axis=1), len(new)) / 2, 1e-12)
    eye = np.array([place.view.eye for place in places])
    toward = model.middle[face] - eye[:, None]
    facing = -np.einsum("cfk,fk->cf", toward, A) / np.linalg.norm(toward, axis=2)
    camera, ray = np.nonzero(facing > 0)
    met = meet(placed, eye[camera], toward[camera, ray].astype(np.float32))
    near = met.depth > (1 - _BEFORE) / placed.scene.radius  # thin parts may be one sheet, twice
    free = near & (met.face >= 0) & (placed.scene.id[met.face] == owner[face[ray]])
    value = (facing[camera, ray] * worth[ray])[free]
    n = len(new)
    seen = np.bincount((camera * n + piece[ray])[free], value, len(places) * n).reshape(-1, n)
    return seen / half


def _arrow_seen(placed: PlacedFaces, new: Sequence[int], places: Sequence[Camera], arrows: Arrows) -> Floats:
    """Tell how well the arrow of each new piece is seen from each place, 0 to 1, (c, p)."""
    seat, along = arrows.seat[list(new)], (arrows.start - arrows.seat)[list(new)]
    points = seat[:, None] + _ON_ARROW[:, None] * along[:, None]
    eye = np.array([place.view.eye for place in places])
    toward = points - eye[:, None, None]
    met = meet(placed, eye.repeat(toward[0, :, :, 0].size, 0), toward.reshape(-1, 3).astype(np.float32))
    free = (met.face < 0) | (met.depth > 1 / placed.scene.radius)
    share = free.reshape(toward.shape[:3]).mean(axis=2)
    away = np.einsum("cpi,pi->cp", unit(toward.mean(axis=2)), unit(along))  # cosine
    seen: Floats = share * np.minimum(np.sqrt(np.maximum(1 - away * away, 0)) / _SIDEWAYS, 1)
    seen *= 1 - np.maximum(away, 0)  # from behind
    return seen


def _some(faces: Ints) -> Ints:
    """A few of many faces, evenly spaced."""
    return faces[np.linspace(0, len(faces) - 1, min(len(faces), _RAYS)).astype(np.int64)]
