"""A solid by Boolean operations: a swept base, an upright disc, a hyperbolic hole, an extruded cut."""

from typing import Any

import numpy as np
import trimesh

from models.patches import flipped, joined, meshed, parted, solid, tube, wheel
from models.rings import even

__all__ = ["bridge"]

_LENGTH, _HEIGHT, _DEPTH, _CORNER = 150.0, 56.0, 44.0, 12.0  # mm, of the base
_AXIS = 76.0  # mm, height of the disc's axis and the hole's; they run along z
_RIM, _THICK, _SOFT = 46.0, 18.0, 6.0  # mm, of the disc: radius, half thickness, rounding
_WAIST, _FLARE = 15.0, 0.75  # mm, of the hole: least radius; how fast it widens
_ARCH = 26.0  # mm, radius of the cut
_FAR = 1000.0  # mm, between the islands of two surfaces
_EVEN = 0.5  # how far tiles on narrow parts of turned surfaces keep their shape


def bridge(step: float = 1.6) -> trimesh.Trimesh:
    """Build it of four surfaces that meet in creases; closed, 150 mm long; y is up.

    Each surface brings its own parameters: ways along the outlines that were swept or turned.
    """
    base, disc, hole, cut = _base(step), _disc(step), _hole(), _cut(step)
    names = [int(part.to_mesh().run_original_id[0]) for part in (base, disc, hole, cut)]
    surfaces = dict(zip(names, (_on_base, _on_disc, _in_hole, _under_arch), strict=True))
    mesh = (base + disc - hole - cut).to_mesh()
    V = np.asarray(mesh.vert_properties, np.float64)
    V = V[_first(len(V), mesh), :3]
    F = _first(len(V), mesh)[np.asarray(mesh.tri_verts, np.int64)]
    starts = np.asarray(mesh.run_index, np.int64) // 3
    uv = np.empty((len(F), 3, 2))
    for k, name in enumerate(mesh.run_original_id):
        run = slice(int(starts[k]), int(starts[k + 1]))
        uv[run] = surfaces[int(name)](V[F[run]]) + np.array([_FAR * names.index(int(name)), 0.0])
    return meshed(parted(V, F, uv))


def _first(n: int, mesh: Any) -> np.ndarray:
    """Give the first of the vertices that are one in space."""
    first = np.arange(n)
    first[np.asarray(mesh.merge_from_vert)] = np.asarray(mesh.merge_to_vert)
    return first


def _base(step: float) -> Any:
    """Sweep a rounded outline upward, in faces as long as a step."""
    x, z = _LENGTH / 2 - _CORNER, _DEPTH / 2 - _CORNER
    a = np.linspace(0, np.pi / 2, 25)
    arcs = [
        [sx * x, sz * z] + _CORNER * np.stack([np.cos(a + turn), np.sin(a + turn)], 1)
        for (sx, sz), turn in zip([(1, 1), (-1, 1), (-1, -1), (1, -1)], np.arange(4) * np.pi / 2, strict=True)
    ]
    outline = np.vstack([*arcs, arcs[0][:1]])
    n = int(np.linalg.norm(np.diff(outline, axis=0), axis=1).sum() / step)
    outline = even(outline, n + 1)[-2::-1]  # clockwise in (x, z): counterclockwise seen from above
    heights = np.linspace(0, _HEIGHT, int(_HEIGHT / step) + 1)
    rings = np.stack([np.insert(outline, 1, y, axis=1) for y in heights])
    shrunk = np.linspace(0, 1, int(_LENGTH / 2 / step) + 1)[1:, None, None] * [1, 0, 1]
    low, high = (shrunk * ring + [0, ring[0, 1], 0] for ring in rings[[0, -1]])
    angle = 2 * np.pi * np.arange(n) / n
    side = tube(rings, np.arange(n + 1.0), heights)
    bottom, top = (wheel(lid, np.array([0, lid[0, 0, 1], 0]), angle) for lid in (low, high))
    return solid(joined([side, flipped(bottom), top]))


def _disc(step: float) -> Any:
    """Turn a rim about the axis, in faces as long as a step."""
    outline = _rim()
    flat = np.arange(_RIM - _SOFT - step, 10, -step)
    front = np.stack([flat[::-1], np.full(len(flat), -_THICK)], 1)
    rim = np.linspace(*outline[16:18, 1], int(2 * (_THICK - _SOFT) / step) + 1)[1:-1]
    rim = np.stack([np.full(len(rim), _RIM), rim], 1)
    return _turned(np.vstack([front, outline[1:17], rim, outline[17:-1], front[::-1] * (1, -1)]), 140)


def _hole() -> Any:
    t = np.linspace(-40, 40, 60)
    return _turned(np.stack([_hyperbola(t), t], 1), 80)


def _turned(profile: np.ndarray, around: int) -> Any:
    """Turn a profile of radius and place about the axis, and close its ends."""
    angle = 2 * np.pi * np.arange(around) / around
    x, y = profile[:, :1] * np.cos(angle), profile[:, :1] * np.sin(angle) + _AXIS
    rings = np.stack([x, y, np.broadcast_to(profile[:, 1:], x.shape)], -1)
    ends = [wheel(ring[None], ring.mean(0), angle) for ring in rings[[0, -1]]]
    wall = tube(rings, np.arange(around + 1.0), np.arange(len(rings), dtype=float))
    return solid(joined([wall, flipped(ends[0]), ends[1]]))


