"""Files that a mesh file names: only regular ones are opened."""

from __future__ import annotations

import stat
from pathlib import Path
from typing import Any

from meshjig.errors import InputError
from meshjig.runtime.bounded import allow_file
from meshjig.scan.pictures import PictureReader

__all__ = ["resolver_for"]


def resolver_for(path: Path, pictures: PictureReader) -> Any:
    """Give a trimesh resolver for what a mesh file names.

    Parameters
    ----------
    path : Path, of the mesh file
    pictures : PictureReader, which is told what is looked for

    Returns
    -------
    trimesh.resolvers.FilePathResolver
        Its attribute ``refused`` is an InputError once a name has led to a pipe or a device, on which reading
        would wait for ever; None until then.
    """
    from trimesh.resolvers import FilePathResolver

    class RegularFiles(FilePathResolver):  # type: ignore[misc]
        refused: InputError | None = None

        def absolute(self, name: str) -> Path:
            found = super().absolute(name)
            pictures.asked_for = found.name
            if not found.exists():
                return found
            if not stat.S_ISREG(found.stat().st_mode):
                self.refused = InputError(
                    f"{path} names {found.name}, which is no regular file", hint="put the file itself there"
                )
                raise self.refused
            allow_file(found)
            return found

        def namespaced(self, namespace: str) -> FilePathResolver:
            return self  # folders below are no use to any format that is read here

    return RegularFiles(str(path))
