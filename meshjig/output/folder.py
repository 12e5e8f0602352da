"""A folder that appears whole or not at all."""

import json
import os
import shutil
import uuid
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from meshjig.errors import OutputError

__all__ = ["check_target", "replace_folder", "write_text"]


def check_target(target: Path | str, kind: str = "puzzle") -> None:
    """Refuse a folder that could not be replaced later, before any work is done for it.

    Raises
    ------
    OutputError
        As `replace_folder` would.
    """
    target = Path(target).resolve()
    _refuse_foreign(target, kind)
    above = target.parent
    while not above.exists() and above != above.parent:
        above = above.parent
    if not above.is_dir() or not os.access(above, os.W_OK):
        raise OutputError(f"the output folder {target} can't be written ({above} is closed)", hint=_HINT)


@contextmanager
def replace_folder(target: Path | str, kind: str = "puzzle") -> Iterator[Path]:
    """Give a new folder to write to, and put it in the target's place once everything is written.

    Parameters
    ----------
    target : Path
        An existing folder is replaced only when it is empty, or when meshjig made it and it holds the
        same kind of thing: its report.json has the keys ``meshjig`` and ``kind``. Missing parents are made.
    kind : str, such as "puzzle", "charts" or "coupon"

    Yields
    ------
    Path
        A hidden folder beside the target. Whatever ends the block early, it is removed, and the target
        stays as it was.

    Raises
    ------
    OutputError
        The target is not ours to replace, or can't be written.
    """
    target = Path(target).resolve()  # a link stays a link
    _refuse_foreign(target, kind)
    made_parents: list[Path] = []
    scratch = target.parent / f".{target.name}-{uuid.uuid4().hex[:12]}"
    try:
        try:
            _make_parents(target.parent, made_parents)
            scratch.mkdir()
            yield scratch
            _refuse_foreign(target, kind)
            _swap(scratch, target)
        except OSError as error:
            reason = (error.strerror or str(error)).lower()
            raise OutputError(
                f"the output folder {target} can't be written ({reason})", hint=_HINT
            ) from error
    except BaseException:
        shutil.rmtree(scratch, ignore_errors=True)
        for parent in reversed(made_parents):
            with suppress(OSError):
                parent.rmdir()
        raise


def write_text(path: Path, text: str) -> None:
    """Write a file that appears whole or not at all.

    Raises
    ------
    OutputError
        It can't be written.
    """
    scratch = path.with_name(f".{path.name}-{uuid.uuid4().hex[:12]}")
    try:
        scratch.write_text(text, encoding="utf-8")
        os.replace(scratch, path)
    except OSError as error:
        with suppress(OSError):
            scratch.unlink()
        reason = (error.strerror or str(error)).lower()
        raise OutputError(f"{path} can't be written ({reason})", hint="choose another file") from None


_HINT = "choose another with -o, or make room there"


def _make_parents(folder: Path, made: list[Path]) -> None:
    if not folder.exists():
        _make_parents(folder.parent, made)
        folder.mkdir()
        made.append(folder)


def _refuse_foreign(target: Path, kind: str) -> None:
    try:
        if not target.exists():
            return
        if not target.is_dir():
            raise OutputError(f"{target} is a file, not a folder", hint="choose another folder with -o")
        held = kind if not any(target.iterdir()) else _kind_of(target / "report.json")
    except OSError as error:
        raise OutputError(f"the output folder {target} can't be read", hint=_HINT) from error
    if held is None:
        raise OutputError(
            f"the folder {target} was not made by meshjig, so it is left alone", hint="choose another with -o"
        )
    if held != kind:
        raise OutputError(
            f"the folder {target} holds a {held}, so it is left alone", hint="choose another with -o"
        )


def _kind_of(report: Path) -> str | None:
    """Say what a report is of; None where meshjig wrote none."""
    try:
        content = json.loads(report.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    return str(content.get("kind", "puzzle")) if isinstance(content, dict) and "meshjig" in content else None


def _swap(scratch: Path, target: Path) -> None:
    """Rename, so that no moment has half a folder in place."""
    if not target.exists():
        os.rename(scratch, target)
        return
    old = scratch.with_name(scratch.name + "-old")
    os.rename(target, old)
    try:
        os.rename(scratch, target)
    except BaseException:
        os.rename(old, target)
        raise
    shutil.rmtree(old, ignore_errors=True)
