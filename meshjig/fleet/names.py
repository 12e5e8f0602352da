"""What the folders of a batch are called: after their scans, by their relative paths where names clash."""

from __future__ import annotations

import hashlib
import re
from array import array
from collections.abc import Iterator
from itertools import count

__all__ = ["KeySet", "Names"]

_RESERVED = ("thumbnails", "index.html", "summary.csv", "summary.parquet", "batch.jsonl")
_LONGEST = 150  # bytes of a part
_SUFFIX = re.compile(r"\.[A-Za-z0-9]{1,5}\Z")


class KeySet:
    """A set of 64-bit keys in eight to sixteen bytes each, for millions of names."""

    def __init__(self) -> None:
        self._table, self._n = array("Q", bytes(8 << 10)), 0

    def __contains__(self, key: int) -> bool:
        return self._table[self._slot(key or 1)] != 0

    def add(self, key: int) -> None:
        """Put a key in."""
        slot = self._slot(key or 1)
        if self._table[slot]:
            return
        self._table[slot] = key or 1
        self._n += 1
        if 4 * self._n > 3 * len(self._table):
            old = self._table
            self._table = array("Q", bytes(16 * len(old)))
            for other in old:
                if other:
                    self._table[self._slot(other)] = other

    def _slot(self, key: int) -> int:
        mask = len(self._table) - 1
        slot = key & mask
        while self._table[slot] not in (0, key):
            slot = (slot + 1) & mask
        return slot


class Names:
    """Names that are given out, each once, whatever the case of their letters.

    No name lies below another, since each is that of a folder which holds nothing else.
    """

    def __init__(self) -> None:
        self._taken, self._above, self._shared = KeySet(), KeySet(), KeySet()
        for name in _RESERVED:
            self._taken.add(_key(name))

    def share(self, stem: str) -> None:
        """Say beforehand that several have a name, so that none of them gets it."""
        self._shared.add(_key(_safe(stem)))

    def give(self, relative: str) -> str:
        """Give a name for a scan.

        Parameters
        ----------
        relative : str, its path below the folder that was given, or as it stands in a list

        Returns
        -------
        str
            Its own name without the suffix; where that is taken the relative path, with the suffix if need
            be, parts separated by slashes; and where that is taken too, with a number.
        """
        for name in _candidates(relative):
            key = _key(name)
            parts = name.split("/")
            above = ["/".join(parts[:n]) for n in range(1, len(parts))]
            if len(parts) == 1 and key in self._shared and "/" in relative:
                continue
            if key in self._taken or key in self._above or any(_key(a) in self._taken for a in above):
                continue
            self._taken.add(key)
            for a in above:
                self._above.add(_key(a))
            return name
        raise AssertionError("there is always a next number")


def _candidates(relative: str) -> Iterator[str]:
    parts = [part for part in relative.split("/") if part not in ("", ".", "..")] or ["scan"]
    stem = _SUFFIX.sub("", parts[-1])
    bare = "/".join([*map(_safe, parts[:-1]), _safe(stem)])
    yield _safe(stem)
    yield bare
    full = "/".join(map(_safe, parts))
    yield full
    flat = full.replace("/", "-")[-_LONGEST:]  # what lies above may itself be a scan
    for number in count(2):
        yield f"{flat}-{number}"


def _safe(part: str) -> str:
    """Give a part of a name that is no hidden one, and not too long."""
    part = "_" + part[1:] if part.startswith(".") else part
    data = part.encode("utf-8", "surrogateescape")
    if len(data) > _LONGEST:
        digest = hashlib.sha256(data).hexdigest()[:12]
        part = f"{data[: _LONGEST - 13].decode('utf-8', 'ignore')}-{digest}"
    return part or "scan"


def _key(name: str) -> int:
    data = name.casefold().encode("utf-8", "surrogateescape")
    return int.from_bytes(hashlib.blake2b(data, digest_size=8).digest(), "little")
