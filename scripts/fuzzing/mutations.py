"""Mutations that know what a file is made of: lines, words, numbers in a head, JSON, parts of an archive."""

import io
import json
import random
import re
import struct
import zipfile
import zlib
from collections.abc import Callable

__all__ = ["mutated"]

Mutation = Callable[[bytes, random.Random], bytes]

_WORDS = [
    *(b"nan", b"-inf", b"1e400", b"1e-320", b"-1", b"0", b"99999999999", b"4294967295", b"9" * 5000, b"0x10"),
    *(b"", b"--", b"1/2/3", b"../../x", b"%s%n", b"\xff\xfe", b"\x1b[31m", b"\xe4", b"\0"),
]
_UNFIT = ValueError, IndexError, KeyError, TypeError, struct.error, zipfile.BadZipFile, zlib.error
_INTEGERS = (0, 1, 2, 0x7F, 0xFF, 0x7FFF, 0xFFFF, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFE, 0xFFFFFFFF)
_FLOATS = (float("nan"), float("inf"), -1e38, 1e-45, 0.0, 3e9)
_VALUES = (
    None,
    -1,
    0,
    1,
    10**9,
    2**40,
    1e308,
    "",
    "x",
    "POSITION",
    [],
    {},
    [[]],
    True,
    "data:,",
    "../x.bin",
    5126,
)


def mutated(kind: str, data: bytes, chance: random.Random) -> tuple[bytes, list[str]]:
    """Change a file in one to three places.

    Parameters
    ----------
    kind : str, its file extension
    data : bytes, a sound file
    chance : random.Random

    Returns
    -------
    data : bytes
    names : list of str, what was done; "as_..." stands for what must do no harm
    """
    names = []
    for _ in range(chance.choice((1, 1, 1, 2, 3))):
        mutation = chance.choice(_fitting(kind, data))
        try:
            data = mutation(data, chance)
        except _UNFIT:
            data = _overwrite(data, chance)  # what an earlier mutation left is no such file any more
            mutation = _overwrite
        names.append(mutation.__name__.strip("_"))
    return data, names


def _fitting(kind: str, data: bytes) -> list[Mutation]:
    raw = [_overwrite, _truncate, _cut_out, _append]
    if data[:2] in (b"\xff\xfe", b"\xfe\xff"):
        return raw  # two bytes a letter by now
    if kind == "glb":
        return [_json_value, _json_value, _json_drop, _json_double, *raw]
    if kind == "3mf":
        return [_archived, _archived, _archived, *raw]
    if kind == "ply" and b"format ascii" not in data[:200]:
        return [_in_head, _in_head, *raw]
    if kind == "stl" and data.lstrip()[:5] != b"solid":
        return [_count, *raw]
    text = [_word, _word, _drop_word, _double_word, _drop_line, _double_line, _swap_lines, *raw]
    return text if kind in ("svg", "toml") else [*text, as_cr, as_crlf, as_utf16, as_bom]


def _overwrite(data: bytes, chance: random.Random) -> bytes:
    """Put a number, or a few bytes of nothing, over others."""
    new = chance.choice(
        (
            struct.pack("<I", chance.choice(_INTEGERS)),
            struct.pack("<f", chance.choice(_FLOATS)),
            chance.randbytes(chance.randint(1, 9)),
        )
    )
    at = chance.randrange(max(len(data), 1))
    return data[:at] + new + data[at + len(new) :]


def _truncate(data: bytes, chance: random.Random) -> bytes:
    return data[: chance.randrange(max(len(data), 1))]


def _cut_out(data: bytes, chance: random.Random) -> bytes:
    at = chance.randrange(max(len(data), 1))
    return data[:at] + data[at + chance.choice((1, 4, 12, 50, 400)) :]


