"""OBJ files: polygons by absolute or relative numbers, colours of vertices, materials with pictures."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from meshjig.errors import InputError
from meshjig.mesh.arrays import Floats, Ints, starts
from meshjig.scan.files.attachments import PictureReader
from meshjig.scan.files.file_mesh import FileMesh
from meshjig.scan.files.obj_materials import look_of_materials
from meshjig.scan.files.surface import Surface, levels, surface
from meshjig.scan.files.words import NONE, Lines, plain, table
from meshjig.scan.source import Look, Source

__all__ = ["read_obj"]

_MOST = 0.5  # of the vertices; where more have colours, the others are white
_UNUSED = 0.1  # of the vertices; more of them in no face are told, any where the last line has no end


def read_obj(path: Path, pictures: PictureReader) -> FileMesh:
    """Read an OBJ file.

    Parameters
    ----------
    path : Path
    pictures : PictureReader

    Returns
    -------
    FileMesh
        A face shows the picture of its material, else the colours of its vertices, else the colour of its
        material.

    Raises
    ------
    InputError
        It is no text, or cut off, or names a pipe or a device.
    """
    data = path.read_bytes()
    text = plain(data)
    ended = data.rstrip(b"\0 ")[-1:] in (b"\n", b"\r")
    _check_text(path, text, ended)
    if b"\\\n" in text:
        text = re.sub(rb"\\[ \t]*\n", b" ", text)
    lines = Lines(text)
    V, rgb = _vertices(lines)
    faces = lines.starting(b"f", b"fo")
    sizes, corners, places = _corners(lines, faces)
    made = surface(V, corners, sizes)
    uv = _uv(lines, made, places)
    colours = None if rgb is None else levels(rgb)[made.F]
    look, notes = look_of_materials(path, lines, pictures, faces[made.polygon], Look(rgb=colours, uv=uv))
    if len(lines.starting(b"surf", b"curv")):
        notes.append("the file has free-form curves or surfaces, which are left out: export them as faces")
    used = np.zeros(len(V), bool)
    used[made.F] = True
    unused = int(len(V) - used.sum())
    if len(faces) and unused > _UNUSED * len(V) * ended:
        notes.append(
            f"{unused} of its {len(V)} vertices belong to no face: it may be cut off, OBJ does not tell"
        )
    return FileMesh(Source(V, made.F, look), "meshjig", notes, len(faces), made.found)


def _check_text(path: Path, text: bytes, ended: bool) -> None:
    """Refuse what is no text, or ends, without the end of a line, in half a vertex or half a face."""
    if b"\0" in text:
        raise InputError(
            f"{path} is damaged: OBJ is a format of text, and it holds none", hint="export it again"
        )
    line = text[text.rfind(b"\n", 0, len(text) - 1) + 1 :].split(b"#")[0].split()
    if not ended and line and line[0] in (b"v", b"f") and len(line) < 4:
        last = b" ".join(line).decode(errors="replace")
        raise InputError(
            f"{path} is cut off: its last line, '{last}', is not whole", hint="copy or export it again"
        )


def _vertices(lines: Lines) -> tuple[Floats, Floats | None]:
    """The vertices (n, 3), and their colours (n, 3) where most have some, or a table of its own has them."""
    rows = lines.only(lines.starting(b"v"), without=1)
    values, sizes = rows.floats(), rows.sizes
    if len(sizes) and (sizes >= 6).mean() > _MOST:
        both = table(values, sizes, 6)
        return both[:, :3].copy(), both[:, 3:]
    return table(values, sizes, 3).copy(), _painted(lines, len(sizes))


def _painted(lines: Lines, n: int) -> Floats | None:
    """Colours of vertices as ZBrush writes them: lines of hexadecimal numbers, eight digits a vertex."""
    some = lines.starting(b"#MRGB")
    digits = "".join(lines.rest(int(k)) for k in some)
    if not len(some) or len(digits) != 8 * n or not re.fullmatch("[0-9a-fA-F]*", digits):
        return None
    return np.frombuffer(bytes.fromhex(digits), np.uint8).reshape(-1, 4)[:, 1:] / 255.0


def _corners(lines: Lines, faces: Ints) -> tuple[Ints, Ints, Ints | None]:
    """How many corners each face has (f,), their vertices (c,) and texture coordinates (c,), -1 for none."""
    first = lines.only(faces, without=1)
    sizes = first.sizes
    before = np.repeat(_before(lines, b"v", faces), sizes)
    if b"/" not in first.text:
        return sizes, _counted(first.integers(), before), None
    text = first.text.replace(b"//", b"/0/")
    numbers = Lines(re.sub(rb"/(?=\s)", b"/0", text) if re.search(rb"/\s", text) else text)
    parts = numbers.slashes() + 1
    values = Lines(numbers.text.replace(b"/", b" ")).integers()
    if len(values) != parts.sum():  # a slash where a number begins: no corner that makes sense
        return sizes, np.full(int(sizes.sum()), -1), None
    at = starts(parts)
    second = np.where(parts > 1, values[np.minimum(at + 1, len(values) - 1)], 0)
    textures = np.repeat(_before(lines, b"vt", faces), sizes)
    return sizes, _counted(values[at], before), _counted(second, textures)


def _before(lines: Lines, name: bytes, faces: Ints) -> Ints:
    """How many lines of a kind stand before each face: what relative numbers are counted from."""
    return np.searchsorted(lines.starting(name), faces)


def _counted(numbers: Ints, before: Ints) -> Ints:
    """Places counted from 0; -1 for numbers that name nothing."""
    return np.where(
        numbers > 0, numbers - 1, np.where((numbers < 0) & (numbers != NONE), numbers + before, -1)
    )


def _uv(lines: Lines, made: Surface, places: Ints | None) -> Floats | None:
    """The texture coordinates of the corners of triangles, (m, 3, 2), NaN where there are none."""
    if places is None or not len(made.F):
        return None
    rows = lines.only(lines.starting(b"vt"), without=2)
    UV = table(rows.floats(), rows.sizes, 2)
    UV[:, 1] = np.where(rows.sizes == 1, 0.0, UV[:, 1])
    at = places[made.corner]
    known = (at >= 0) & (at < len(UV))
    if not known.any():
        return None
    uv = np.full((*at.shape, 2), np.nan)
    uv[known] = UV[at[known]]
    uv[~np.isfinite(uv).all(axis=(1, 2))] = np.nan
    return uv
