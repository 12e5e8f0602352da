"""Binary STL, written in one go."""

from pathlib import Path

import numpy as np

from meshjig.mesh.types import Floats, Ints

__all__ = ["write_stl"]

_FACET = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


def write_stl(path: Path, V: Floats, F: Ints, name: str = "") -> None:
    """Write a mesh as binary STL.

    Parameters
    ----------
    path : Path
    V : (n, 3) float64, mm; pass it through ``printable`` first if the file is to be printed
    F : (m, 3) int64
    name : str, stands in the header beside the unit, which the format itself does not have
    """
    facets = np.zeros(len(F), _FACET)
    corners = V.astype(np.float32)[F]
    facets["corners"] = corners
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]).astype(np.float64)
    facets["normal"] = normal / np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-30)
    header = f"meshjig, units: mm, {name}".encode("ascii", "replace")[:80].ljust(80)
    with path.open("wb") as file:
        file.write(header + len(F).to_bytes(4, "little"))
        file.write(facets.tobytes())
