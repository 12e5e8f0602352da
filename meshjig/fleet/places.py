"""Where scans come from and puzzles go to: the machine's own disk, or whatever fsspec reaches by a URL."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path
from typing import Any
from urllib.parse import unquote, urlsplit

from meshjig.errors import ResourceError
from meshjig.fleet.named_files import with_named_files
from meshjig.output.folder.manifest import REPORT

__all__ = ["below", "fetch", "file_name", "is_url", "pull_folder", "push_file", "push_folder", "reach"]


def is_url(place: str) -> bool:
    """Tell whether a place is one that fsspec is needed for."""
    return "://" in place


def below(place: str, name: str) -> str:
    """Name what is in a folder, by a path with slashes."""
    return f"{place.rstrip('/')}/{name}"


def file_name(place: str) -> str:
    """Give the last part of a path or URL."""
    path = unquote(urlsplit(place).path) if place.startswith(("http://", "https://")) else place
    return path.rstrip("/").rsplit("/", 1)[-1]


def reach(url: str) -> tuple[Any, str]:
    """Give the file system of a URL, and the path in it.

    Raises
    ------
    ResourceError
        A package is missing for that.
    """
    try:
        import fsspec.core

        system, path = fsspec.core.url_to_fs(url, use_listings_cache=False)
    except (ImportError, ValueError) as error:
        hint = "install meshjig[batch], and the package for this kind of URL (s3fs for s3, gcsfs for gs)"
        raise ResourceError(f"{url} can't be reached ({error})", hint=hint) from None
    return system, str(path)


def fetch(url: str, folder: Path) -> Path:
    """Copy a file, and the files that it names, into a folder; give where it is, or would be, there."""
    system, path = reach(url)
    local = folder / file_name(url)
    _get(system, path, local)
    above = path.rsplit("/", 1)[0]
    with_named_files(local, lambda name: _get(system, f"{above}/{name}", folder / name))
    return local


def _get(system: Any, path: str, local: Path) -> None:
    local.parent.mkdir(parents=True, exist_ok=True)
    with suppress(FileNotFoundError, IsADirectoryError):
        system.get_file(path, str(local))


def push_file(local: Path, url: str) -> None:
    """Put a file where a URL says."""
    system, path = reach(url)
    with suppress(FileExistsError, NotImplementedError):
        system.makedirs(path.rsplit("/", 1)[0], exist_ok=True)
    system.put_file(str(local), path)


def push_folder(folder: Path, url: str) -> None:
    """Put a folder in the place of another, its report last: without that, it is not whole."""
    system, path = reach(url)
    with suppress(FileNotFoundError):
        system.rm_file(f"{path}/{REPORT}")
    files = sorted(file.relative_to(folder).as_posix() for file in folder.rglob("*") if file.is_file())
    for name in sorted(files, key=lambda name: name == REPORT):
        push_file(folder / name, below(url, name))
    old = {str(there).removeprefix(path.rstrip("/") + "/") for there in _list(system, path)}
    for name in sorted(old - set(files)):
        with suppress(FileNotFoundError):
            system.rm_file(f"{path}/{name}")


def pull_folder(url: str, folder: Path) -> bool:
    """Copy a folder that has a report; tell whether there was one."""
    system, path = reach(url)
    if not system.exists(f"{path}/{REPORT}"):
        return False
    for there in _list(system, path):
        _get(system, str(there), folder / str(there).removeprefix(path.rstrip("/") + "/"))
    return True


def _list(system: Any, path: str) -> list[str]:
    with suppress(FileNotFoundError):
        return list(system.find(path))
    return []
