"""A folder that appears whole or not at all."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from pathlib import Path

from meshjig.errors import OutputError, write_error
from meshjig.output.folder.claim import Claim, claimed
from meshjig.output.folder.manifest import REPORT, read_manifest, sign, stranger
from meshjig.runtime.signals import hold_signals

__all__ = ["replace_folder", "reserve_folder"]

_HINT = "choose another with -o, or make room there"


@contextmanager
def reserve_folder(
    target: Path | str, kind: str = "puzzle", inputs: Sequence[str | os.PathLike[str]] = ()
) -> Iterator[Claim]:
    """Refuse a folder that could not be replaced later, and keep other runs from it during the block.

    Parameters
    ----------
    target : path
    kind : str, such as "puzzle", "set of charts" or "coupon"
    inputs : sequence of paths
        Files that are read during the block; none may lie in the target.

    Raises
    ------
    OutputError
        The target holds something that meshjig did not write, or an input, or another kind of thing; another
        run writes to it; it can't be written.
    """
    target = Path(os.path.realpath(target))  # a link stays a link
    with ExitStack() as stack:
        with _as_sentences(target):
            _refuse_inputs(target, inputs)
            _refuse_foreign(target, kind)
            _refuse_closed(target)
            claim = stack.enter_context(claimed(target))
        yield claim


@contextmanager
def replace_folder(
    target: Path | str, kind: str = "puzzle", inputs: Sequence[str | os.PathLike[str]] = ()
) -> Iterator[Path]:
    """Give a new folder to write to, and put it in the target's place once everything is written.

    Parameters
    ----------
    target : path
        An existing folder is replaced only when it is empty, or when it holds nothing but files that meshjig
        wrote, as it wrote them: its report.json lists them. Missing parents are made.
    kind, inputs
        As for `reserve_folder`.

    Yields
    ------
    Path
        A hidden folder beside the target, for files and a report.json with the keys ``meshjig`` and ``kind``,
        which gets the list ``files``. Whatever ends the block early, the folder is removed, and the target
        stays as it was.

    Raises
    ------
    OutputError
        The target is not ours to replace, or can't be written.
    """
    with reserve_folder(target, kind, inputs) as claim, _as_sentences(claim.target):
        scratch = claim.new_folder()
        try:
            yield scratch
            sign(scratch)
            _refuse_foreign(claim.target, kind)
            with hold_signals():
                claim.put_in_place(scratch)
        finally:
            with hold_signals():
                claim.clear()


@contextmanager
def _as_sentences(target: Path) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        raise write_error(f"the output folder {target}", error, _HINT) from error


def _refuse_inputs(target: Path, inputs: Sequence[str | os.PathLike[str]]) -> None:
    if os.path.lexists(target) and not target.is_dir():
        return  # nothing lies in a file
    for given in inputs:
        for place in (Path(os.path.abspath(given)), Path(os.path.realpath(given))):
            if place == target or target in place.parents:
                raise OutputError(
                    f"the input {given} lies in the output folder {target}",
                    hint="choose another folder with -o",
                )


def _refuse_foreign(target: Path, kind: str) -> None:
    if not os.path.lexists(target):
        return
    if not target.is_dir():
        what = "a link that leads to itself" if target.is_symlink() else "a file, not a folder"
        raise OutputError(f"{target} is {what}", hint="choose another folder with -o")
    if not any(target.iterdir()):
        return
    manifest = read_manifest(target)
    found = stranger(target, manifest)
    if manifest is None and found is not None:
        raise OutputError(
            f"the folder {target} was not made by meshjig, or by one that did not list its files in {REPORT};"
            f" {found[0].name} is in it, so it is left alone",
            hint="choose another with -o",
        )
    if found is not None:
        raise OutputError(
            f"{found[0]} {found[1]}, so the folder {target} is left alone",
            hint="move it away, or choose another folder with -o",
        )
    if manifest is not None and manifest.kind != kind:
        raise OutputError(
            f"the folder {target} holds a {manifest.kind}, so it is left alone", hint="choose another with -o"
        )


def _refuse_closed(target: Path) -> None:
    if os.path.ismount(target):
        raise OutputError(f"{target} is where a disk is mounted", hint="choose a folder in it with -o")
    above = target.parent
    while not os.path.lexists(above) and above != above.parent:
        above = above.parent
    if above.is_symlink():  # with all links followed that lead somewhere
        raise OutputError(f"{above} is a link that leads to itself", hint="choose another folder with -o")
    if not above.is_dir():
        says, hint = f"{above} is a file, not a folder", "choose another folder with -o"
    elif os.access(above, os.W_OK):
        return
    elif _on_read_only_disk(above):
        says, hint = f"{above} is on a disk that can only be read", "choose a folder on another disk with -o"
    else:
        says = f"you have no permission to write to {above}"
        hint = "choose another with -o, or get the permission"
    raise OutputError(f"the output folder {target} can't be written ({says})", hint=hint)


def _on_read_only_disk(folder: Path) -> bool:
    try:
        return bool(os.statvfs(folder).f_flag & os.ST_RDONLY)
    except (OSError, AttributeError):  # Windows has no such call
        return False
