"""Which extensions of 3MF are known here; a file may require others."""

from __future__ import annotations

import re
import zipfile

__all__ = ["unknown_extension"]

_BASE = "3dmanufacturing/"
_KNOWN = ("core", "material", "production", "slice", "beamlattice", "trianglesets", "volumetric", "implicit")
_HEAD = 1 << 16  # bytes; the tag of the model is within
_MODEL = re.compile(r"<(?:\w+:)?model\b[^>]*>")


def unknown_extension(archive: zipfile.ZipFile) -> str | None:
    """Give the address of an extension that a model of the package requires and that is not known."""
    for name in archive.namelist():
        if not name.lower().endswith(".model"):
            continue
        with archive.open(name) as file:
            tag = _MODEL.search(file.read(_HEAD).decode("utf-8", "replace"))
        words = dict(re.findall(r"""([\w:]+)\s*=\s*["']([^"']*)["']""", tag[0])) if tag else {}
        for prefix in words.get("requiredextensions", "").split():
            address = words.get(f"xmlns:{prefix}", prefix)
            if address.partition(_BASE)[2].split("/")[0] not in _KNOWN:
                return address
    return None
