"""Closed solids with thin parts, in mm: evenly meshed, oriented outward, one component each."""

import numpy as np

from tests.meshes import Shape
from tests.thin.net import either, net, revolved, rounded

__all__ = ["SHAPES", "cup", "ear", "hand", "hem", "mask", "plate", "rod_on_ball", "thin_torus", "two_plates"]


def plate(long: float = 80.0, wide: float = 60.0, thick: float = 3.0, cell: float = 1.5) -> Shape:
    """A flat plate along z = 0 with rounded edges and corners."""

    def value(P):
        return _plate(P, [long / 2, wide / 2], thick, 8.0)

    return net(value, [-long / 2, -wide / 2, -thick], [long / 2, wide / 2, thick], cell)


def rod_on_ball(ball: float = 30.0, thick: float = 4.0, long: float = 40.0, cell: float = 1.7) -> Shape:
    """A ball around the origin with a round rod on top, a fillet between them."""

    def value(P):
        rod = _capsule(P, [0, 0, 0], [0, 0, ball + long - thick / 2], [thick / 2, thick / 2])
        return either(np.linalg.norm(P, axis=1) - ball, rod, 3.0)

    return net(value, [-ball] * 3, [ball, ball, ball + long], cell)


def cup(radius: float = 30.0, height: float = 60.0, wall: float = 2.5, edge: float = 2.1) -> Shape:
    """A cup that stands on z = 0, open above, rounded along its floor and its rim."""
    below, r = 6.0, wall / 2
    turn = np.linspace(0, np.pi / 2, 6)
    foot = np.stack([radius - below + below * np.sin(turn), below - below * np.cos(turn)], 1)
    over = np.linspace(0, np.pi, 5)
    rim = np.stack([radius - r + r * np.cos(over), height - r + r * np.sin(over)], 1)
    inner = np.stack(
        [radius - below + (below - wall) * np.sin(turn), below - (below - wall) * np.cos(turn)], 1
    )
    corners = [np.array([[0.0, 0.0]]), foot, rim, inner[::-1], np.array([[0.0, wall]])]
    return revolved(_filled(np.concatenate(corners), edge), edge)


def mask(wide: float = 40.0, high: float = 52.0, deep: float = 16.0, thick: float = 2.5, cell=1.05) -> Shape:
    """Half an ellipsoid's shell that faces +z, with two holes for the eyes, and a nose."""
    size = np.array([wide / 2, high / 2, deep])

    def value(P):
        face = _ellipsoid(P, size)
        nose = _capsule(P, [0, 5, deep - 3], [0, -5, deep + 1], [1.5, 3.2])
        face = either(face, nose, 3.0)
        shell = rounded(face - thick / 2, -face - thick / 2, 0.0)
        shell = rounded(shell, -P[:, 2] - 0.4, 1.2)
        for side in (-1, 1):
            eye = np.hypot((P[:, 0] - side * wide / 4.6) / 1.4, P[:, 1] - high / 9) - 2.8
            shell = rounded(shell, -eye, 1.2)
        return shell

    return net(value, [-size[0] - thick, -size[1] - thick, -1], [*(size[:2] + thick), deep + 10], cell)


def ear(thick: float = 10.0, tip: float = 1.0, high: float = 32.0, wide: float = 26.0, cell=0.95) -> Shape:
    """A wedge with a round outline that stands on a thick block, and thins out upward."""

    def value(P):
        half = (thick + (tip - thick) * np.clip(P[:, 2] / high, -0.3, 1.5)) / 2
        side = np.abs(P[:, 1]) - half
        outline = np.hypot(P[:, 0] / (wide / 2), np.maximum(P[:, 2] - high / 3, 0) / (2 * high / 3)) - 1
        wedge = rounded(rounded(side, outline * wide / 2, 0.9 * half), -P[:, 2] - 8, 0.4)
        block = _box(P, [0, 0, -9], [18, 12, 9], 5.0)
        return either(block, wedge, 3.0)

    return net(value, [-18, -12, -18], [18, 12, high], cell)


