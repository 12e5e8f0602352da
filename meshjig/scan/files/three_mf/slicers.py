"""What projects of slicers keep beside the standard: parts that are not to be printed, and paint."""

from __future__ import annotations

import zipfile
from typing import NamedTuple
from xml.etree import ElementTree

__all__ = ["Leftout", "left_out", "mentions_paint"]

_BAMBU = "metadata/model_settings.config"  # of Bambu Studio and OrcaSlicer
_PRUSA = "metadata/slic3r_pe_model.config"  # of PrusaSlicer and SuperSlicer
_PAINT = (b" paint_color=", b" slic3rpe:mmu_segmentation=")


class Leftout(NamedTuple):
    """Parts of a project that shape others, or the print, and are none themselves."""

    parts: set[tuple[int, int]]  # (an object, a component of it), by their numbers in the model
    ranges: dict[int, list[tuple[int, int]]]  # of an object's triangles, first and last


def left_out(archive: zipfile.ZipFile) -> Leftout:
    """List the modifiers, holes and blockers of a project; none for a file that is no project."""
    found = Leftout(set(), {})
    for name in archive.namelist():
        if name.lower() not in (_BAMBU, _PRUSA):
            continue
        try:
            root = ElementTree.fromstring(archive.read(name))
        except (ElementTree.ParseError, ValueError):
            continue
        for thing in root.iter("object"):
            number = _number(thing.get("id"))
            for part in thing.iter("part"):
                if part.get("subtype", "normal_part") != "normal_part":
                    found.parts.add((number, _number(part.get("id"))))
            for volume in thing.iter("volume"):
                if _is_helper(volume):
                    ends = _number(volume.get("firstid")), _number(volume.get("lastid"))
                    found.ranges.setdefault(number, []).append(ends)
    return found


def mentions_paint(archive: zipfile.ZipFile) -> bool:
    """Tell whether triangles have colours in a slicer's own form."""
    models = (name for name in archive.namelist() if name.lower().endswith(".model"))
    return any(mark in text for text in map(archive.read, models) for mark in _PAINT)


def _is_helper(volume: ElementTree.Element) -> bool:
    said = {entry.get("key"): entry.get("value") for entry in volume.iter("metadata")}
    return said.get("volume_type", "ModelPart") != "ModelPart" or said.get("modifier") == "1"


def _number(text: str | None) -> int:
    return int(text) if text and text.isdigit() else -1
