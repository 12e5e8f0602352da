"""Names in any script, written with the letters that the fonts of every PDF reader have."""

from __future__ import annotations

import unicodedata

__all__ = ["latin"]

_UNNAMED = "?"


def latin(words: str) -> str:
    """Write words with the letters of Western Europe; others by how they sound: кот becomes kot.

    Parameters
    ----------
    words : str

    Returns
    -------
    str
        In Windows-1252: what the fonts have that a PDF need not bring along. A character that nobody can
        read, such as one of a private font, is named by its number.
    """
    composed = unicodedata.normalize("NFC", words)
    try:
        composed.encode("cp1252")
    except UnicodeEncodeError:
        return "".join(map(_letters, composed)).strip() or _UNNAMED
    return composed


def _letters(character: str) -> str:
    from anyascii import anyascii

    try:
        character.encode("cp1252")
    except UnicodeEncodeError:
        nameless = unicodedata.category(character) in ("Cn", "Co", "Cs")
        return str(anyascii(character)) or (f"U+{ord(character):04X}" if nameless else "")
    return character