def _append(data: bytes, chance: random.Random) -> bytes:
    return data + chance.choice((b"\0" * 100, b"\n\n\n", chance.randbytes(64), data[: len(data) // 2]))


def _word(data: bytes, chance: random.Random) -> bytes:
    words = list(re.finditer(rb"[^\s\"'=<>/,\[\]]+", data))
    at = chance.choice(words)
    return data[: at.start()] + chance.choice(_WORDS) + data[at.end() :]


def _drop_word(data: bytes, chance: random.Random) -> bytes:
    at = chance.choice(list(re.finditer(rb"[^\s]+[ \t]?", data)))
    return data[: at.start()] + data[at.end() :]


def _double_word(data: bytes, chance: random.Random) -> bytes:
    at = chance.choice(list(re.finditer(rb"[^\s]+[ \t]?", data)))
    return data[: at.end()] + b" " + at[0] * chance.choice((1, 1, 1, 1000)) + data[at.end() :]


def _drop_line(data: bytes, chance: random.Random) -> bytes:
    lines = data.splitlines(keepends=True)
    del lines[chance.randrange(len(lines))]
    return b"".join(lines)


def _double_line(data: bytes, chance: random.Random) -> bytes:
    lines = data.splitlines(keepends=True)
    k = chance.randrange(len(lines))
    return b"".join([*lines[:k], *[lines[k]] * chance.choice((2, 3, 2000)), *lines[k + 1 :]])


def _swap_lines(data: bytes, chance: random.Random) -> bytes:
    lines = data.splitlines(keepends=True)
    i, j = chance.randrange(len(lines)), chance.randrange(len(lines))
    lines[i], lines[j] = lines[j], lines[i]
    return b"".join(lines)


def as_cr(data: bytes, chance: random.Random) -> bytes:
    return data.replace(b"\r\n", b"\n").replace(b"\n", b"\r")


def as_crlf(data: bytes, chance: random.Random) -> bytes:
    return data.replace(b"\r\n", b"\n").replace(b"\n", b"\r\n")


def as_utf16(data: bytes, chance: random.Random) -> bytes:
    order = chance.choice(("le", "be"))
    return {"le": b"\xff\xfe", "be": b"\xfe\xff"}[order] + data.decode("ascii").encode(f"utf-16-{order}")


def as_bom(data: bytes, chance: random.Random) -> bytes:
    return b"\xef\xbb\xbf" + data


def _in_head(data: bytes, chance: random.Random) -> bytes:
    """Change the head of a binary PLY file as text."""
    head, mark, body = data.partition(b"end_header")
    return chance.choice((_word, _drop_word, _double_word, _drop_line, _double_line, _swap_lines))(
        head, chance
    ) + (mark + body)


def _count(data: bytes, chance: random.Random) -> bytes:
    return data[:80] + struct.pack("<I", chance.choice(_INTEGERS)) + data[84:]


def _json_value(data: bytes, chance: random.Random) -> bytes:
    return _with_json(data, lambda places: _set(*chance.choice(places), chance.choice(_VALUES)))


def _json_drop(data: bytes, chance: random.Random) -> bytes:
    def drop(places):
        fitting = [(h, k) for h, k in places if k != "indices"]  # sound without, but another mesh
        holder, key = chance.choice(fitting)
        del holder[key]

    return _with_json(data, drop)


def _json_double(data: bytes, chance: random.Random) -> bytes:
    def double(places):
        holder, key = chance.choice([(h, k) for h, k in places if isinstance(h, list)])
        holder[key:key] = [holder[key]] * chance.choice((1, 1, 1000))

    return _with_json(data, double)


def _set(holder, key, value) -> None:
    holder[key] = value


def _with_json(data: bytes, change: Callable[[list], None]) -> bytes:
    """Change the JSON chunk of a GLB file; the lengths around it are right again afterwards."""
    (length,) = struct.unpack("<I", data[12:16])
    tree = json.loads(data[20 : 20 + length])
    change(list(_places(tree)))
    text = json.dumps(tree).encode()
    text += b" " * (-len(text) % 4)
    rest = data[20 + length :]
    head = b"glTF" + struct.pack("<II", 2, 20 + len(text) + len(rest))
    return head + struct.pack("<I", len(text)) + b"JSON" + text + rest


def _places(tree):
    """Give every (list or dict, key) in a tree of JSON."""
    for key in list(tree) if isinstance(tree, dict) else range(len(tree)):
        yield tree, key
        if isinstance(tree[key], dict | list):
            yield from _places(tree[key])


def _archived(data: bytes, chance: random.Random) -> bytes:
    """Change one file of an archive, mostly the model, and pack it again."""
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        parts = {name: archive.read(name) for name in archive.namelist()}
    name = chance.choice([*parts, *[name for name in parts if name.endswith(".model")] * 6])
    change = chance.choice(
        (_word, _word, _drop_word, _double_word, _drop_line, _double_line, _swap_lines, _cut_out)
    )
    parts[name] = change(parts[name], chance)
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
        for part, text in parts.items():
            archive.writestr(part, text)
    return packed.getvalue()