def hand(palm: float = 18.0, thick: float = 7.0, tip: float = 4.0, cell: float = 1.5) -> Shape:
    """A palm along z = 0 with four fingers towards +y and a thumb, each thinning out to its tip."""
    root, end = thick / 2, tip / 2
    fingers = [([-18, 15, 0], [-23, 48, 0]), ([-6, 15, 0], [-8, 60, 0]), ([6, 15, 0], [8, 64, 0]),
               ([18, 15, 0], [23, 55, 0]), ([-16, -8, 0], [-44, 12, 0])]  # fmt: skip

    def value(P):
        solid = _box(P, [0, -2, 0], [23, 24, palm / 2], 8.0)
        for a, b in fingers:
            solid = either(solid, _capsule(P, a, b, [root, end]), 2.5)
        return solid

    return net(value, [-48, -27, -palm / 2], [26, 68, palm / 2], cell)


def thin_torus(thick: float = 4.0, radius: float = 30.0, cell: float = 1.0) -> Shape:
    """A thin ring around the z axis."""

    def value(P):
        return np.hypot(np.hypot(P[:, 0], P[:, 1]) - radius, P[:, 2]) - thick / 2

    out = radius + thick
    return net(value, [-out, -out, -thick], [out, out, thick], cell)


def two_plates(apart: float = 1.0, thick: float = 3.0, long: float = 40.0, wide: float = 30.0) -> Shape:
    """Two plates side by side, along x, that a thick block joins at one end."""
    middle = (apart + thick) / 2

    def value(P):
        both = np.minimum(
            *(_plate(P - [0, 0, z], [long / 2, wide / 2], thick, 5.0) for z in (-middle, middle))
        )
        return either(both, _box(P, [-long / 2 - 4, 0, 0], [9, wide / 2 + 3, 12], 5.0), 0.3)

    return net(value, [-long / 2 - 14, -wide / 2 - 3, -13], [long / 2, wide / 2 + 3, 13], apart)


def hem(thick: float = 3.0, apart: float = 2.0, cell: float = 1.25) -> Shape:
    """A plate that comes out of a thick block along +x and folds back over itself."""
    bend = (thick + apart) / 2

    def value(P):
        x, z = P[:, 0], P[:, 2]
        lower = np.hypot(x - np.clip(x, -10, 36), z)
        upper = np.hypot(x - np.clip(x, 14, 36), z - 2 * bend)
        turn = np.where(x > 36, np.abs(np.hypot(x - 36, z - bend) - bend), np.inf)
        sheet = np.minimum(np.minimum(lower, upper), turn) - thick / 2
        sheet = rounded(sheet, np.abs(P[:, 1]) - 15, 1.4)
        return either(_box(P, [-12, 0, 0], [12, 18, 12], 5.0), sheet, 1.5)

    return net(value, [-24, -18, -12], [36 + bend + thick, 18, 12], cell)


SHAPES = (plate, rod_on_ball, cup, mask, ear, hand, thin_torus, two_plates, hem)


def _plate(P, half, thick, corner):
    """A plate along z = 0, all its edges rounded."""
    q = np.abs(P[:, :2]) - (np.array(half) - corner)
    outline = np.linalg.norm(np.maximum(q, 0), axis=1) + np.minimum(q.max(1), 0) - corner
    return rounded(np.abs(P[:, 2]) - thick / 2, outline, 0.47 * thick)


def _box(P, middle, half, radius):
    q = np.abs(P - middle) - (np.array(half, float) - radius)
    return np.linalg.norm(np.maximum(q, 0), axis=1) + np.minimum(q.max(1), 0) - radius


def _capsule(P, a, b, radii):
    """A rod from a to b with round ends, its radius changing from one to the other."""
    a, b = np.array(a, float), np.array(b, float)
    t = np.clip((P - a) @ (b - a) / ((b - a) @ (b - a)), 0, 1)
    return np.linalg.norm(P - a - t[:, None] * (b - a), axis=1) - (radii[0] + t * (radii[1] - radii[0]))


def _ellipsoid(P, size):
    """The distance to an ellipsoid, exact to first order."""
    near = np.maximum(np.linalg.norm(P / size, axis=1), 1e-3)
    return near * (near - 1) / np.maximum(np.linalg.norm(P / size**2, axis=1), 1e-6)


def _filled(corners, edge):
    """Split the segments of a polyline to about a length."""
    length = np.linalg.norm(np.diff(corners, axis=0), axis=1)
    parts = [
        np.linspace(a, b, max(round(one / edge), 1), endpoint=False)
        for a, b, one in zip(corners[:-1], corners[1:], length, strict=True)
    ]
    return np.concatenate([*parts, corners[-1:]])
