"""What a mesh file brings: other files, if they are regular ones, and pictures of a few formats.

Pictures are told by their bytes; what is damaged or too large is left out.
"""

from __future__ import annotations

import io
import stat
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from meshjig.errors import InputError
from meshjig.runtime.bounded import allow_file
from meshjig.runtime.child import allow

__all__ = ["PictureReader", "resolver_for"]


FORMATS = ("PNG", "JPEG", "TIFF", "BMP", "WEBP", "TGA")  # others can start programs, such as Ghostscript
_LARGEST = 8192  # pixels a side of what is kept: 0.02 mm on a model of 150 mm
_SMALL = 4096**2  # pixels; a picture of so many is no burden
_PACKED = 200  # pixels a byte; more of them only a picture of nothing has, or one made to hurt
_A_PIXEL = 12.0  # bytes that reading and converting takes
_PIXELS_A_SECOND = 1e7


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


class PictureReader:
    """Stands in for the image library's ``open`` while another library reads a mesh.

    Attributes
    ----------
    asked_for : str
        The name of the file that was looked for last.
    notes : list of str
        A sentence for every picture that was left out or made smaller.
    """

    def __init__(self) -> None:
        self.asked_for = ""
        self.notes: list[str] = []

    @contextmanager
    def instead(self) -> Iterator[None]:
        """Have all pictures opened by this reader during the block."""
        from PIL import Image

        before, most = Image.open, Image.MAX_IMAGE_PIXELS
        self._open, Image.MAX_IMAGE_PIXELS = before, None  # it is looked at here
        Image.open = self.read  # type: ignore[assignment]
        try:
            yield
        finally:
            Image.open, Image.MAX_IMAGE_PIXELS = before, most

    def read(self, file: Any, *_: Any, **__: Any) -> Any:
        """Give a picture, wholly read, in RGB or with what else it came with.

        Raises
        ------
        ValueError
            It is left out; a note says why.
        """
        data = file.read() if hasattr(file, "read") else Path(file).read_bytes()
        name = f"the picture {self.asked_for}" if self.asked_for else "a picture in the file"
        self.asked_for = ""
        try:
            image = self._open(io.BytesIO(data), formats=FORMATS)
        except Exception as error:
            known = ", ".join(FORMATS)
            self._leave_out(f"{name} is damaged, or none of {known}", error)
        width, height = image.size
        scaled = image.format == "JPEG" and max(width, height) > _LARGEST
        if scaled:
            image.draft("RGB", (_LARGEST // 2 + 1, _LARGEST // 2 + 1))  # a power of two less is read
        pixels = image.size[0] * image.size[1]
        if pixels > max(_SMALL, _PACKED * len(data)):
            self._leave_out(f"{name} announces {width} x {height} pixels in {len(data)} bytes")
        if pixels > _SMALL:
            allow(_A_PIXEL * pixels, pixels / _PIXELS_A_SECOND)
        try:
            image.load()
        except Exception as error:  # decoders fed a broken file can raise anything
            self._leave_out(f"{name} is damaged", error)
        if max(image.size) > _LARGEST:
            image.thumbnail((_LARGEST, _LARGEST))
            scaled = True
        if scaled:
            self.notes.append(
                f"{name} was scaled from {width} x {height} to {image.size[0]} x {image.size[1]} pixels"
            )
        return image

    def _leave_out(self, why: str, error: Exception | None = None) -> None:
        self.notes.append(f"{why}: it is left out")
        raise ValueError(why) from error
