"""A mesh as it came: vertices, triangles, what its faces show, and what its file says of unit and axes."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from meshjig.mesh.arrays import Bools, Floats, Ints

__all__ = ["Axis", "Look", "Source", "Unit"]

Axis = Literal["x", "y", "z"]
Pixels = NDArray[np.uint8]


class Unit(NamedTuple):
    """What a file says of its unit."""

    mm: float
    name: str  # "m"
    binding: bool  # whether it holds whatever the model's extent; else only where that is plausible


@dataclass(frozen=True)
class Look:
    """What the corners of faces show: a place in the picture where there is one, else a colour.

    UVs can be there without a picture. All are None for a mesh that shows nothing.
    """

    rgb: NDArray[np.uint8] | None = None  # (m, 3, 3), sRGB, a colour a corner
    uv: Floats | None = None  # (m, 3, 2), in sizes of the picture, v upward; NaN for a face without
    picture: Pixels | None = None  # (height, width, 3), sRGB
    sizes: tuple[tuple[int, int], ...] = ()  # width, height of the pictures that it was joined of, if it was

    def of(self, faces: Bools | Ints) -> Look:
        """Give what some of the faces show."""
        rgb = None if self.rgb is None else self.rgb[faces]
        return replace(self, rgb=rgb, uv=None if self.uv is None else self.uv[faces])

    def turned(self) -> Look:
        """Give the same for faces whose corners come in the opposite order."""
        rgb = None if self.rgb is None else self.rgb[:, ::-1]
        return replace(self, rgb=rgb, uv=None if self.uv is None else self.uv[:, ::-1])

    @property
    def picture_sizes(self) -> tuple[tuple[int, int], ...]:
        """Width and height of the pictures that the mesh came with."""
        if self.sizes or self.picture is None:
            return self.sizes
        return ((self.picture.shape[1], self.picture.shape[0]),)

    def describe(self) -> str:
        """Say in a few words what the mesh brings; "none" where that is nothing."""
        if self.picture is not None:
            sizes = self.picture_sizes
            width, height = max(sizes, key=lambda size: size[0] * size[1])
            many = f"{len(sizes)} textures, the largest" if len(sizes) > 1 else "a texture"
            return f"{many} of {width} x {height} pixels"
        if self.rgb is None:
            return "none" if self.uv is None else "none, but UVs"
        rgb = self.rgb.reshape(-1, 3)
        if len(rgb) and (rgb == rgb[0]).all():
            return "one colour: #{:02x}{:02x}{:02x}".format(*rgb[0].tolist())
        return "a colour a face" if (self.rgb == self.rgb[:, :1]).all() else "a colour a vertex"


@dataclass(frozen=True)
class Source:
    """A mesh as it came."""

    vertices: Floats  # (n, 3), in the units of the file
    faces: Ints  # (m, 3)
    look: Look = Look()
    unit: Unit | None = None  # None where the file says nothing
    up: Axis | None = None  # the axis that points upward; None where the file says nothing
