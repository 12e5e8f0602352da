"""Materials of OBJ files: colours and pictures by names."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from meshjig.mesh.arrays import Floats
from meshjig.scan.files.words import Lines, plain

__all__ = ["Material", "Picture", "parse_mtl"]

_NUMBERS = {"-o": 3, "-s": 3, "-t": 3, "-mm": 2}  # how many may follow an option; others have one word
_NUMBER = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?$")


@dataclass(frozen=True)
class Picture:
    """A picture that a material shows, and how."""

    name: str  # as it stands in the file
    scale: tuple[float, float] = (1.0, 1.0)
    offset: tuple[float, float] = (0.0, 0.0)
    clamp: bool = False  # whether it does not repeat
    named_by: Path | None = None  # the file of materials

    def place(self, uv: Floats) -> Floats:
        """Give the places in the picture of texture coordinates (..., 2)."""
        if self.scale == (1.0, 1.0) and self.offset == (0.0, 0.0) and not self.clamp:
            return uv
        placed: Floats = uv * self.scale + self.offset
        return np.clip(placed, 0, 1) if self.clamp else placed


@dataclass
class Material:
    """What a material says of colour."""

    colour: tuple[float, float, float] | None = None  # 0 to 1
    pictures: dict[str, Picture] = field(default_factory=dict)  # by what they stand for: map_kd, map_ka

    @property
    def picture(self) -> Picture | None:
        """The picture of the surface's own colour."""
        return self.pictures.get("map_kd") or self.pictures.get("map_ka")


def parse_mtl(data: bytes, path: Path | None = None) -> dict[str, Material]:
    """Read a file of materials, by name.

    Parameters
    ----------
    data : bytes
    path : Path, optional
        Of the file; pictures are looked for beside it.

    Returns
    -------
    dict of str to Material, what is not understood left out
    """
    materials: dict[str, Material] = {}
    current = Material()
    lines = Lines(plain(data))
    for k in range(len(lines)):
        key, _, rest = lines.line(k).replace("\t", " ").partition(" ")
        key, rest = key.lower(), rest.strip()
        if key == "newmtl":
            current = materials.setdefault(rest, Material())
        elif key == "kd":
            numbers = [float(word) for word in rest.split() if _NUMBER.match(word)]
            if numbers:
                red, green, blue = (numbers * 3)[:3] if len(numbers) < 3 else numbers[:3]
                current.colour = (red, green, blue)
        elif key in ("map_kd", "map_ka") and rest:
            current.pictures[key] = _picture(rest, path)
    return materials


def _picture(text: str, path: Path | None) -> Picture:
    """Take apart a line such as ``-s 2 2 1 -clamp on wood grain.png``."""
    scale, offset, clamp = (1.0, 1.0), (0.0, 0.0), False
    while text.startswith("-"):
        option, _, after = text.partition(" ")
        if not after:
            break  # a name that begins so
        words = after.split()
        most = _NUMBERS.get(option, 1)
        count = 0
        while count < min(most, len(words) - 1) and (most == 1 or _NUMBER.match(words[count])):
            count += 1
        values = [float(word) for word in words[:count] if _NUMBER.match(word)]
        if option == "-s" and values:
            scale = (values[0], values[1] if len(values) > 1 else 1.0)
        elif option == "-o" and values:
            offset = (values[0], values[1] if len(values) > 1 else 0.0)
        elif option == "-clamp":
            clamp = words[0].lower() == "on"
        text = [*after.split(None, count), ""][count] if count else after
    return Picture(text.strip("\"' "), scale, offset, clamp, path)
