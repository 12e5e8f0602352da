"""Give a mesh, whose file knows no units, its size in millimetres."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from meshjig.mesh.types import Floats

__all__ = ["Scaled", "to_millimetres"]

_PLAUSIBLE = (20.0, 500.0)  # mm; a model of such extent was most likely made in mm
_DEFAULT = 150.0  # mm
_FLOAT32 = 1e-6  # a model of 500 mm may come back from a file with 500.00002
_FAR = 1000.0  # mm from the origin, where the float32 of an STL file is down to 0.0001


class Scaled(NamedTuple):
    """Vertices in mm and how they came to be."""

    V: Floats  # (n, 3), mm
    to_source: Floats  # (4, 4), takes them back
    facts: dict[str, Any]


def to_millimetres(V: Floats, size: float | None = None) -> Scaled:
    """Scale a model to its size in mm, and bring it near the origin if it is far away.

    Parameters
    ----------
    V : (n, 3) float64, in the units of the source
    size : float, mm, the largest extent. None: extents of 20 to 500 are taken as mm, and other models
        are scaled to 150 mm.

    Returns
    -------
    Scaled
        facts holds ``scale``, ``size_mm`` [x, y, z], ``units`` (the rule that applied) and
        ``moved_mm`` [x, y, z], or None when the model stayed where it was.
    """
    low, high = V.min(axis=0), V.max(axis=0)
    extent = float((high - low).max())
    if size is not None:
        scale, units = size / extent, f"largest extent set to {size:g} mm as asked"
    elif _PLAUSIBLE[0] * (1 - _FLOAT32) <= extent <= _PLAUSIBLE[1] * (1 + _FLOAT32):
        scale, units = 1.0, f"largest extent {extent:g} taken as mm"
    else:
        scale, units = (
            _DEFAULT / extent,
            f"largest extent {extent:g} is unlikely in mm: scaled to {_DEFAULT:g} mm",
        )
    far = max(np.abs(low).max(), np.abs(high).max()) * scale > max(_FAR, 2 * extent * scale)
    shift = -(low + high) / 2 if far else np.zeros(3)
    to_source = np.eye(4)
    to_source[:3, :3] /= scale
    to_source[:3, 3] = -shift
    facts = {
        "scale": scale,
        "size_mm": ((high - low) * scale).tolist(),
        "units": units,
        "moved_mm": (shift * scale).tolist() if far else None,
    }
    return Scaled((V + shift) * scale, to_source, facts)
