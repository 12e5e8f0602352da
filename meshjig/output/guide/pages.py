"""Pages of paper: A4, millimetres from the upper left corner, every page with title and number."""

from __future__ import annotations

import io
from collections.abc import Callable
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from meshjig.mesh.arrays import Floats
from meshjig.output.guide.latin import latin

__all__ = [
    "BOTTOM",
    "HEIGHT",
    "LEFT",
    "RIGHT",
    "TOP",
    "WIDTH",
    "Document",
    "Page",
    "tag_size",
    "text_width",
    "wrapped",
]

WIDTH, HEIGHT = 210.0, 297.0  # mm
LEFT, RIGHT = 15.0, 195.0  # where the text begins and ends
TOP, BOTTOM = 26.0, 280.0
_POINT = 72 / 25.4  # of a mm
_REGULAR, _STRONG = "Helvetica", "Helvetica-Bold"
_QUALITY = 85  # of JPEG

Align = Literal["left", "middle", "right"]


class Document:
    """A PDF that is written page by page, once its block ends. Equal calls give equal bytes."""

    def __init__(self, path: Path, title: str, n_pages: int) -> None:
        self._title, self._page, self._n_pages = title, 1, n_pages
        from reportlab import rl_config
        from reportlab.pdfgen.canvas import Canvas

        self._text_only = rl_config.useA85
        self._pen: Any = Canvas(
            str(path), pagesize=(WIDTH * _POINT, HEIGHT * _POINT), invariant=1, pageCompression=1
        )
        self._pen.setTitle(title.encode("utf-8", "replace").decode())
        self._pen.setAuthor("meshjig")
        self._pen.setCreator("meshjig")
        self._pen.setSubject("How to put the puzzle together")

    def end_page(self, name: str) -> None:
        """Give a page its number, all but the cover the title and the chapter's name too."""
        if self._page > 1:
            self.text(LEFT, 15, name, 13, strong=True)
            self.text(RIGHT, 15, self._title, 9, align="right", grey=0.35)
        self.text(WIDTH / 2, HEIGHT - 9, f"{self._page} / {self._n_pages}", 8, align="middle", grey=0.35)
        self._pen.showPage()
        self._page += 1

    def __enter__(self) -> Document:
        from reportlab import rl_config

        rl_config.useA85 = 0  # slow, and a quarter larger
        return self

    def __exit__(self, kind: type[BaseException] | None, *rest: object) -> None:
        from reportlab import rl_config

        try:
            if kind is None:
                self._pen.save()
        finally:
            rl_config.useA85 = self._text_only

    def bookmark(self, name: str) -> None:
        """Let the outline beside the pages name this one."""
        self._pen.bookmarkPage(name)
        self._pen.addOutlineEntry(name, name)

    def text(
        self,
        x: float,
        y: float,
        words: str,
        size: float = 9.0,
        *,
        strong: bool = False,
        align: Align = "left",
        grey: float = 0.0,
    ) -> None:
        """Write a line; y is where its letters stand, size in points."""
        pen = self._pen
        pen.setFont(_STRONG if strong else _REGULAR, size)
        pen.setFillGray(grey)
        draw = {"left": pen.drawString, "middle": pen.drawCentredString, "right": pen.drawRightString}[align]
        draw(x * _POINT, (HEIGHT - y) * _POINT, latin(words))

    def paragraph(self, x: float, y: float, width: float, words: str, size: float = 9.0) -> float:
        """Write words in lines no wider than a width; gives where the next line would stand."""
        for line in wrapped(words, size, width):
            self.text(x, y, line, size, grey=0.2)
            y += size * 1.35 / _POINT
        return y

    def line(
        self, x1: float, y1: float, x2: float, y2: float, *, width: float = 0.2, grey: float = 0.0
    ) -> None:
        """Draw a line."""
        self._pen.setLineWidth(width * _POINT)
        self._pen.setStrokeGray(grey)
        self._pen.line(x1 * _POINT, (HEIGHT - y1) * _POINT, x2 * _POINT, (HEIGHT - y2) * _POINT)

    def box(
        self, x: float, y: float, w: float, h: float, *, grey: float | None = None, round: float = 0.0
    ) -> None:
        """Draw a box: filled with a grey, or just its border."""
        pen = self._pen
        pen.setLineWidth(0.2 * _POINT)
        pen.setStrokeGray(0.7)
        if grey is not None:
            pen.setFillGray(grey)
        pen.roundRect(
            *(v * _POINT for v in (x, HEIGHT - y - h, w, h, round)),
            stroke=grey is None,
            fill=grey is not None,
        )

    def shape(self, ring: Floats, *, width: float = 0.15, grey: float = 0.9) -> None:
        """Draw a shape (k, 2), mm, with an outline around all of it, also where it covers itself."""
        pen = self._pen
        path = pen.beginPath()
        points = np.round((ring * (1, -1) + (0, HEIGHT)) * _POINT, 2).tolist()
        path.moveTo(*points[0])
        for point in points[1:]:
            path.lineTo(*point)
        path.close()
        pen.setLineWidth(2 * width * _POINT)
        pen.setLineJoin(1)
        pen.setStrokeGray(0.15)
        pen.setFillGray(grey)
        pen.drawPath(path, stroke=1, fill=0)
        pen.drawPath(path, stroke=0, fill=1, fillMode=1)

    def picture(self, x: float, y: float, w: float, h: float, rgb: NDArray[np.uint8]) -> None:
        """Show pixels (rows, columns, 3) in a rectangle."""
        from PIL import Image
        from reportlab.lib.utils import ImageReader

        buffer = io.BytesIO()
        Image.fromarray(rgb).save(buffer, "JPEG", quality=_QUALITY)
        buffer.seek(0)
        self._pen.drawImage(
            ImageReader(buffer), *(v * _POINT for v in (x, HEIGHT - y - h)), w * _POINT, h * _POINT
        )

    def fitted(self, x: float, y: float, w: float, h: float, rgb: NDArray[np.uint8]) -> None:
        """Show pixels as large as they fit into the middle of a rectangle."""
        rows, columns = rgb.shape[:2]
        scale = min(w / columns, h / rows)
        wide, high = columns * scale, rows * scale
        self.picture(x + (w - wide) / 2, y + (h - high) / 2, wide, high, rgb)

    def dot(self, x: float, y: float) -> None:
        """Draw a small black dot."""
        self._pen.setFillGray(0)
        self._pen.circle(x * _POINT, (HEIGHT - y) * _POINT, 0.45 * _POINT, stroke=0, fill=1)

    def tag(self, x: float, y: float, words: str, size: float) -> None:
        """Write bold words in the middle of a white tag."""
        w, h = tag_size(words, size)
        self._pen.setLineWidth(0.15 * _POINT)
        self._pen.setStrokeGray(0)
        self._pen.setFillGray(1)
        self._pen.roundRect(
            *(v * _POINT for v in (x - w / 2, HEIGHT - y - h / 2, w, h, h / 3)), stroke=1, fill=1
        )
        self.text(x, y + 0.36 * size / _POINT, words, size, strong=True, align="middle")


Page = Callable[[Document], None]  # draws one


def text_width(words: str, size: float, *, strong: bool = False) -> float:
    """Give how wide a line would be, mm."""
    from reportlab.pdfbase.pdfmetrics import stringWidth

    return float(stringWidth(latin(words), _STRONG if strong else _REGULAR, size)) / _POINT


def wrapped(words: str, size: float, width: float) -> list[str]:
    """Break words into lines no wider than a width, mm; a word that is wider has a line of its own."""
    lines = [""]
    for word in words.split():
        longer = f"{lines[-1]} {word}".strip()
        if lines[-1] and text_width(longer, size) > width:
            lines.append(word)
        else:
            lines[-1] = longer
    return lines


def tag_size(words: str, size: float) -> tuple[float, float]:
    """Give the width and height of a tag, mm."""
    return text_width(words, size, strong=True) + 0.55 * size / _POINT, 1.15 * size / _POINT
