"""How large a mesh is in millimetres, which few files say, and how many faces it keeps."""

from __future__ import annotations

import math
from dataclasses import dataclass
from numbers import Real
from typing import Any, NamedTuple

import numpy as np

from meshjig.errors import InputError, OptionError
from meshjig.mesh.arrays import Floats, Ints
from meshjig.mesh.halfedges import compact
from meshjig.scan.collapse import collapse_fast
from meshjig.scan.manifold import is_clean
from meshjig.scan.preparation import UnitName
from meshjig.scan.repair import repair
from meshjig.scan.source import Unit

__all__ = [
    "ScaleFacts",
    "Scaled",
    "choose_scale",
    "decimate",
    "import_pymeshlab",
    "in_millimetres",
    "refuse_size",
    "to_millimetres",
]

UNITS = {"mm": 1.0, "cm": 10.0, "m": 1000.0, "inch": 25.4}  # in mm


_PLAUSIBLE = (20.0, 500.0)  # mm; a model of such extent was most likely made in mm
_DEFAULT = 150.0  # mm
_FLOAT32 = 1e-6  # a model of 500 mm may come back from a file with 500.00002
_SHOWN = 40  # letters of a wrong value in a sentence
_FINE = 500_000  # faces; meshes of more are thinned out first, which takes a tenth of the time
_THINNED = 1.5  # times as many faces as asked for are left then
_SHARE = 1.5  # at least so many times that are there before: else it is not worth it
_FAR = 1000.0  # mm from the origin, where the float32 of an STL file is down to 0.0001

_PACKAGES = {
    "libOpenGL.so": "libopengl0",
    "libGLU.so": "libglu1-mesa",
    "libEGL.so": "libegl1",
    "libGL.so": "libgl1",
}


@dataclass(frozen=True)
class ScaleFacts:
    """How a mesh came to its size."""

    scale: float
    size_mm: list[float]  # along x, y, z
    units: str  # the rule that applied
    moved_mm: list[float] | None  # None when it stayed where it was


class Scaled(NamedTuple):
    """Vertices in mm and how they came to be."""

    V: Floats  # (n, 3), mm
    to_source: Floats  # (4, 4), takes them back
    facts: ScaleFacts


def to_millimetres(
    V: Floats, size: float | None = None, unit: UnitName = "auto", said: Unit | None = None
) -> Scaled:
    """Scale a model to its size in mm, and bring it near the origin if it is far away.

    Parameters
    ----------
    V : (n, 3) float64, in the units of the source
    size : float, mm, the largest extent; it goes before all units
    unit : "mm", "cm", "m", "inch" or "auto"
        Of V; "auto": what the file says, where that holds; else extents of 20 to 500 are taken as mm, and
        other models are scaled to 150 mm.
    said : Unit, optional
        What the file says. One that is not binding holds where it gives 20 to 500 mm; elsewhere the model is
        scaled to 150 mm.

    Returns
    -------
    Scaled

    Raises
    ------
    OptionError
        The size is no length.
    """
    refuse_size(size)
    return in_millimetres(V, *choose_scale(V, size, unit, said))


def refuse_size(size: Any) -> None:
    """Refuse what is neither None nor a length in mm.

    Raises
    ------
    OptionError
        It is no number, or not a finite one above 0.
    """
    if size is None:
        return
    shown = repr(size) if len(repr(size)) < _SHOWN else f"a {type(size).__name__}"
    if isinstance(size, bool | np.bool_) or not isinstance(size, Real):
        raise OptionError(f"size: {shown} is no number", hint="give the largest extent, in mm", option="size")
    try:
        length = float(size)
    except OverflowError:
        length = math.inf
    if not 0 < length < math.inf:
        raise OptionError(f"size: {shown} is no length", hint="give more than 0 mm", option="size")


