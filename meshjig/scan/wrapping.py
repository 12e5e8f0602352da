"""Places beyond a picture, as the picture is meant to go on there."""

from __future__ import annotations

from typing import Literal

import numpy as np

from meshjig.mesh.arrays import Floats

__all__ = ["Wrap", "wrapped"]

Wrap = Literal["repeat", "clamp", "mirror"]


def wrapped(uv: Floats, ways: tuple[Wrap, Wrap]) -> Floats:
    """Bring places into a picture that does not repeat; where it repeats they stay.

    Parameters
    ----------
    uv : (..., 2) float64, in sizes of the picture
    ways : how it goes on along u and along v

    Returns
    -------
    (..., 2) float64
    """
    found = uv.copy()
    for axis, way in enumerate(ways):
        if way == "clamp":
            found[..., axis] = np.clip(uv[..., axis], 0, 1)
        elif way == "mirror":
            found[..., axis] = 1 - np.abs(uv[..., axis] % 2 - 1)
    return found
