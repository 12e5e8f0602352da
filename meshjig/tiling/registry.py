"""All tilings by name: our own, a user's drawing, and those of other packages.

Another package brings a tiling by an entry point of the group ``meshjig.tilings``: a function that takes
``seed`` and ``columns``, and gives a `Unit`. The tiling has the entry point's name, and is told of by the
first line of the function's docstring.
"""

import logging
from collections.abc import Callable
from importlib.metadata import EntryPoint, distributions
from typing import NamedTuple

from meshjig.errors import OptionError, did_you_mean
from meshjig.mesh.arrays import Floats
from meshjig.tiling.check_unit import check_unit
from meshjig.tiling.families import escher
from meshjig.tiling.families.isohedral import isohedral
from meshjig.tiling.families.polyomino import polyomino
from meshjig.tiling.families.regular import hexagons, macro, squares
from meshjig.tiling.svg.user_unit import user_unit
from meshjig.tiling.template import classic, rectangular
from meshjig.tiling.unit import Unit

__all__ = ["family_names", "get_decor", "get_family"]


GROUP = "meshjig.tilings"

_log = logging.getLogger(__name__)


class _Family(NamedTuple):
    description: str
    unit: Callable[[int, int | None], Unit]  # of seed and columns


_OWN = {
    "classic": _Family("smooth round knobs, as sold in shops", lambda seed, columns: squares(classic)),
    "rectangular": _Family("square-shouldered dovetails", lambda seed, columns: squares(rectangular)),
    "macro": _Family("leaning knobs, four tiles turned about a corner", lambda seed, columns: macro()),
    "hex": _Family("hexagons with round knobs", lambda seed, columns: hexagons()),
    "polyomino": _Family("tiles grown at random from small squares", polyomino),
}
_ISOHEDRAL, _ESCHER, _SVG = "isohedral:", "escher:", ".svg"


def get_family(name: str, seed: int = 0, columns: int | None = None) -> Unit:
    """Find the unit that a tiling repeats.

    Parameters
    ----------
    name : str
        One of `family_names`, ``isohedral:`` and a type such as IH04, that and the path of an SVG
        file with edges of one's own, such as isohedral:IH04:FILE.svg, or the path of one with whole tiles.
    seed : int, for tilings that have something random about them
    columns : int, at least 1, optional
        For tilings that can close around a periodic chart with any number of columns: how many.

    Returns
    -------
    Unit

    Raises
    ------
    OptionError
        There is no such tiling, or it can't be made; the sentence says why.
    """
    if name in _OWN:
        return _OWN[name].unit(seed, columns)
    if name.startswith(_ISOHEDRAL):
        return isohedral(name.removeprefix(_ISOHEDRAL), seed)
    if name.lower().endswith(_SVG):
        return user_unit(name)
    if _figure(name):
        return escher.unit(_figure(name))
    plugins = _plugins()
    if name in plugins:
        return _plugin_unit(plugins[name], seed, columns)
    known = [*_OWN, "isohedral:IH01 to IH93", *_figures(), *sorted(plugins), "FILE.svg"]
    near = did_you_mean(name, [*known, "isohedral:IH01"], least=0.8 if ":" in name else 0.6)
    raise OptionError(f"there is no tiling {name!r}", hint=f"{near} known are {', '.join(known)}".strip())


def get_decor(name: str) -> list[list[Floats]] | None:
    """Draw the lines inside a tiling's tiles, for pictures.

    Parameters
    ----------
    name : str, as for `get_family`

    Returns
    -------
    list of lists of (n, 2) float64, or None
        A list a tile, in the unit's lengths; None for tilings that are outlines only.
    """
    return escher.decor(_figure(name)) if _figure(name) else None


def family_names() -> list[tuple[str, str]]:
    """List the tilings there are, with one line about each.

    Tilings of other packages that can't be loaded are left out, and named in a warning; those with one of
    our names are left out too.

    Returns
    -------
    list of (str, str), name and description
    """
    return [
        *((name, family.description) for name, family in _OWN.items()),
        *((name, f"figures: {name.removeprefix(_ESCHER)}") for name in _figures()),
        ("isohedral:IHnn", "one shape in the symmetry of a type from IH01 to IH93"),
        ("isohedral:IHnn:FILE.svg", "the same with edges that you draw, each an open path"),
        ("FILE.svg", "your own outline, or several that tile together"),
        *(plugin for plugin in _describe_plugins() if plugin[0] not in _OWN),
    ]


def _figures() -> list[str]:
    return [_ESCHER + name for name in escher.names()]


def _figure(name: str) -> str:
    """The figure that a name stands for, the first one for all of them, or nothing."""
    if name == _ESCHER.removesuffix(":"):
        return escher.names()[0]
    return name.removeprefix(_ESCHER) if name in _figures() else ""


def _plugin_unit(point: EntryPoint, seed: int, columns: int | None) -> Unit:
    """Ask another package for its tiling, and check that it is one.

    Parameters
    ----------
    point : EntryPoint, one of `_plugins`
    seed : int
    columns : int, optional
        Both are handed on as keywords.

    Raises
    ------
    OptionError
        The package fails, or what it gives is no tiling.
    """
    try:
        unit = point.load()(seed=seed, columns=columns)
        if not isinstance(unit, Unit):
            raise TypeError(f"it gives {type(unit).__name__} where Unit is needed")
        check_unit(unit)
    except (Exception, SystemExit) as error:
        raise OptionError(
            f"the tiling {point.name} ({_source(point)}) does not work: {_reason(error)}",
            hint="choose another tiling, or tell its author",
        ) from error
    return unit


def _describe_plugins() -> list[tuple[str, str]]:
    """List the tilings of other packages that load; those that don't are named in a warning.

    Returns
    -------
    list of (str, str), name and one line about it
    """
    described = []
    for name, point in sorted(_plugins().items()):
        try:
            first_line = (point.load().__doc__ or "").strip().split("\n")[0]
        except (Exception, SystemExit) as error:
            _log.warning("the tiling %s (%s) can't be loaded: %s", name, _source(point), _reason(error))
        else:
            described.append((name, first_line or f"from {_source(point)}"))
    return described


def _plugins() -> dict[str, EntryPoint]:
    found: dict[str, EntryPoint] = {}
    for package in distributions():
        try:
            for point in package.entry_points.select(group=GROUP):
                found.setdefault(point.name, point)
        except Exception as error:  # whatever a damaged list gives rise to
            _log.warning("the list of entry points of %s is damaged: %s", package.name, _reason(error))
    return found


def _source(point: EntryPoint) -> str:
    return f"package {point.dist.name}" if point.dist else point.value


def _reason(error: BaseException) -> str:
    return f"{error}" if isinstance(error, OptionError) else f"{type(error).__name__}: {error}"
