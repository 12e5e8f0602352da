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

import numpy as np
from numpy.typing import NDArray

from meshjig.errors import InputError
from meshjig.runtime.bounded import allow_file
from meshjig.runtime.child import allow

__all__ = ["PictureReader", "as_rgb", "resolver_for"]


FORMATS = ("PNG", "JPEG", "TIFF", "BMP", "WEBP", "TGA")  # others can start programs, such as Ghostscript
_LARGEST = 8192  # pixels a side of what is kept: 0.02 mm on a model of 150 mm
_ROOM = 2 * _LARGEST**2  # pixels of all pictures of a file
_LEAST = 256  # pixels a side that a picture may always have
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
    expected : int
        How many pictures are still to come, as far as is known: they share the room there is.
    notes : list of str
        A sentence for every picture that was left out or made smaller.
    """

    def __init__(self) -> None:
        from PIL import Image

        self.asked_for = ""
        self.expected = 1
        self.notes: list[str] = []
        self._open = Image.open
        self._room = _ROOM

    @contextmanager
    def instead(self) -> Iterator[None]:
        """Have all pictures opened by this reader during the block."""
        from PIL import Image

        before = Image.open
        Image.open = self.read  # type: ignore[assignment]
        try:
            yield
        finally:
            Image.open = before

    def pixels(self, data: bytes, name: str) -> NDArray[np.uint8] | None:
        """Give the picture that bytes are, (height, width, 3), sRGB; None, and a note, where they are none.

        Parameters
        ----------
        data : bytes
        name : str, what the note calls it
        """
        self.asked_for = name
        try:
            return as_rgb(self.read(io.BytesIO(data)))
        except ValueError:
            return None

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
        with _any_size():
            return self._read(data, name)

    def _read(self, data: bytes, name: str) -> Any:
        try:
            image = self._open(io.BytesIO(data), formats=FORMATS)
        except Exception as error:
            known = ", ".join(FORMATS)
            self._leave_out(f"{name} is damaged, or none of {known}", error)
        width, height = image.size
        share = max(self._room, 0) / max(self.expected, 1) * max(width, height) / max(min(width, height), 1)
        side = int(max(_LEAST, min(_LARGEST, share**0.5)))
        if image.format == "JPEG" and max(width, height) > side:
            image.draft("RGB", (side // 2 + 1, side // 2 + 1))  # a power of two less is read
        pixels = image.size[0] * image.size[1]
        if pixels > max(_SMALL, _PACKED * len(data)):
            self._leave_out(f"{name} announces {width} x {height} pixels in {len(data)} bytes")
        if pixels > _SMALL:
            allow(_A_PIXEL * pixels, pixels / _PIXELS_A_SECOND)
        try:
            image.load()
        except Exception as error:  # decoders fed a broken file can raise anything
            self._leave_out(f"{name} is damaged", error)
        if max(image.size) > side:
            image.thumbnail((side, side))
        if image.size != (width, height):
            self.notes.append(
                f"{name} was scaled from {width} x {height} to {image.size[0]} x {image.size[1]} pixels"
            )
        self._room -= image.size[0] * image.size[1]
        self.expected -= 1
        return image

    def _leave_out(self, why: str, error: Exception | None = None) -> None:
        self.notes.append(f"{why}: it is left out")
        raise ValueError(why) from error


def as_rgb(image: Any) -> NDArray[np.uint8]:
    """Give a picture of any mode as (height, width, 3), sRGB, its transparency left out.

    Parameters
    ----------
    image : PIL.Image.Image, read; those of 16 bits a pixel, or of real numbers, are brought to 8
    """
    if image.mode.startswith("I;16") or image.mode in ("I", "F"):
        values = np.asarray(image, np.float64)
        top = (
            1.0
            if image.mode == "F" and values.max(initial=0) <= 1
            else 65535.0
            if values.max() > 255
            else 255.0
        )
        grey = np.clip(np.rint(values * (255 / top)), 0, 255).astype(np.uint8)
        return np.repeat(grey[..., None], 3, axis=2)
    return np.asarray(image.convert("RGB"))


@contextmanager
def _any_size() -> Iterator[None]:
    """Have the image library open pictures of any size during the block: we look at it ourselves."""
    from PIL import Image

    before = Image.MAX_IMAGE_PIXELS
    Image.MAX_IMAGE_PIXELS = None
    try:
        yield
    finally:
        Image.MAX_IMAGE_PIXELS = before
