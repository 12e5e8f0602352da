"""A small picture of a puzzle, for the page of a batch."""

from __future__ import annotations

import os
import uuid
from pathlib import Path

__all__ = ["FOLDER", "thumbnail", "thumbnail_name"]

FOLDER = "thumbnails"
_SIZE = (224, 224)  # pixels at most


def thumbnail_name(name: str) -> str:
    """Give where the picture of a scan is, below the folder of the batch."""
    return f"{FOLDER}/{name}.jpg"


def thumbnail(puzzle: Path, path: Path) -> bool:
    """Draw preview.png of a puzzle's folder small; tell whether there was one that can be read."""
    from PIL import Image

    scratch = path.with_name(f".{uuid.uuid4().hex[:12]}.jpg")
    try:
        with Image.open(puzzle / "preview.png") as picture:
            small = picture.convert("RGB")
        small.thumbnail(_SIZE)
        path.parent.mkdir(parents=True, exist_ok=True)
        small.save(scratch, quality=80)
        os.replace(scratch, path)
    except (OSError, ValueError, Image.DecompressionBombError):
        scratch.unlink(missing_ok=True)
        return False
    return True
