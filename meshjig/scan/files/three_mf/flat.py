"""Triangles that name a corner twice, which lib3mf refuses whole files for."""

from __future__ import annotations

import io
import re
import zipfile

__all__ = ["without_flat_triangles"]

_TRIANGLE = re.compile(rb"<(?:\w+:)?triangle\b[^>]*?(?:/>|>\s*</(?:\w+:)?triangle\s*>)")
_CORNER = re.compile(rb"""\bv[123]\s*=\s*["']\s*(\d+)""")


def without_flat_triangles(archive: zipfile.ZipFile) -> tuple[bytes, int]:
    """Write a 3MF again without triangles that name a corner twice.

    Parameters
    ----------
    archive : zipfile.ZipFile

    Returns
    -------
    data : bytes, of the new file
    count : int, how many triangles were left out
    """
    count = 0

    def kept(match: re.Match[bytes]) -> bytes:
        nonlocal count
        corners = _CORNER.findall(match[0])
        if len(corners) == 3 and len(set(corners)) < 3:
            count += 1
            return b""
        return match[0]

    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_STORED) as mended:
        for name in archive.namelist():
            data = archive.read(name)
            mended.writestr(name, _TRIANGLE.sub(kept, data) if name.lower().endswith(".model") else data)
    return buffer.getvalue(), count