def choose_scale(
    V: Floats, size: float | None = None, unit: UnitName = "auto", said: Unit | None = None
) -> tuple[float, str]:
    """Give the mm of a source's unit, and why it is that; see `to_millimetres`."""
    extent = float(np.ptp(V, axis=0).max())
    if size is not None:
        return size / extent, f"largest extent set to {size:g} mm as asked"
    if unit != "auto":
        return UNITS[unit], f"largest extent {extent:.6g} {unit} as asked"
    if said is not None:
        words = f"largest extent {extent:.6g} {said.name}, as the file says"
        if said.binding or _plausible(extent * said.mm):
            return said.mm, words
        return _DEFAULT / extent, f"{words}, is unlikely: scaled to {_DEFAULT:g} mm (--unit makes it hold)"
    if _plausible(extent):
        return 1.0, f"largest extent {extent:.6g} taken as mm"
    return _DEFAULT / extent, f"largest extent {extent:.6g} is unlikely in mm: scaled to {_DEFAULT:g} mm"


def in_millimetres(V: Floats, scale: float, words: str) -> Scaled:
    """Scale a model (n, 3) by a factor, bring it near the origin if it is far away, and note why."""
    low, high = V.min(axis=0), V.max(axis=0)
    extent = float((high - low).max())
    far = max(np.abs(low).max(), np.abs(high).max()) * scale > max(_FAR, 2 * extent * scale)
    shift = -(low + high) / 2 if far else np.zeros(3)
    to_source = np.eye(4)
    to_source[:3, :3] /= scale
    to_source[:3, 3] = -shift
    moved = (shift * scale).tolist() if far else None
    facts = ScaleFacts(scale, ((high - low) * scale).tolist(), words, moved)
    return Scaled((V + shift) * scale, to_source, facts)


def _plausible(extent: float) -> bool:
    """Tell whether a model of some mm is as large as models are."""
    return _PLAUSIBLE[0] * (1 - _FLOAT32) <= extent <= _PLAUSIBLE[1] * (1 + _FLOAT32)


def decimate(V: Floats, F: Ints, faces: int) -> tuple[Floats, Ints]:
    """Simplify a mesh to a number of faces, keeping its topology and its borders.

    Parameters
    ----------
    V : (n, 3) float64, mm
    F : (m, 3) int64, manifold
    faces : int, target; topology may keep the mesh above it

    Returns
    -------
    V : (n', 3) float64
    F : (m', 3) int64, as clean as the input

    Raises
    ------
    InputError
        pymeshlab can't be imported, or fails.

    References
    ----------
    Garland and Heckbert, "Surface Simplification Using Quadric Error Metrics", 1997.
    """
    if len(F) <= faces:
        return V, F
    if len(F) > _FINE and len(F) > _THINNED * _SHARE * faces:
        V, F = collapse_fast(V, F, int(_THINNED * faces))
    pymeshlab = import_pymeshlab()
    meshes = pymeshlab.MeshSet(verbose=False)
    meshes.add_mesh(pymeshlab.Mesh(V, F))
    try:
        meshes.meshing_decimation_quadric_edge_collapse(
            targetfacenum=faces,
            qualitythr=0.5,
            preserveboundary=True,
            preservenormal=True,
            preservetopology=True,
            planarquadric=True,
        )
    except pymeshlab.PyMeshLabException as error:
        raise InputError(
            f"the mesh can't be simplified to {faces} faces ({error})", hint="work on all its faces"
        ) from None
    mesh = meshes.current_mesh()
    F, kept = compact(np.asarray(mesh.face_matrix(), np.int64))
    V = np.asarray(mesh.vertex_matrix(), np.float64)[kept]
    if not is_clean(F, len(V)):
        V, F, _ = repair(V, F, cavities=True)
    return V, F


def import_pymeshlab() -> Any:
    """Give the module pymeshlab.

    Raises
    ------
    InputError
        It can't be imported; the sentence names the system package that is missing.
    """
    try:
        import pymeshlab
    except ImportError as error:
        package = next((name for library, name in _PACKAGES.items() if library in str(error)), None)
        hint = f"install the system package {package} (apt-get install {package})" if package else str(error)
        raise InputError("pymeshlab can't be imported", hint=hint) from None
    return pymeshlab