def _cut(step: float) -> Any:
    """Sweep an arch along z, in faces as long as a step."""
    a = np.linspace(0, np.pi, int(np.pi * _ARCH / step) + 1)
    arch = _ARCH * np.stack([np.cos(a), np.sin(a)], 1)
    gate = np.vstack([[[_ARCH, -10]], arch, [[-_ARCH, -10]]])
    places = np.linspace(-60, 60, int(120 / step) + 1)
    rings = np.stack([np.insert(gate, 2, z, axis=1) for z in places])
    ends = [
        wheel(ring[None], ring.mean(0), np.arange(len(gate)) * 2 * np.pi / len(gate))
        for ring in rings[[0, -1]]
    ]
    wall = tube(rings, np.arange(len(gate) + 1.0), places)
    return solid(joined([wall, flipped(ends[0]), ends[1]]))


def _rim() -> np.ndarray:
    """Half the outline of a disc on edge, its corners rounded; (distance from the axis, along it)."""
    a = np.linspace(-np.pi / 2, 0, 16)
    corner = np.stack([_RIM - _SOFT + _SOFT * np.cos(a), -_THICK + _SOFT + _SOFT * np.sin(a)], 1)
    return np.vstack([[[0, -_THICK]], corner, corner[::-1] * (1, -1), [[0, _THICK]]])


def _hyperbola(t: np.ndarray) -> np.ndarray:
    return np.sqrt(_WAIST**2 + (_FLARE * t) ** 2)


def _on_base(X: np.ndarray) -> np.ndarray:
    """Lay top and bottom flat as they are, and roll the side out; corners (m, 3, 3) to (m, 3, 2)."""
    N = np.cross(X[:, 1] - X[:, 0], X[:, 2] - X[:, 0])
    lid = np.abs(N[:, 1]) > 0.9 * np.linalg.norm(N, axis=1)
    above = lid & (N[:, 1] > 0)
    uv = np.stack([_around_base(X), X[..., 1]], -1)
    uv[lid] = X[lid][..., [0, 2]] + [500.0, 0.0]
    uv[above] += [0.0, 200.0]
    return uv


def _around_base(X: np.ndarray) -> np.ndarray:
    """Give the way around the base's outline to corners (m, 3, 3), from the middle of its back."""
    x, z = _LENGTH / 2 - _CORNER, _DEPTH / 2 - _CORNER

    def way(P: np.ndarray) -> np.ndarray:
        side = np.abs(P[..., 0])
        bend = np.arctan2(np.maximum(side - x, 0), np.abs(P[..., 2]) - z)  # 0 behind, half pi at the end
        back = np.minimum(side, x) + _CORNER * np.clip(bend, 0, np.pi / 2)
        quarter = x + _CORNER * np.pi / 2 + z
        flat = z - np.minimum(np.abs(P[..., 2]), z)
        far = np.where(
            np.abs(P[..., 2]) < z, quarter - z + flat, np.where(side > x, back, np.minimum(side, x))
        )
        far = np.where(P[..., 2] > 0, 2 * quarter - far, far)
        return np.where(P[..., 0] < 0, -far, far)

    return _unwrapped(way(X), way(X.mean(1)), 4 * (x + _CORNER * np.pi / 2 + z))


def _on_disc(X: np.ndarray) -> np.ndarray:
    """Give the way around the disc, and that from its front over the rim to its back."""
    r, z = np.hypot(X[..., 0], X[..., 1] - _AXIS), X[..., 2]
    inner, bend = _RIM - _SOFT, np.arctan2(np.abs(z) - (_THICK - _SOFT), r - (_RIM - _SOFT))
    rim = _THICK - _SOFT
    way = np.where(r > inner, rim + _SOFT * bend, rim + _SOFT * np.pi / 2 + inner - r)
    way = np.where(np.abs(z) < rim, np.abs(z), way)
    a = np.linspace(0, np.pi / 2, 30)
    ways = np.concatenate([[0], rim + _SOFT * a, rim + _SOFT * np.pi / 2 + np.linspace(0.5, 25, 50)])
    radii = np.concatenate([[_RIM], inner + _SOFT * np.cos(a), inner - np.linspace(0.5, 25, 50)])
    v, mean = _shortened(ways, radii)
    return np.stack([mean * _angle(X), np.sign(z) * np.interp(way, ways, v)], -1)


def _in_hole(X: np.ndarray) -> np.ndarray:
    """Give the way around the hole, and that through it."""
    t = np.linspace(0, 30, 200)
    ways = np.append(0.0, np.cumsum(np.hypot(np.diff(t), np.diff(_hyperbola(t)))))
    v, mean = _shortened(ways[t < _DEPTH / 2], _hyperbola(t)[t < _DEPTH / 2])
    z = X[..., 2]
    return np.stack([-mean * _angle(X), np.sign(z) * np.interp(np.abs(z), t[: len(v)], v)], -1)


def _under_arch(X: np.ndarray) -> np.ndarray:
    """Roll the arch out."""
    return np.stack([_ARCH * np.arctan2(X[..., 1], X[..., 0]), X[..., 2]], -1)


def _angle(X: np.ndarray) -> np.ndarray:
    """Give the angle about the axis to corners (m, 3, 3), cut open below."""

    def angle(P: np.ndarray) -> np.ndarray:
        return np.arctan2(P[..., 0], P[..., 1] - _AXIS)

    return _unwrapped(angle(X), angle(X.mean(1)), 2 * np.pi)


def _unwrapped(corners: np.ndarray, middle: np.ndarray, period: float) -> np.ndarray:
    """Keep corners (m, 3) on the side of the cut where the middle of their face is."""
    return corners - period * np.rint((corners - middle[:, None]) / period)


def _shortened(way: np.ndarray, radius: np.ndarray) -> tuple[np.ndarray, float]:
    """Give v for a turned outline, shorter where it is wide, and the radius that stands for u."""
    step = np.diff(way)
    middle = (radius[1:] + radius[:-1]) / 2
    mean = float((middle * step).sum() / step.sum())
    return np.append(0.0, np.cumsum(step * (mean / middle) ** _EVEN)), mean
