"""Import pymeshlab, which needs system libraries that are not always there."""

from __future__ import annotations

from typing import Any

from meshjig.errors import InputError

__all__ = ["import_pymeshlab"]

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
