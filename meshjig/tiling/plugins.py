"""Tilings that other packages bring along, by the entry point group ``meshjig.tilings``."""

import logging
from importlib.metadata import EntryPoint, entry_points

from meshjig.errors import OptionError
from meshjig.tiling.check_unit import check_unit
from meshjig.tiling.unit import Unit

__all__ = ["GROUP", "describe_plugins", "plugin_names", "plugin_unit"]

GROUP = "meshjig.tilings"

_log = logging.getLogger(__name__)


def plugin_names() -> list[str]:
    """Name the tilings of other packages, without loading them."""
    return sorted(_found())


def plugin_unit(name: str, seed: int, columns: int | None) -> Unit:
    """Ask another package for its tiling, and check that it is one.

    Parameters
    ----------
    name : str, one of `plugin_names`
    seed : int
    columns : int, optional
        Both are handed on as keywords.

    Raises
    ------
    OptionError
        The package fails, or what it gives is no tiling.
    """
    point = _found()[name]
    try:
        unit = point.load()(seed=seed, columns=columns)
        if not isinstance(unit, Unit):
            raise TypeError(f"it gives {type(unit).__name__} where Unit is needed")
        check_unit(unit)
    except Exception as error:
        raise OptionError(
            f"the tiling {name} ({_source(point)}) does not work: {_reason(error)}",
            hint="choose another tiling, or tell its author",
        ) from error
    return unit


def describe_plugins() -> list[tuple[str, str]]:
    """List the tilings of other packages that load; those that don't are named in a warning.

    Returns
    -------
    list of (str, str), name and one line about it
    """
    described = []
    for name, point in sorted(_found().items()):
        try:
            first_line = (point.load().__doc__ or "").strip().split("\n")[0]
        except Exception as error:
            _log.warning("the tiling %s (%s) can't be loaded: %s", name, _source(point), _reason(error))
        else:
            described.append((name, first_line or f"from {_source(point)}"))
    return described


def _found() -> dict[str, EntryPoint]:
    return {point.name: point for point in entry_points(group=GROUP)}


def _source(point: EntryPoint) -> str:
    return f"package {point.dist.name}" if point.dist else point.value


def _reason(error: Exception) -> str:
    return f"{error}" if isinstance(error, OptionError) else f"{type(error).__name__}: {error}"
