"""Colours for pieces: pleasant, all different, and clearly so between neighbours."""

import numpy as np

from meshjig.mesh.arrays import Floats, Ints

__all__ = ["colours", "oklab", "to_linear", "to_srgb"]


_PALETTE = (
    "F28482 3F7FCF F7C948 3DAA7D C3A6F0 C56B45 5CC8D7 D1457B B5D56A 5B5FC7 F6A04D "
    "2A9D8F F29CC3 6FB1F0 D9534F A5E0C0 8F6BD1 E3C59B 6BBF59 C46BC0 6C8EA8 B5D8F5"
)
_CLEAR = 0.17  # a distance in OKLab that nobody overlooks

_TO_LMS = np.array(
    [
        [0.4122214708, 0.5363325363, 0.0514459929],
        [0.2119034982, 0.6806995451, 0.1073969566],
        [0.0883024619, 0.2817188376, 0.6299787005],
    ]
)
_TO_LAB = np.array(
    [
        [0.2104542553, 0.7936177850, -0.0040720468],
        [1.9779984951, -2.4285922050, 0.4505937099],
        [0.0259040371, 0.7827717662, -0.8086757660],
    ]
)


def colours(n: int, neighbours: Ints | None = None) -> Floats:
    """Choose a colour for each piece.

    Each piece in turn, those with most neighbours first, takes from a small palette what is clearly
    unlike its neighbours and seldom used so far; a slight shift of its own sets it apart from all others.

    Parameters
    ----------
    n : int, pieces
    neighbours : (k, 2) int64, pairs of pieces that touch

    Returns
    -------
    (n, 3) float64, sRGB, 0 to 1. Equal input gives equal colours.
    """
    lab = oklab(_palette())
    apart = np.linalg.norm(lab[:, None] - lab[None], axis=2)
    around = _neighbours_of(n, neighbours)
    choice = np.full(n, -1)
    turn = np.zeros(n)
    used = np.zeros(len(lab))
    for piece in sorted(range(n), key=lambda i: (-len(around[i]), i)):
        taken = choice[around[piece]]
        taken = taken[taken >= 0]
        nearest = apart[taken].min(axis=0) if len(taken) else np.full(len(lab), _CLEAR)
        best = int(np.argmax(np.minimum(nearest, _CLEAR) - 0.3 * _CLEAR * used / (1 + used.max())))
        choice[piece], turn[piece] = best, used[best]
        used[best] += 1
    return _srgb(_shifted(lab[choice], turn))


def oklab(rgb: Floats) -> Floats:
    """Take sRGB colours (n, 3), 0 to 1, to OKLab, where equal distances look equally large.

    References
    ----------
    Ottosson, "A perceptual color space for image processing", 2020.
    """
    return np.cbrt(to_linear(rgb) @ _TO_LMS.T) @ _TO_LAB.T


def _palette() -> Floats:
    return np.array([list(bytes.fromhex(code)) for code in _PALETTE.split()]) / 255


def _shifted(lab: Floats, turn: Floats) -> Floats:
    """Move the k-th user of a palette colour a little: a low-discrepancy walk, so that no two meet."""
    walk = (turn[:, None] * [0.8191725134, 0.6710436067, 0.5497004779]) % 1 - 0.5
    return lab + np.where(turn[:, None] > 0, walk * [0.06, 0.03, 0.03], 0)


def _srgb(lab: Floats) -> Floats:
    return to_srgb((lab @ np.linalg.inv(_TO_LAB).T) ** 3 @ np.linalg.inv(_TO_LMS).T)


def _neighbours_of(n: int, pairs: Ints | None) -> list[Ints]:
    if pairs is None or not len(pairs):
        return [np.empty(0, np.int64)] * n
    both = np.concatenate([pairs, pairs[:, ::-1]])
    both = both[np.argsort(both[:, 0], kind="stable")]
    return np.split(both[:, 1], np.searchsorted(both[:, 0], np.arange(1, n)))


def to_linear(srgb: Floats) -> Floats:
    """Take sRGB values, 0 to 1, to linear light."""
    return np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)


def to_srgb(linear: Floats) -> Floats:
    """Take linear light to sRGB values, 0 to 1; what a screen can't show is clipped."""
    x = np.clip(linear, 0, 1)
    return np.where(x <= 0.0031308, 12.92 * x, 1.055 * x ** (1 / 2.4) - 0.055)
