"""Lines of words: the text of a mesh file, in whatever coding, and the numbers in it."""

from __future__ import annotations

import codecs
import re
import warnings
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from meshjig.mesh.arrays import Floats, Ints, starts

__all__ = ["NONE", "Lines", "plain", "table", "unmarked"]

NONE = np.iinfo(np.int64).min  # stands for a word that is no whole number
_LARGE = 2.0**53

_BLANK = np.zeros(256, bool)
_BLANK[[9, 10, 11, 12, 13, 32]] = True


def plain(data: bytes) -> bytes:
    """Give a text in UTF-8, without a byte-order mark, with lines that end in a line feed, the last one too.

    UTF-16 is told by its mark, or by every other of its first bytes being zero.
    """
    data = unmarked(data)
    if data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        data = data.decode("utf-16", "replace").encode()
    elif len(data) > 3 and data[1] == data[3] == 0 != data[0] and data[2]:
        data = data.decode("utf-16-le", "replace").encode()
    elif len(data) > 3 and data[0] == data[2] == 0 != data[1] and data[3]:
        data = data.decode("utf-16-be", "replace").encode()
    data = unmarked(data)
    if b"\r" in data:
        data = data.replace(b"\r\n", b"\n").replace(b"\r", b"\n")
    return data if data.endswith(b"\n") else data + b"\n"


def unmarked(data: bytes) -> bytes:
    """Give bytes without the byte-order marks of UTF-8 that they begin with."""
    while data.startswith(codecs.BOM_UTF8):
        data = data[3:]
    return data


class Lines:
    """Lines of a text.

    Parameters
    ----------
    text : bytes, as `plain` gives it
    """

    def __init__(self, text: bytes) -> None:
        self.text = text
        self._bytes = np.frombuffer(text, np.uint8)
        ends = np.flatnonzero(self._bytes == 10) + 1
        self._start = np.concatenate([[0], ends])
        blank = _BLANK[self._bytes]
        is_start = ~blank
        is_start[1:] &= blank[:-1]
        self._word = np.flatnonzero(is_start)
        self._first = np.searchsorted(self._word, self._start)

    def __len__(self) -> int:
        return len(self._start) - 1

    @cached_property
    def sizes(self) -> Ints:
        """How many words each line has, (l,)."""
        return np.diff(self._first)

    def line(self, k: int) -> str:
        """Give a line as it reads, without blanks around it; in Latin-1 where it is no UTF-8."""
        line = self.text[self._start[k] : self._start[k + 1]]
        try:
            return line.decode("utf-8").strip()
        except UnicodeDecodeError:
            return line.decode("latin-1").strip()

    def rest(self, k: int) -> str:
        """Give a line without its first word."""
        return [*self.line(k).split(None, 1), "", ""][1]

    def starting(self, *names: bytes) -> Ints:
        """Give the lines whose first word is one of some, in their order, (k,)."""
        filled = np.flatnonzero(self.sizes)
        at = self._word[self._first[filled]]
        found = np.zeros(len(at), bool)
        for name in names:
            some = np.flatnonzero(self._bytes[at] == name[0])
            for k in range(1, len(name)):
                some = some[self._byte(at[some] + k) == name[k]]
            found[some[_BLANK[self._byte(at[some] + len(name))]]] = True
        return filled[found]

    def only(self, lines: Ints, without: int = 0) -> Lines:
        """Give some of the lines, without so many characters of their first words, and without comments.

        Parameters
        ----------
        lines : (k,) int64, in rising order
        without : int
        """
        kept = np.zeros(len(self), bool)
        kept[lines] = True
        mask = np.repeat(kept, np.diff(self._start))
        for k in range(without):
            mask[self._word[self._first[lines]] + k] = False
        text = self._bytes[mask].tobytes()
        return Lines(re.sub(rb"#[^\n]*", b"", text) if b"#" in text else text)

    def filled(self) -> Lines:
        """Give the lines that hold more than a comment, without their comments."""
        whole = Lines(re.sub(rb"#[^\n]*", b"", self.text)) if b"#" in self.text else self
        return whole if whole.sizes.all() else whole.only(np.flatnonzero(whole.sizes))

    def floats(self) -> Floats:
        """Give all words as numbers, (w,), NaN for what is none; a comma may stand for the point."""
        values = _numbers(self.text, len(self._word), np.float64)
        return np.array([_number(word) for word in self.text.split()]) if values is None else values

    def integers(self) -> Ints:
        """Give all words as whole numbers, (w,), ``NONE`` for what is none."""
        values = _numbers(self.text, len(self._word), np.int64)
        if values is not None:
            return values
        slow = self.floats()
        whole = (slow == np.rint(slow)) & (np.abs(slow) < _LARGE)
        return np.where(whole, slow, NONE).astype(np.int64)

    def slashes(self) -> Ints:
        """How many slashes each word has, (w,)."""
        before = np.searchsorted(np.flatnonzero(self._bytes == 47), np.append(self._word, len(self._bytes)))
        return np.diff(before)

    def _byte(self, at: Ints) -> NDArray[np.uint8]:
        return self._bytes.take(at, mode="clip")


def table(values: Floats, sizes: Ints, columns: int) -> Floats:
    """Give the first values of lists, one after the other in an array: (l, columns), NaN for none."""
    if len(sizes) and (sizes == sizes[0]).all() and sizes[0] >= columns:
        return values.reshape(len(sizes), -1)[:, :columns]
    out, first = np.full((len(sizes), columns), np.nan), starts(sizes)
    for k in range(columns):
        has = sizes > k
        out[has, k] = values[first[has] + k]
    return out


def _numbers(text: bytes, count: int, kind: type) -> NDArray | None:
    """Read numbers at once; None where some word is none."""
    if not count:
        return np.zeros(0, kind)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error", DeprecationWarning)
            values: NDArray = np.fromstring(text, kind, sep=" ")
    except (ValueError, DeprecationWarning):
        return None
    return values if len(values) == count else None


def _number(word: bytes) -> float:
    try:
        return float(word.replace(b",", b"."))
    except ValueError:
        return np.nan
