"""Our dealings with native code that reads files: in a process of its own, which may crash without ours."""

from __future__ import annotations

import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path
from typing import Any

import numpy as np

from meshjig.errors import InputError
from meshjig.types import Floats, Ints

__all__ = ["import_pymeshlab", "read_isolated"]

_SECONDS = 600
_PYMESHLAB = """
import sys
import numpy
import pymeshlab
meshes = pymeshlab.MeshSet(verbose=False)
meshes.load_new_mesh(sys.argv[1])
mesh = meshes.current_mesh()
numpy.savez(sys.argv[2], V=mesh.vertex_matrix(), F=mesh.face_matrix())
"""
_LIB3MF = """
import sys
import lib3mf
import numpy
model = lib3mf.get_wrapper().CreateModel()
model.QueryReader("3mf").ReadFromFile(sys.argv[1])
mm = (0.001, 1.0, 10.0, 25.4, 304.8, 1000.0)[int(model.GetUnit())]
objects = model.MergeToModel().GetMeshObjects()
V, F, n = [], [], 0
while objects.MoveNext():
    mesh = objects.GetCurrentMeshObject()
    points, triangles = mesh.GetVertices(), mesh.GetTriangleIndices()
    V.append(numpy.frombuffer((lib3mf.Position * len(points))(*points), numpy.float32))
    F.append(numpy.frombuffer((lib3mf.Triangle * len(triangles))(*triangles), numpy.uint32) + n)
    n += len(points)
V = numpy.concatenate([numpy.zeros(0), *V]) * mm
F = numpy.concatenate([numpy.zeros(0, numpy.int64), *F])
numpy.savez(sys.argv[2], V=V.reshape(-1, 3), F=F.reshape(-1, 3))
"""
_PACKAGES = {
    "libOpenGL.so": "libopengl0",
    "libGLU.so": "libglu1-mesa",
    "libEGL.so": "libegl1",
    "libGL.so": "libgl1",
}


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


def read_isolated(path: Path) -> tuple[Floats, Ints] | None:
    """Read a mesh file in a child process: 3MF by lib3mf, in mm, all else by pymeshlab.

    Parameters
    ----------
    path : Path

    Returns
    -------
    V : (n, 3) float64
    F : (m, 3) int64
        or None when the file can't be read, or its reader crashed.

    Raises
    ------
    InputError
        pymeshlab can't be imported.
    """
    script = _LIB3MF if path.suffix.lower() == ".3mf" else _PYMESHLAB
    if script is _PYMESHLAB:
        import_pymeshlab()
    with tempfile.TemporaryDirectory(prefix="meshjig-") as folder:
        out = Path(folder) / "mesh.npz"
        # -P: a file named numpy.py beside the user's mesh is not ours to run
        command = [sys.executable, "-P", "-c", script, str(path.resolve()), str(out)]
        try:
            subprocess.run(
                command, capture_output=True, timeout=_SECONDS, check=True, stdin=subprocess.DEVNULL
            )
            with np.load(out) as arrays:
                return arrays["V"].astype(np.float64), arrays["F"].astype(np.int64).reshape(-1, 3)
        except (subprocess.SubprocessError, OSError, ValueError, KeyError, zipfile.BadZipFile):
            return None
